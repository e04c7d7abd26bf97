#include "tests/gate_power/simulated_run.h"

#include <cmath>
#include <numbers>

namespace contactcheck::test {
namespace {

constexpr double kNanosecondsPerMicrosecond = 1e3;

// One side in a process of its own. `drift` goes on from where the side before has left it.
timing::Pass pass_of(const NoiseModel& model, std::size_t frames, double us, double& drift,
                     Noise& noise) {
  const double nanoseconds =
      us * kNanosecondsPerMicrosecond * std::exp(model.process_sigma * noise.normal());
  timing::Pass out;
  for (std::size_t f = 0; f < frames; ++f) {
    drift += model.drift_sigma * noise.normal();
    const bool spike = noise.uniform() < model.spike_share;
    const double sample = nanoseconds * std::exp(drift) *
                          std::exp(model.frame_sigma * noise.normal()) *
                          (spike ? model.spike_factor : 1.0);
    out.push_back({0.0, sample, 0.0});  // one phase is as good as three
  }
  return out;
}

}  // namespace

double Noise::normal() {
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

SimulatedRun simulate_run(const NoiseModel& model, const RunShape& shape, double detector_us,
                          double ratio, Noise& noise) {
  SimulatedRun run;
  run.reference.lazy_map = run.detector.lazy_map = true;
  for (std::size_t p = 0; p < shape.passes; ++p) {
    double drift = 0.0;
    const auto take = [&](timing::QuestionSamples& side, double us) {
      side.playback.push_back(pass_of(model, shape.frames, us, drift, noise));
    };
    const bool reference_first = noise.uniform() < 0.5;
    if (reference_first) take(run.reference, detector_us * ratio);
    take(run.detector, detector_us);
    if (!reference_first) take(run.reference, detector_us * ratio);
  }
  return run;
}

}  // namespace contactcheck::test
