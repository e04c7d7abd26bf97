// The named cases that every detector is put through. Each says what is true in it; cases_test.cpp
// holds that against the oracle, so that a case is what its name says.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// What is asked about: a frame, or the step from a frame to the next.
enum class Moment { kFrame, kStep };

/// Counts of the oracle's sets for one frame, contact closed.
struct CaseTruth {
  std::size_t bodies = 0, triangles = 0, containment = 0, vertices = 0;
  bool operator==(const CaseTruth&) const = default;
};

/// Counts of the oracle's sets for one step.
struct StepCaseTruth {
  std::size_t bodies = 0, triangles = 0, vertices = 0, edges = 0, self_vertices = 0, self_edges = 0;
  /// When the first two bodies meet, a fraction of the step.
  std::optional<double> first = std::nullopt;
};

struct Case {
  std::string name;
  std::vector<Body> bodies;
  std::vector<FrameData> frames;
  std::vector<CaseTruth> truth;           ///< per frame; empty of a case about steps
  std::vector<StepCaseTruth> steps = {};  ///< per step; empty of a case about frames
};

/// How many frames, or steps, a case has.
std::size_t count_of(const Case& scene, Moment of);

/// A group of cases that one test goes through.
enum class CaseGroup { kFew, kTouching, kOverlapping, kSeparate, kMany, kDegenerate, kSizes };

std::vector<Case> cases_of(CaseGroup group);
const std::vector<Case>& all_cases();

/// The cases of contact within steps. Their names begin with "step-".
const std::vector<Case>& step_cases();

/// Three bodies that deform and meet in 6 frames, from apart to deep inside one another: for the
/// checks of order, repetition and threads.
const Case& moving_case();
/// The same for steps, five of them: of smaller meshes, since elements meet by the hundreds.
const Case& moving_step_case();

}  // namespace contactcheck::test
