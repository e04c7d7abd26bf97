// The wrong answers that other libraries are known to give to hard cases, as a file that people
// explain and a command fills: fixtures/hard/known-defects.json.
#pragma once

#include <compare>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::results {

// Wrong answers to cases, one by one, as in results.json.

enum class SightingKind {
  kMissed,    ///< true contacts that the answer lacks
  kSpurious,  ///< contacts in the answer that are none
  kError      ///< no answer: it threw, crashed, hung or ran out of memory
};

/// "missed", "spurious", "error"
const char* name_of(SightingKind kind);

inline constexpr const char* kNoCase = "-";

/// A detector's wrong answer to a case of a family; or its error in a scene that is no family.
struct Sighting {
  std::string detector;
  std::string scene;  ///< or family
  SightingKind kind = SightingKind::kMissed;
  std::string value;  ///< of the family's parameter; kNoCase where there is none to blame

  auto operator<=>(const Sighting&) const = default;
};

/// What a run can tell about wrong answers.
struct SightingsOfRun {
  std::set<Sighting> seen;
  /// Every wrong answer that the run would have shown, were it there: of each detector that
  /// answered, all cases it was judged on.
  std::set<Sighting> possible;
};

/// Of families: every case at the finest level judged. Of other scenes: errors alone, since what a
/// detector misses there is its result and no fact of a library's version.
/// @throws InputError when a row's scene is not among the scenes, or a family has other cases than
/// a row of it
SightingsOfRun sightings_of(const results::Results& results);

/// One cause of wrong answers, in one version of one library.
struct KnownDefect {
  std::string library;   ///< as in results.json: "fcl"
  std::string version;   ///< the same: "0.7.0"
  std::string issue;     ///< who describes it: an issue's number or the place in the source
  SightingKind kind{};   ///< what it looks like
  std::string sentence;  ///< why
  /// Every case that shows it; sorted, all of this kind.
  std::vector<Sighting> seen;
};

struct KnownDefects {
  std::vector<KnownDefect> defects;
};

/// Does the defect already have sightings of that detector in that scene, of that kind? Then it is
/// the cause of all of them.
bool has_place_for(const KnownDefect& defect, const Sighting& sighting);

/// Issue and sentence of a defect that no person has looked at yet.
inline constexpr const char* kUnexplained = "not looked into yet";

/// A file that is missing is an empty list.
/// @throws InputError with file, place and value; also when two defects of one version
/// have the same detector, scene and kind
KnownDefects read_known_defects(const std::filesystem::path& file);

/// Under a temporary name, then renamed. @throws InputError with the path when it cannot be
void write_known_defects(const std::filesystem::path& file, const KnownDefects& known);

}  // namespace contactcheck::results
