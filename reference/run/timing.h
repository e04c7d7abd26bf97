// The timed pass: detectors interleaved, cold and hot, phase by phase.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/detect/detector.h"
#include "reference/compare/speedup.h"
#include "reference/run/answer_print.h"
#include "reference/run/job.h"
#include "reference/run/judged_scene.h"
#include "reference/run/shared_progress.h"

namespace contactcheck {

/// One detector with one question in the timed pass.
struct TimedEntry {
  std::uint32_t position = 0;    ///< in the job's list
  Detector* detector = nullptr;  ///< prepared
  Question question = Question::kTriangles;
  bool own = true;  ///< whether this is the detector's own question
  /// Per frame of the scene, the answer that was judged; null: there is none to compare with.
  const std::vector<AnswerPrint>* judged = nullptr;
  std::size_t frames = 0;   ///< length of its prefix of the timing order
  QuestionSamples samples;  ///< filled
  std::string error;        ///< what was wrong while it was timed; it is not called again
};

/// Reads and writes a buffer of stated size, so that the next call finds little of its data in
/// the private caches (a large shared cache may keep it).
class CacheSweep {
 public:
  explicit CacheSweep(std::size_t bytes) : buffer_(bytes / sizeof(std::uint64_t), 1) {}
  void run();

 private:
  std::vector<std::uint64_t> buffer_;
  std::uint64_t sum_ = 0;
};

/// Per frame (in `order`) and repeat, every entry that is timed on this frame runs once cold (after
/// a sweep) and once hot (the same frame again; update() invalidates per-frame caches). The order
/// of the entries is rotated from repeat to repeat: A B C, B C A, ...
///
/// An answer that was timed must be the one that was judged, or the entry ends in an error. Of the
/// cold answer only the sizes of its lists are read, before the hot call; the hot answer is
/// compared record by record, after it: what it leaves in the caches the next sweep takes out.
void run_timing(const JudgedScene& judged, const std::vector<std::size_t>& order,
                std::size_t repeats, std::size_t sweep_bytes, std::vector<TimedEntry>& entries,
                ProgressWriter& progress);

}  // namespace contactcheck
