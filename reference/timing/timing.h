// One detector timed in one pass: frame after frame, or step after step, phase by phase.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/detect/detector.h"
#include "reference/judge/answer_fingerprint.h"
#include "reference/process/shared_progress.h"
#include "reference/scene/scene.h"
#include "reference/timing/cache_sweep.h"
#include "reference/timing/speedup.h"

namespace contactcheck::timing {

struct PassRequest {
  std::uint32_t position = 0;  ///< of the detector in the job's list
  judge::Asked asked;
  std::vector<std::size_t> frames;  ///< in this order; of a question of steps: where these begin
  const std::vector<judge::AnswerFingerprint>* judged = nullptr;  ///< by frame of the scene
  CacheSweep* sweep = nullptr;  ///< before each frame; none: nothing is flushed
  std::size_t threads = 1;      ///< that the detector may use
  bool children = false;        ///< it may have processes of its own, whose CPU time counts
};

/// Maps, updates and asks a prepared detector. Of steps in a row each frame is mapped once. Between
/// the frames its answers are compared with those that were judged.
/// @throws std::runtime_error when an answer is another one than was judged, or the CPU time says
/// that the time of its calls is not what it costs (cpu_time.h); whatever the detector throws
Pass time_pass(const scene::Scene& scene, const PassRequest& request, Detector& detector,
               process::ProgressWriter& progress);

}  // namespace contactcheck::timing
