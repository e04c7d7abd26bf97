// The named cases that every detector is put through. Each says what is true in it; cases_test.cpp
// holds that against the oracle, so that a case is what its name says.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// Counts of the oracle's sets for one frame, contact closed.
struct CaseTruth {
  std::size_t bodies = 0, triangles = 0, containment = 0, vertices = 0;
  bool operator==(const CaseTruth&) const = default;
};

struct Case {
  std::string name;
  std::vector<Body> bodies;
  std::vector<FrameData> frames;
  std::vector<CaseTruth> truth;  ///< per frame
};

/// A group of cases that one test goes through.
enum class CaseGroup { kFew, kTouching, kOverlapping, kSeparate, kMany, kDegenerate, kSizes };

std::vector<Case> cases_of(CaseGroup group);
const std::vector<Case>& all_cases();

/// Three bodies that deform and meet in 6 frames, from apart to deep inside one another: for the
/// checks of order, repetition and threads.
const Case& moving_case();

}  // namespace contactcheck::test
