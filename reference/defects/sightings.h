// Wrong answers to cases, one by one, as they stand in results.json.
#pragma once

#include <compare>
#include <set>
#include <string>

#include "reference/results/results.h"

namespace contactcheck {

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

}  // namespace contactcheck
