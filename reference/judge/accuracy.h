// The untimed pass: ground truth of every frame, every answer of a detector to every frame, and the
// comparison of the two.
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

/// The share of judge_scene() in a worker's work, for the progress bar; random pairs take long
/// enough for it to move.
constexpr double kShareOfTruth = 0.1;

/// Computes positions and ground truth of all frames. A non-finite node ends it: `refused` says
/// where.
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
/// Each level is judged by the answer to its question (question_of), which is the one that is
/// timed. Episodes of contact are those of the detector's first question. Depths and normals are
/// taken from its answer to the question `contacts`. A detector in single precision that is fed
/// vertices is judged a second time, against the truth for the values that it was fed; one that is
/// fed nodes maps vertices of its own, which only it knows. Exceptions of the detector pass
/// through. An answer that names elements that do not exist throws std::runtime_error.
AccuracyOutcome run_accuracy(JudgingTools& tools, std::uint32_t position, Detector& detector,
                             process::ProgressWriter& progress, results::Run& run);

}  // namespace contactcheck::judge
