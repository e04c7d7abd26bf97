#include "tests/gate_power/simulated_run.h"

#include <cmath>
#include <numbers>

namespace contactcheck::test {
namespace {

constexpr double kNanosecondsPerMicrosecond = 1e3;

/// One side of one process.
class Side {
 public:
  Side(const NoiseModel& model, double us, Noise& noise)
      : model_(model),
        noise_(noise),
        nanoseconds_(us * kNanosecondsPerMicrosecond *
                     std::exp(model.process_sigma * noise.normal())) {
    samples_.lazy_map = true;  // one phase is as good as three
  }

  void take(std::size_t frame, double drift) {
    for (auto mode : {&FrameSamples::cold, &FrameSamples::hot})
      (samples_.frames[frame].*mode).push_back({0.0, sample(drift), 0.0});
  }
  const QuestionSamples& samples() const { return samples_; }

 private:
  double sample(double drift) {
    const bool spike = noise_.uniform() < model_.spike_share;
    return nanoseconds_ * drift * std::exp(model_.sample_sigma * noise_.normal()) *
           (spike ? model_.spike_factor : 1.0);
  }

  const NoiseModel& model_;
  Noise& noise_;
  double nanoseconds_;
  QuestionSamples samples_;
};

}  // namespace

double Noise::normal() {
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

SimulatedRun simulate_run(const NoiseModel& model, const RunShape& shape, double detector_us,
                          double ratio, Noise& noise) {
  SimulatedRun run;
  for (std::size_t p = 0; p < shape.processes; ++p) {
    Side reference(model, detector_us * ratio, noise), detector(model, detector_us, noise);
    double drift = 0.0;
    for (std::size_t f = 0; f < shape.frames; ++f)
      for (std::size_t r = 0; r < shape.repeats; ++r) {
        drift += model.drift_sigma * noise.normal();
        reference.take(f, std::exp(drift));
        detector.take(f, std::exp(drift));
      }
    run.reference.push_back(reference.samples());
    run.detector.push_back(detector.samples());
  }
  return run;
}

}  // namespace contactcheck::test
