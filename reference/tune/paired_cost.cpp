#include "reference/tune/paired_cost.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

#include "core/types/check.h"
#include "core/types/median.h"

namespace contactcheck {
namespace {

constexpr int kDraws = 400;
constexpr std::size_t kPairsThatShowSpread = 3;
constexpr double kNormal95 = 1.96;    ///< standard deviations to either side
constexpr double kMedian95 = 1.2533;  ///< a median is so many times as uncertain as a mean, at most

// The anchor's share of a frame in the time of all, and the quotients of the frame's pairs by run.
struct FramePairs {
  double weight = 0.0;
  std::vector<std::vector<double>> quotients;
};

std::vector<std::size_t> shared_frames(const std::vector<PairedRun>& runs) {
  std::vector<std::size_t> frames;
  for (const auto& [frame, pairs] : runs.front())
    if (std::all_of(runs.begin(), runs.end(),
                    [&](const PairedRun& r) { return r.contains(frame); }))
      frames.push_back(frame);
  return frames;
}

double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

// Runs are of different speeds: each says how its own time is shared out.
double weight_of(std::size_t frame, const std::vector<std::size_t>& frames,
                 const std::vector<PairedRun>& runs) {
  std::vector<double> shares;
  for (const PairedRun& run : runs) {
    double whole = 0.0;
    for (const std::size_t f : frames) whole += least(run.at(f).anchor);
    shares.push_back(least(run.at(frame).anchor) / whole);
  }
  return median(shares);
}

std::vector<FramePairs> quotients_of(const std::vector<PairedRun>& runs) {
  const std::vector<std::size_t> frames = shared_frames(runs);
  CONTACTCHECK_INVARIANT(!frames.empty(), "runs that share a frame");
  std::vector<FramePairs> all;
  for (const std::size_t frame : frames) {
    FramePairs& pairs = all.emplace_back();
    pairs.weight = weight_of(frame, frames, runs);
    for (const PairedRun& run : runs) {
      std::vector<double>& quotients = pairs.quotients.emplace_back();
      const PairedFrame& timed = run.at(frame);
      for (std::size_t r = 0; r < timed.own.size(); ++r)
        quotients.push_back(timed.own[r] / timed.anchor[r]);
    }
  }
  return all;
}

double mean_cost(const std::vector<FramePairs>& frames) {
  double sum = 0.0, weights = 0.0;
  for (const FramePairs& frame : frames) {
    std::vector<double> values;
    for (const auto& run : frame.quotients) values.insert(values.end(), run.begin(), run.end());
    sum += frame.weight * median(std::move(values));
    weights += frame.weight;
  }
  return sum / weights;
}

bool is_one_pair(const std::vector<FramePairs>& frames) {
  const auto& runs = frames.front().quotients;
  return frames.size() == 1 && runs.size() == 1 && runs.front().size() == 1;
}

/// Draws again what might have been measured as well.
class Bootstrap {
 public:
  explicit Bootstrap(const std::vector<FramePairs>& frames) : frames_(frames) {
    std::size_t fewest = frames.front().quotients.front().size() * runs();
    for (const FramePairs& frame : frames)
      fewest = std::min(fewest, frame.quotients.front().size() * runs());
    draws_frames_ = fewest < kPairsThatShowSpread;
  }

  double draw() {
    std::vector<std::size_t> runs_drawn;
    for (std::size_t i = 0; i < runs(); ++i) runs_drawn.push_back(below(runs()));
    double sum = 0.0, weights = 0.0;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const FramePairs& frame = frames_[draws_frames_ ? below(frames_.size()) : i];
      std::vector<double> values;
      for (const std::size_t run : runs_drawn)
        for (std::size_t r = 0; r < frame.quotients[run].size(); ++r)
          values.push_back(frame.quotients[run][below(frame.quotients[run].size())]);
      sum += frame.weight * median(std::move(values));
      weights += frame.weight;
    }
    return sum / weights;
  }

 private:
  std::size_t runs() const { return frames_.front().quotients.size(); }
  // std::uniform_int_distribution differs between standard libraries; a modulo of 64 bits does not.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

