// The untimed pass: every answer of a detector to every frame, judged.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/detect/detector.h"
#include "reference/compare/run_result.h"
#include "reference/oracle/oracle.h"
#include "reference/run/shared_progress.h"
#include "reference/scene/scene.h"

namespace contactcheck {

/// A scene with all its frames evaluated and judged by the oracle.
struct JudgedScene {
  const Scene* scene = nullptr;
  std::vector<std::vector<std::vector<Vec3>>> nodes;     ///< [frame][body]
  std::vector<std::vector<std::vector<Vec3>>> vertices;  ///< [frame][body], canonical mapping
  std::vector<Truth> truth;                              ///< per frame
  std::vector<bool> contact_frames;                      ///< some surfaces touch
  std::string refused;  ///< not empty: which body and frame hold a NaN or infinite node

  Frame frame(std::size_t index) const;
};

/// Maps and judges all frames. `truth_wanted` false leaves `truth` empty (timing processes).
/// Non-finite nodes end it: `refused` says where.
JudgedScene judge_scene(const Scene& scene, bool truth_wanted, ProgressWriter& progress);

/// What a detector costs per frame, roughly, from the untimed pass: picks its timed frames.
struct AccuracyOutcome {
  double seconds_per_frame = 0.0;
};

/// Runs `detector` over all frames and fills levels, stages, episodes, hash, memory and float
/// environment of `result`. The detector's own question (its first) is judged at every level;
/// bodies are judged by its answer to the question `body` where it has one: what is timed is
/// judged. Exceptions of the detector pass through; an answer that names a body or an element that
/// is not there throws std::runtime_error.
AccuracyOutcome run_accuracy(const JudgedScene& judged, std::uint32_t position, Detector& detector,
                             ProgressWriter& progress, RunResult& result);

/// Sets the hover gaps of `result.episodes`, bisecting time (scripted) or by frames (recorded).
void measure_hover_gaps(const JudgedScene& judged, std::uint32_t position, Detector& detector,
                        Oracle& oracle, ProgressWriter& progress, RunResult& result);

}  // namespace contactcheck
