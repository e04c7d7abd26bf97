// Compares a run's wrong answers with the list of known ones, in both directions.
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

/// The versions of a run's libraries; kOwnVersion for our own detectors.
LibraryVersions versions_in(const results::Results& results);

struct DefectComparison {
  struct Count {
    std::size_t listed = 0;      ///< cases that the run could have shown
    std::size_t shown = 0;       ///< of these, with any count
    std::size_t changed = 0;     ///< of those, with a count other than the listed one
    bool other_version = false;  ///< the run has another version of the library: not compared
    bool possible = false;       ///< the run contains some detector and case of it
  };
  /// A listed count and the count of the run; 0 if there is none.
  struct Change {
    std::uint64_t was = 0, is = 0;

    bool operator==(const Change&) const = default;
  };
  using Changes = std::map<Sighting, Change>;

  std::vector<Count> counts;  ///< per known defect, in its order
  Changes changed;            ///< listed and shown, with another count
  Changes not_shown;          ///< listed, could have been seen, were not: fixed since?
  Changes unlisted;           ///< seen and not listed

  bool as_listed() const { return changed.empty() && not_shown.empty() && unlisted.empty(); }
};

DefectComparison compare_defects(const KnownDefects& known, const SightingsOfRun& run,
                                 const LibraryVersions& versions);

/// True if some detector failed and the list has no such error.
bool any_unlisted_error(const DefectComparison& comparison);

/// The known defects that the run could have shown, as results.json has them.
DefectCounts in_results(const KnownDefects& known, const DefectComparison& comparison);

/// Returns the library of a detector, given its canonical name.
using LibraryOf = std::function<std::string(const std::string& detector)>;

/// The list updated by this run. Wrong answers of the run are added with their counts: to the
/// defect of the same detector, scene and kind, or to a new one without explanation (kUnexplained).
/// Cases that the run could have shown and did not are removed, and defects without cases with
/// them. Cases that the run could not show stay, as do defects of other versions.
KnownDefects updated(const KnownDefects& known, const SightingsOfRun& run,
                     const LibraryVersions& versions, const LibraryOf& library_of);

}  // namespace contactcheck::results
