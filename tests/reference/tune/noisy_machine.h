// A machine whose clock is made up: what it times is known, and so is what spoils it.
//
// It is busy as one is that builds something beside: its speed differs from run to run and wanders
// within one, and one timed piece of work in ten is preempted for some milliseconds.
#pragma once

#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "tests/reference/tune/grids.h"

namespace contactcheck::test {

struct Noise {
  double preempted = 0.1;      ///< share of timed pieces of work
  double preemption_ms = 4.0;  ///< on average, exponential
  double runs_apart = 0.3;     ///< standard deviation of the logarithm of a run's speed
  double wander = 0.02;        ///< of the logarithm, from one piece of work to the next
  double every_sample = 0.02;  ///< of the logarithm
};

/// Its time goes on by the work that is done, faster or slower.
class SimulatedClock {
 public:
  SimulatedClock(const Noise& noise, std::uint64_t seed) : noise_(noise), random_(seed) {}

  double now_ms() const { return now_ms_; }
  void new_run() { log_speed_ = noise_.runs_apart * normal_(random_); }
  void work(double ms) {
    log_speed_ += noise_.wander * normal_(random_);
    log_speed_ *= 0.999;  // no machine becomes ever faster
    now_ms_ += ms * std::exp(log_speed_ + noise_.every_sample * normal_(random_));
    if (uniform_(random_) < noise_.preempted)
      now_ms_ -= noise_.preemption_ms * std::log(1.0 - uniform_(random_));
  }

 private:
  Noise noise_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  double now_ms_ = 0.0, log_speed_ = 0.0;
};

/// Times the candidates of a grid as the suite does: pass by pass, and in each pass one after
/// another, all frames in order. Every third frame holds contacts, and costs some detectors more
/// than others.
class NoisyMachine {
 public:
  static constexpr std::size_t kFrames = 13;  ///< the first one does not count

  NoisyMachine(const Grid& grid, const Noise& noise, std::size_t passes, std::uint64_t seed)
      : grid_(grid), passes_(passes), clock_(noise, seed) {}

  /// One run: samples of each that is named.
  std::map<std::size_t, timing::QuestionSamples> run(const std::vector<std::size_t>& entries) {
    clock_.new_run();
    std::map<std::size_t, timing::QuestionSamples> samples;
    for (std::size_t pass = 0; pass < passes_; ++pass)
      for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::size_t entry = entries[(i + pass) % entries.size()];
        samples[entry].playback.push_back(playback(entry));
      }
    return samples;
  }

 private:
  timing::Pass playback(std::size_t entry) {
    timing::Pass pass;
    for (std::size_t frame = 0; frame < kFrames; ++frame) {
      const double start = clock_.now_ms();
      clock_.work(true_ms(entry, frame));
      pass.push_back({0.0, 0.0, 1e6 * (clock_.now_ms() - start)});
    }
    return pass;
  }
  // In the mean over all frames but the first what the grid says.
  double true_ms(std::size_t candidate, std::size_t frame) const {
    const double in_contact = 1.0 + static_cast<double>(candidate % 4);
    const double share = (frame % 3 == 0 ? in_contact : 1.0) / ((2.0 + in_contact) / 3.0);
    return grid_.truth[candidate].cost().ms * share;
  }

  const Grid& grid_;
  std::size_t passes_;
  SimulatedClock clock_;
};

}  // namespace contactcheck::test
