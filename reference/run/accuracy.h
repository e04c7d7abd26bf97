// The untimed pass: every answer of a detector to every frame, judged.
#pragma once

#include <cstdint>

#include "core/detect/detector.h"
#include "reference/compare/judge.h"
#include "reference/results/results.h"
#include "reference/run/answer_print.h"
#include "reference/run/judged_scene.h"
#include "reference/run/rounded_scene.h"

namespace contactcheck {

/// What the untimed pass leaves beside a detector's row.
struct AccuracyOutcome {
  JudgedAnswers answers;  ///< to every question in every frame
  std::vector<FrameDifferences> differences = {};
  std::vector<Disagreement> disagreements = {};  ///< scene and detector left empty
};

/// Runs `detector` over all frames and fills levels, graded errors, stages, episodes, hash, memory,
/// notes and float environment of `run`.
///
/// The detector's own question (its first) is judged at every level; bodies are judged by its
/// answer to the question `body` where it has one: what is timed is judged. Depths and normals are
/// taken from its answer to the question `contacts`. A detector in single precision that is fed
/// vertices is judged a second time, against the truth for the values that it was fed (one that is
/// fed nodes alone maps vertices of its own, whose truth nobody else knows). Exceptions of the
/// detector pass through; an answer that names what is not there throws std::runtime_error.
AccuracyOutcome run_accuracy(JudgingTools& tools, std::uint32_t position, Detector& detector,
                             ProgressWriter& progress, results::Run& run);

}  // namespace contactcheck
