#include "reference/tune/paired_cost.h"

#include <algorithm>
#include <limits>

#include "core/types/check.h"
#include "reference/results/statistics.h"

namespace contactcheck::tune {
namespace {

constexpr std::size_t kPairsThatShowSpread = 3;

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
  return results::median(shares);
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
    sum += frame.weight * results::median(std::move(values));
    weights += frame.weight;
  }
  return sum / weights;
}

bool is_one_pair(const std::vector<FramePairs>& frames) {
  const auto& runs = frames.front().quotients;
  return frames.size() == 1 && runs.size() == 1 && runs.front().size() == 1;
}

}  // namespace

PairedRun pair_up(const timing::QuestionSamples& own, const timing::QuestionSamples& anchor) {
  PairedRun run;
  for (std::size_t p = 0; p < std::min(own.playback.size(), anchor.playback.size()); ++p) {
    const timing::Pass &mine = own.playback[p], &beside = anchor.playback[p];
    // A clock that has not ticked has seen a nanosecond at most.
    for (const std::size_t f : timing::played_frames(std::min(mine.size(), beside.size()))) {
      run[f].own.push_back(std::max(mine[f].total(), 1.0));
      run[f].anchor.push_back(std::max(beside[f].total(), 1.0));
    }
  }
  return run;
}

results::Ratio relative_cost(const std::vector<PairedRun>& runs) {
  CONTACTCHECK_INVARIANT(!runs.empty(), "a cost out of at least one run");
  const std::vector<FramePairs> frames = quotients_of(runs);
  const double cost = mean_cost(frames);
  if (is_one_pair(frames)) return {cost, 0.0, std::numeric_limits<double>::infinity()};
  std::size_t fewest = std::numeric_limits<std::size_t>::max();  // pairs of a frame
  for (const FramePairs& frame : frames)
    fewest = std::min(fewest, frame.quotients.front().size() * runs.size());
  const bool draws_frames = fewest < kPairsThatShowSpread;
  return results::bootstrap(cost, [&](results::Resampler& resampler) {
    std::vector<std::size_t> drawn;
    for (std::size_t i = 0; i < runs.size(); ++i) drawn.push_back(resampler.below(runs.size()));
    std::vector<FramePairs> again;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const FramePairs& frame = frames[draws_frames ? resampler.below(frames.size()) : i];
      std::vector<double> values;
      for (const std::size_t run : drawn)
        for (std::size_t r = 0; r < frame.quotients[run].size(); ++r)
          values.push_back(frame.quotients[run][resampler.below(frame.quotients[run].size())]);
      again.push_back({frame.weight, {std::move(values)}});
    }
    return mean_cost(again);
  });
}

}  // namespace contactcheck::tune
