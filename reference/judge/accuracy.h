// The untimed pass: computes the ground truth of every frame and compares every answer of a
// detector with it.
#pragma once

#include <cstdint>

#include "core/detect/detector.h"
#include "reference/judge/answer_fingerprint.h"
#include "reference/judge/judge.h"
#include "reference/judge/judged_scene.h"
#include "reference/judge/rounded_scene.h"
#include "reference/process/shared_progress.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// The share of judge_scene() in a worker's work, for the progress bar. Random pairs take long
/// enough for it to move.
constexpr double kShareOfTruth = 0.1;

/// Computes positions and ground truth of all frames. Stops at a non-finite node, and names its
/// place in `refused`.
JudgedScene judge_scene(const scene::Scene& scene, process::ProgressWriter& progress);

/// The outcome of the untimed pass, apart from the detector's row in the results.
struct AccuracyOutcome {
  JudgedAnswers answers;  ///< to every question in every frame
  std::vector<FrameDifferences> differences = {};
  std::vector<Disagreement> disagreements = {};  ///< scene and detector left empty
};

/// Runs `detector` over all frames and fills levels, graded errors, stages, episodes, hash, memory,
/// notes and float environment of `run`.
///
/// Each level is judged by the answer to its question (question_of), which is the answer that is
/// timed. Contact episodes come from the detector's first question, depths and normals from the
/// question `contacts`. A single-precision detector that is fed vertices is judged a second time,
/// against the truth for the values that it was fed; one that is fed nodes is not, because only the
/// detector knows its mapped vertices. Exceptions of the detector pass through. Throws
/// std::runtime_error for an answer that names elements that do not exist.
AccuracyOutcome run_accuracy(JudgingTools& tools, std::uint32_t position, Detector& detector,
                             process::ProgressWriter& progress, results::Run& run);

}  // namespace contactcheck::judge
