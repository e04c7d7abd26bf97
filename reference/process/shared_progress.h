// A worker's progress in shared memory. It survives the worker's death, so that a crash is
// attributed to the right detector, frame and phase.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace contactcheck::process {

enum class Phase : std::uint32_t {
  kScene,
  kTruth,
  kPrepare,
  kMap,
  kUpdate,
  kQuery,
  kTrace,
  kDestroy,
  kDone
};

inline const char* name_of(Phase phase) {
  switch (phase) {
    case Phase::kScene:
      return "scene";
    case Phase::kTruth:
      return "truth";
    case Phase::kPrepare:
      return "prepare";
    case Phase::kMap:
      return "map";
    case Phase::kUpdate:
      return "update";
    case Phase::kQuery:
      return "query";
    case Phase::kTrace:
      return "trace";
    case Phase::kDestroy:
      return "destroy";
    case Phase::kDone:
      return "done";
  }
  return "unknown";
}

/// Where a worker was: "scene s, frame 2, phase update".
inline std::string place_text(const std::string& scene, std::size_t frame, Phase phase) {
  return "scene " + scene + ", frame " + std::to_string(frame) + ", phase " + name_of(phase);
}

/// Lives in a shared mapping; all members are lock-free atomics.
struct SharedProgress {
  static constexpr std::uint32_t kNoDetector = ~0u;

  std::atomic<std::uint32_t> detector{kNoDetector};  ///< position in the job's list
  /// The detector that ran last, also while the suite's own code runs: if it has corrupted memory,
  /// the crash may come there.
  std::atomic<std::uint32_t> last_detector{kNoDetector};
  std::atomic<std::uint32_t> frame{0};
  std::atomic<Phase> phase{Phase::kScene};
  std::atomic<std::uint64_t> ticks{0};      ///< grows with every step; a standstill means a hang
  std::atomic<std::uint32_t> permille{0};   ///< of the worker's work, for the progress bar
  std::atomic<std::int32_t> supervisor{0};  ///< its process id
};

static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

/// The worker's side.
class ProgressWriter {
 public:
  explicit ProgressWriter(SharedProgress* shared) : shared_(shared) {}
  void enter(std::uint32_t detector, std::size_t frame, Phase phase) {
    shared_->detector = detector;
    if (detector != SharedProgress::kNoDetector) shared_->last_detector = detector;
    shared_->frame = static_cast<std::uint32_t>(frame);
    shared_->phase = phase;
    ++shared_->ticks;
  }
  /// The next phase of the same detector and frame. Two plain stores, so that the timed pass can
  /// say between two calls where it is.
  void go_on(Phase phase) {
    shared_->phase.store(phase, std::memory_order_relaxed);
    const std::uint64_t ticks = shared_->ticks.load(std::memory_order_relaxed);  // its only writer
    shared_->ticks.store(ticks + 1, std::memory_order_relaxed);
  }
  std::size_t frame() const { return shared_->frame; }
  Phase phase() const { return shared_->phase; }
  void part(double share) { shared_->permille = static_cast<std::uint32_t>(share * 1000.0); }

 private:
  SharedProgress* shared_;
};

}  // namespace contactcheck::process
