// A run's wrong answers beside the known ones, in both directions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "reference/results/known_defects.h"

namespace contactcheck::results {

/// By library: "fcl" -> "0.7.0".
using LibraryVersions = std::map<std::string, std::string>;

/// Of the libraries of a run; kOwnVersion of our own detectors.
LibraryVersions versions_in(const results::Results& results);

struct DefectComparison {
  struct Count {
    std::size_t listed = 0;      ///< cases that the run could have shown
    std::size_t shown = 0;       ///< of these, with whatever count
    std::size_t changed = 0;     ///< of those, with another count than the listed one
    bool other_version = false;  ///< the run has another version of the library: nothing compared
    bool possible = false;       ///< the run has some detector and case of it
  };
  /// A count that was listed and one that the run shows; 0 where there is none.
  struct Change {
    std::uint64_t was = 0, is = 0;

    bool operator==(const Change&) const = default;
  };
  using Changes = std::map<Sighting, Change>;

  std::vector<Count> counts;  ///< per known defect, in its order
  Changes changed;            ///< listed and shown, with another count
  Changes not_shown;          ///< listed, could have been seen, were not: mended since?
  Changes unlisted;           ///< seen and not listed

  bool as_listed() const { return changed.empty() && not_shown.empty() && unlisted.empty(); }
};

DefectComparison compare_defects(const KnownDefects& known, const SightingsOfRun& run,
                                 const LibraryVersions& versions);

/// True when some detector failed where the list has no error.
bool any_unlisted_error(const DefectComparison& comparison);

/// What results.json says about the defects that the run could have shown.
DefectCounts in_results(const KnownDefects& known, const DefectComparison& comparison);

/// Of which library a detector is made; by its canonical name.
using LibraryOf = std::function<std::string(const std::string& detector)>;

/// The list as this run would have it. What the run shows is taken in with its counts: under the
/// defect of the same detector, scene and kind where there is one, else under a new one that waits
/// for an explanation (kUnexplained). What it could have shown and did not is taken out, and
/// defects of which nothing is left with it. What it cannot tell stays, so does a defect of another
/// version.
KnownDefects updated(const KnownDefects& known, const SightingsOfRun& run,
                     const LibraryVersions& versions, const LibraryOf& library_of);

}  // namespace contactcheck::results
