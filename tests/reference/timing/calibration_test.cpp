// Do intervals of speed-ups cover the true ratio as often as they say? Simulated passes, whose
// truth is known, through compute_speedup.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reference/timing/speedup.h"

namespace contactcheck::timing {
namespace {

constexpr std::size_t kPasses = 5, kFrames = 60;
constexpr int kSimulations = 1000;
constexpr double kTrueRatio = 3.0;
constexpr double kFrameNoise = 0.05;    ///< standard deviation of the logarithm
constexpr double kContaminated = 0.05;  ///< share of frames that something else slowed down

/// The same draws on every platform.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}

  double uniform() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53; }
  double normal() {
    return std::sqrt(-2.0 * std::log(uniform())) * std::cos(6.283185307179586 * uniform());
  }

 private:
  std::mt19937_64 random_;
};

/// Each pass is faster or slower as a whole: a fresh process has its memory elsewhere.
struct Side {
  double milliseconds = 1.0;    ///< of a frame without contact
  double process_effect = 0.0;  ///< standard deviation of the logarithm
  bool noise = true;            ///< and contamination
};

bool in_contact(std::size_t frame) { return frame >= 40; }

Pass pass_of(const Side& side, Draws& draws) {
  Pass pass;
  const double process = std::exp(side.process_effect * draws.normal());
  for (std::size_t f = 0; f < kFrames; ++f) {
    double ms = side.milliseconds * process * (in_contact(f) ? 3.0 : 1.0);
    if (side.noise) {
      ms *= std::exp(kFrameNoise * draws.normal());
      if (draws.uniform() < kContaminated) ms *= 1.5 + 8.5 * draws.uniform();
    }
    pass.push_back({0.0, 0.0, 1e6 * ms});
  }
  return pass;
}

QuestionSamples samples_of(const Side& side, Draws& draws) {
  QuestionSamples samples;
  for (std::size_t p = 0; p < kPasses; ++p) samples.playback.push_back(pass_of(side, draws));
  return samples;
}

struct Coverage {
  double all = 0.0, contact = 0.0;  ///< shares of the intervals that contain the true ratio
  double half_width = 0.0;          ///< of all frames, as a logarithm, in the mean
};

Coverage coverage(double reference_effect, double detector_effect, bool noise = true) {
  TimedFrames frames;
  for (std::size_t f = 0; f < kFrames; ++f) frames.contact.push_back(in_contact(f));
  Draws draws(2013);
  const auto covers = [](const results::Ratio& r) {
    return r.low <= kTrueRatio && kTrueRatio <= r.high;
  };
  int all = 0, contact = 0;
  double half_widths = 0.0;
  for (int i = 0; i < kSimulations; ++i) {
    const QuestionSamples reference = samples_of({kTrueRatio, reference_effect, noise}, draws),
                          detector = samples_of({1.0, detector_effect, noise}, draws);
    const results::Speedup speedup = compute_speedup(reference, detector, frames);
    all += covers(speedup.playback);
    contact += covers(*speedup.contact_frames);
    half_widths += 0.5 * std::log(speedup.playback.high / speedup.playback.low);
  }
  return {static_cast<double>(all) / kSimulations, static_cast<double>(contact) / kSimulations,
          half_widths / kSimulations};
}

// Of a t interval over five normal logarithms, in the mean: Student's t of 4 degrees of freedom,
// and c4(5), by which the deviation of five falls short of the true one.
double expected_half_width(double deviation) {
  return 2.776 * 0.940 * deviation / std::sqrt(static_cast<double>(kPasses));
}

// The true ratio is that of the milliseconds of a frame, 3. Contamination lengthens a pass of
// either side by the same factor in distribution (as the frames' noise does), since frames share
// out the time of both sides alike: the logarithm of a pass's ratio is log 3 and the difference of
// two numbers of one distribution, so its mean is log 3. Process effects add a difference of mean
// 0.
TEST(Calibration, IntervalOfFivePassesCoversTheTrueRatioAsOftenAsItSays) {
  struct Effects {
    double reference, detector;
  };
  for (const Effects& e :
       {Effects{0.0, 0.0}, Effects{0.005, 0.0}, Effects{0.005, 0.005}, Effects{0.02, 0.0},
        Effects{0.02, 0.02}, Effects{0.04, 0.0}, Effects{0.0, 0.04}, Effects{0.04, 0.04}}) {
    const Coverage found = coverage(e.reference, e.detector);
    for (const double share : {found.all, found.contact}) {
      EXPECT_GE(share, 0.92) << e.reference << " beside " << e.detector;
      EXPECT_LE(share, 0.98) << e.reference << " beside " << e.detector;
    }
    // An interval that says nothing always covers. By contamination a frame deviates by 0.95 of its
    // mean, and a pass of 59 frames, of which 20 take three times as long, by 0.14.
    const double expected =
        expected_half_width(std::hypot(std::sqrt(2.0) * 0.14, e.reference, e.detector));
    EXPECT_NEAR(found.half_width, expected, 0.1 * expected) << e.reference << " " << e.detector;
  }
}

TEST(Calibration, HalfWidthOfFivePassesFollowsTheProcessEffect) {
  for (const double effect : {0.005, 0.02, 0.04}) {
    const double expected = expected_half_width(std::sqrt(2.0) * effect);
    EXPECT_NEAR(coverage(effect, effect, false).half_width, expected, 0.05 * expected) << effect;
  }
}

}  // namespace
}  // namespace contactcheck::timing
