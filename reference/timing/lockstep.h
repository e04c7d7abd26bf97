// Times whole simulation steps in lockstep: the states of one recorded motion are restored, every
// detector runs one full step from each of them, and the result is discarded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/detect/detector.h"
#include "reference/process/shared_progress.h"
#include "reference/results/results.h"
#include "reference/scene/scene.h"

namespace contactcheck::timing {

/// One repeat of whole steps, summed over the timed steps, milliseconds.
struct StepSum {
  double mss = 0.0, cell = 0.0, test = 0.0, response = 0.0;
  double total() const { return mss + cell + test + response; }
};

struct LockstepEntry {
  std::uint32_t position = 0;  ///< in the job's list
  std::unique_ptr<Detector> detector;
  std::size_t steps = 0;      ///< timed ones; filled
  std::vector<StepSum> sums;  ///< per repeat; repeat r of all entries ran together; filled
  std::string error;          ///< what it threw; it is not called again and has no times
};

struct LockstepSettings {
  std::size_t steps = 40;  ///< of the motion, spread evenly over it
  std::size_t repeats = 5;
  std::size_t sweep_bytes = 0;  ///< read before each step
};

/// The motion is that of the scene's own driver. Within a repeat the entries take turns at every
/// step (A B C, next repeat B C A), all with cold caches.
/// @pre the scene is simulated; `driver` can drive it
/// @throws what the driver throws
void run_lockstep(const scene::Scene& scene, Detector& driver, const LockstepSettings& settings,
                  std::vector<LockstepEntry>& entries, process::ProgressWriter& progress);

/// Per step: medians over repeats, and the whole by repeat. @pre entry was timed and has no error
results::StepTimes step_times(const LockstepEntry& entry);

}  // namespace contactcheck::timing
