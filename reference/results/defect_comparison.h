// A run's wrong answers beside the known ones, in both directions.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "reference/results/known_defects.h"

namespace contactcheck::results {

/// By library: "fcl" -> "0.7.0".
using LibraryVersions = std::map<std::string, std::string>;

/// Of the libraries of a run. Our own detectors are of version "any": the list lies beside their
/// source.
LibraryVersions versions_in(const results::Results& results);

struct DefectComparison {
  struct Count {
    std::size_t listed = 0;      ///< of these, the run could have shown
    std::size_t shown = 0;       ///< of those
    bool other_version = false;  ///< the run has another version of the library: nothing compared
  };
  std::vector<Count> counts;        ///< per known defect, in its order
  std::vector<Sighting> not_shown;  ///< listed, could have been seen, were not: mended since?
  std::vector<Sighting> unlisted;   ///< seen and not listed; sorted
};

DefectComparison compare_defects(const KnownDefects& known, const SightingsOfRun& run,
                                 const LibraryVersions& versions);

/// True when some detector failed where the list has no error.
bool any_unlisted_error(const DefectComparison& comparison);

/// What results.json says about the list.
DefectCounts in_results(const KnownDefects& known, const DefectComparison& comparison);

/// Of which library a detector is made; by its canonical name.
using LibraryOf = std::function<std::string(const std::string& detector)>;

/// The list as this run would have it. What the run shows is taken in: under the defect of the same
/// detector, scene and kind where there is one, else under a new one that waits for an explanation
/// (kUnexplained). What it could have shown and did not is taken out, and defects of which nothing
/// is left with it. What it cannot tell stays, so does a defect of another version.
KnownDefects updated(const KnownDefects& known, const SightingsOfRun& run,
                     const LibraryVersions& versions, const LibraryOf& library_of);

}  // namespace contactcheck::results
