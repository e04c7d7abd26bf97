// The wrong answers to hard cases that are known: those of other libraries in
// fixtures/hard/known-defects.json, those that follow from our readings of the paper in
// fixtures/hard/readings.json. People explain them, a command fills in the cases and counts.
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
  kMissed,    ///< true contacts that the answer lacks
  kSpurious,  ///< contacts in the answer that are none
  kError,     ///< no answer: it threw, crashed, hung or ran out of memory
  kRefused    ///< no answer: it says that it must not answer
};

/// "missed", "spurious", "error", "refused"
const char* name_of(SightingKind kind);

inline constexpr const char* kNoCase = "-";

/// A detector's wrong answer to a case of a family, or that it refused the case; or its error in a
/// scene that is no family.
struct Sighting {
  std::string detector;
  std::string scene;  ///< or family
  SightingKind kind = SightingKind::kMissed;
  std::string value;  ///< of the family's parameter; kNoCase where there is none to blame

  auto operator<=>(const Sighting&) const = default;
};

/// How many pairs are missed or spurious there; 1 of what has no answer.
using CountedSightings = std::map<Sighting, std::uint64_t>;

/// What a run can tell about wrong answers.
struct SightingsOfRun {
  CountedSightings seen;
  /// Every wrong answer that the run would have shown, were it there: of each detector that
  /// answered, all cases it was judged on.
  std::set<Sighting> possible;
};

/// Of families: every case at the finest level judged. Of other scenes: errors alone, since what a
/// detector misses there is its result and no fact of a library's version, and whether it may
/// refuse a scene is for the gate's policy; and of families with a range, whose wrong answers are
/// its ends. Where the scene itself was refused, no detector was.
/// @throws InputError when a row's scene is not among the scenes, or a family has other cases than
/// a row of it
SightingsOfRun sightings_of(const results::Results& results);

/// The library of our own detectors, which are of any version: the lists lie beside their source.
inline constexpr const char* kOwnLibrary = "contactcheck";
inline constexpr const char* kOwnVersion = "any";

/// One cause of wrong answers, in one version of one library; or of a reading of the paper, of
/// kOwnLibrary, which is what the paper says and no defect.
struct KnownDefect {
  std::string library;                  ///< as in results.json: "fcl"
  std::string version;                  ///< the same: "0.7.0"
  std::string where;                    ///< the place in the source or in the paper
  std::optional<std::string> upstream;  ///< the library's own issue about it: its address
  SightingKind kind{};                  ///< what it looks like
  std::string sentence;                 ///< why
  CountedSightings seen;                ///< every case that shows it, all of this kind

  bool is_reading() const { return library == kOwnLibrary; }
};

struct KnownDefects {
  std::vector<KnownDefect> defects;
  std::set<std::string> families = {};  ///< ids of the hard cases beside the lists
  /// Where each detector is right in the suite scales (scale_ranges.h).
  std::vector<ScaleRange> ranges = {};
};

/// Does the defect already have sightings of that detector in that scene, of that kind? Then it is
/// the cause of all of them.
bool has_place_for(const KnownDefect& defect, const Sighting& sighting);

/// Place and sentence of a defect that no person has looked at yet.
inline constexpr const char* kUnexplained = "not looked into yet";

/// known-defects.json and readings.json of the folder, in this order, and the names of the files in
/// its families/; ranges.json; a file that is missing is an empty list.
/// @throws InputError with file, place and value; also when two defects of one version have the
/// same detector, scene and kind, and for the form without counts
KnownDefects read_known_defects(const std::filesystem::path& folder);

/// The three files, each under a temporary name, then renamed. @throws InputError with the path
/// when one cannot be
void write_known_defects(const std::filesystem::path& folder, const KnownDefects& known);

}  // namespace contactcheck::results
