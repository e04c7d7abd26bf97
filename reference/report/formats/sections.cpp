#include "reference/report/tables/section.h"

namespace contactcheck::report {

// Each is defined in the file of its table.
extern const Section kSummary, kDrawn, kBetweenFrames, kSpeedAgainstError, kLosses, kGoals,
    kHardCases, kKnownDefects, kClaims, kDetectors;

const std::vector<const Section*>& sections() {
  static constexpr Section kScenes = {"scenes", "", "", nullptr};
  static const std::vector<const Section*> all = {
      &kSummary, &kDrawn,  &kBetweenFrames, &kSpeedAgainstError,
      &kLosses,  &kGoals,  &kHardCases,     &kKnownDefects,
      &kClaims,  &kScenes, &kDetectors};
  return all;
}

}  // namespace contactcheck::report