  const std::vector<FramePairs>& frames_;
  bool draws_frames_ = false;
  std::mt19937_64 random_{20131};
};

// Student's t with so many degrees of freedom, of a 95 % interval: from a table, and beyond it the
// first terms of its expansion about the normal distribution (1e-2 off at 5, less beyond).
double student95(std::size_t freedom) {
  constexpr double kTable[] = {12.706, 4.303, 3.182, 2.776};
  if (freedom <= std::size(kTable)) return kTable[freedom - 1];
  const double n = static_cast<double>(freedom), z = kNormal95, cube = z * z * z;
  return z + (cube + z) / (4.0 * n) + (5.0 * cube * z * z + 16.0 * cube + 3.0 * z) / (96.0 * n * n);
}

// The standard deviation of the logarithms of what the runs say.
double spread_of(const std::vector<Ratio>& runs) {
  const double count = static_cast<double>(runs.size());
  double mean = 0.0, squares = 0.0;
  for (const Ratio& r : runs) mean += std::log(r.ratio) / count;
  for (const Ratio& r : runs) squares += (std::log(r.ratio) - mean) * (std::log(r.ratio) - mean);
  return std::sqrt(squares / (count - 1.0));
}

}  // namespace

PairedRun pair_up(const ProcessSamples& own, const ProcessSamples& anchor) {
  PairedRun run;
  for (std::size_t p = 0; p < std::min(own.size(), anchor.size()); ++p)
    for (const auto& [frame, samples] : own[p].frames) {
      const auto beside = anchor[p].frames.find(frame);
      if (beside == anchor[p].frames.end()) continue;
      const std::size_t repeats = std::min(samples.cold.size(), beside->second.cold.size());
      // A clock that has not ticked has seen a nanosecond at most.
      for (std::size_t r = 0; r < repeats; ++r) {
        run[frame].own.push_back(std::max(samples.cold[r].total(), 1.0));
        run[frame].anchor.push_back(std::max(beside->second.cold[r].total(), 1.0));
      }
    }
  return run;
}

Ratio relative_cost(const std::vector<PairedRun>& runs) {
  CONTACTCHECK_INVARIANT(!runs.empty(), "a cost out of at least one run");
  const std::vector<FramePairs> frames = quotients_of(runs);
  Ratio out;
  out.ratio = mean_cost(frames);
  if (is_one_pair(frames)) return {out.ratio, 0.0, std::numeric_limits<double>::infinity()};
  Bootstrap bootstrap(frames);
  std::vector<double> draws;
  for (int i = 0; i < kDraws; ++i) draws.push_back(bootstrap.draw());
  std::sort(draws.begin(), draws.end());
  out.low = std::min(out.ratio, draws[static_cast<std::size_t>(0.025 * kDraws)]);
  out.high = std::max(out.ratio, draws[static_cast<std::size_t>(0.975 * kDraws)]);
  return out;
}

Ratio middle_of(const std::vector<Ratio>& runs) {
  CONTACTCHECK_INVARIANT(!runs.empty(), "the middle of something");
  if (runs.size() == 1) return runs.front();
  const double count = static_cast<double>(runs.size());
  std::vector<double> ratios;
  double below = 0.0, above = 0.0;  // mean squares of what each run says of itself
  for (const Ratio& r : runs) {
    ratios.push_back(r.ratio);
    below += std::pow(std::log(r.ratio / r.low), 2) / count;
    above += std::pow(std::log(r.high / r.ratio), 2) / count;
  }
  const double apart = student95(runs.size() - 1) * spread_of(runs);
  const auto widened = [&](double squares) {
    return std::exp(kMedian95 * std::max(apart, std::sqrt(squares)) / std::sqrt(count));
  };
  const double ratio = median(ratios);
  return {ratio, ratio / widened(below), ratio * widened(above)};
}

Ratio product(const Ratio& a, const Ratio& b) {
  const double ratio = a.ratio * b.ratio;
  const double below = std::hypot(std::log(a.ratio / a.low), std::log(b.ratio / b.low));
  const double above = std::hypot(std::log(a.high / a.ratio), std::log(b.high / b.ratio));
  return {ratio, ratio * std::exp(-below), ratio * std::exp(above)};
}

}  // namespace contactcheck
