// The known wrong answers to hard cases: those of other libraries in
// fixtures/hard/known-defects.json, those that follow from our readings of the paper in
// fixtures/hard/readings.json. People write the explanations, a command fills in cases and counts.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::results {

// Wrong answers to cases, one by one, as in results.json.

enum class SightingKind {
  kMissed,    ///< true contacts that the answer does not contain
  kSpurious,  ///< contacts in the answer that are not true
  kError,     ///< no answer: it threw, crashed, hung or ran out of memory
  kRefused    ///< no answer: the detector refused the input
};

/// "missed", "spurious", "error", "refused"
const char* name_of(SightingKind kind);

inline constexpr const char* kNoCase = "-";

/// A detector's wrong answer to a case of a family, or that it refused the case; or its error in a
/// scene that is not a family.
struct Sighting {
  std::string detector;
  std::string scene;  ///< or family
  SightingKind kind = SightingKind::kMissed;
  std::string value;  ///< the family's parameter; kNoCase if the error has no case

  auto operator<=>(const Sighting&) const = default;
};

/// The number of missed or spurious pairs in each case; 1 without an answer.
using CountedSightings = std::map<Sighting, std::uint64_t>;

/// The wrong answers that a run shows, and those that it could show.
struct SightingsOfRun {
  CountedSightings seen;
  /// Every wrong answer that the run could have shown: for each detector that answered, all cases
  /// that it was judged on.
  std::set<Sighting> possible;
};

/// For families: every case at the finest level judged. For other scenes, and for families with a
/// range: only errors, since missed contacts there are results of the detector, not defects of a
/// library's version, and refusals are up to the gate's policy. A refused scene has no sightings.
/// @throws InputError if a row's scene is not among the scenes, or the cases of a family differ
/// from those of its row
SightingsOfRun sightings_of(const results::Results& results);

/// The library of our own detectors, of any version: their source has the lists.
inline constexpr const char* kOwnLibrary = "contactcheck";
inline constexpr const char* kOwnVersion = "any";

/// One cause of wrong answers in one version of one library; or, for kOwnLibrary, in a reading of
/// the paper, which is what the paper says and not a defect.
struct KnownDefect {
  std::string library;                  ///< as in results.json: "fcl"
  std::string version;                  ///< the same: "0.7.0"
  std::string where;                    ///< the place in the source or in the paper
  std::optional<std::string> upstream;  ///< address of the library's issue about it
  SightingKind kind{};                  ///< the kind of wrong answer
  std::string sentence;                 ///< the explanation
  CountedSightings seen;                ///< every case that shows it, all of this kind

  bool is_reading() const { return library == kOwnLibrary; }
};

struct KnownDefects {
  std::vector<KnownDefect> defects;
  std::set<std::string> families = {};  ///< ids of the hard cases next to the lists
  /// The ranges of the suite scales in which each detector is right (scale_ranges.h).
  std::vector<ScaleRange> ranges = {};
};

/// True if the defect has sightings of that detector in that scene, of that kind; it is then the
/// cause of all of them.
bool has_place_for(const KnownDefect& defect, const Sighting& sighting);

/// Place and sentence of a defect without an explanation yet.
inline constexpr const char* kUnexplained = "not looked into yet";

/// Reads known-defects.json and readings.json of the folder, in this order, the file names in its
/// families/, and ranges.json. A missing file is an empty list.
/// @throws InputError with file, place and value; also if two defects of one version have the same
/// detector, scene and kind, and for the old form without counts
KnownDefects read_known_defects(const std::filesystem::path& folder);

/// Writes the three files, each under a temporary name, then renamed. @throws InputError with the
/// path if one cannot be written
void write_known_defects(const std::filesystem::path& folder, const KnownDefects& known);

}  // namespace contactcheck::results
