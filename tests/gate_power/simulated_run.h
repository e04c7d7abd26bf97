// Time samples of a reference and a detector as a run would take them, under a stated noise model.
#pragma once

#include <cstdint>
#include <random>

#include "reference/timing/speedup.h"

namespace contactcheck::test {

/// Every part is a factor of the time of one frame; sigma: of its logarithm.
struct NoiseModel {
  const char* name;
  double frame_sigma;    ///< of each frame alone
  double drift_sigma;    ///< per frame of a random walk; the two sides follow one another on it
  double process_sigma;  ///< of all frames of one side in one process: where its memory lies
  double spike_share;    ///< of frames that an interrupt falls into
  double spike_factor;   ///< how long such a frame takes
};

struct RunShape {
  std::size_t frames, passes;
};

struct SimulatedRun {
  timing::QuestionSamples reference, detector;
};

/// The raw output of mt19937_64, which the standard fixes, and logarithms: the same table for every
/// standard library.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : random_(seed) {}
  /// Uniform in (0, 1).
  double uniform() { return (static_cast<double>(random_() >> 12) + 0.5) * 0x1p-52; }
  double normal();

 private:
  std::mt19937_64 random_;
};

/// Frames of `detector_us`, of which the reference takes `ratio` times as long.
SimulatedRun simulate_run(const NoiseModel& model, const RunShape& shape, double detector_us,
                          double ratio, Noise& noise);

}  // namespace contactcheck::test
