// How often the timing rules of the gate go red: for nothing, and for slow-downs of known size.
// Samples are simulated; speed-ups, their intervals and the verdicts are the program's own.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "reference/gate/policy.h"
#include "reference/gate/timing_rule.h"
#include "tests/gate_power/simulated_run.h"

namespace contactcheck::test {
namespace {

constexpr std::array<double, 6> kSlowdowns = {1.0, 1.05, 1.10, 1.20, 1.30, 2.0};
constexpr std::array<std::size_t, 4> kPasses = {3, 5, 9, 15};
constexpr NoiseModel kModels[] = {{"quiet machine", 0.02, 0.0005, 0.005, 0.005, 3.0},
                                  {"shared machine", 0.10, 0.0025, 0.02, 0.05, 3.0}};
constexpr std::size_t kFrames = 60;
constexpr int kTrials = 200;
constexpr std::uint64_t kSeed = 7;
constexpr double kFrameUs = 1000.0, kRatio = 10.0;
constexpr double kLimit = 1.05;  // of both rules: 5 % slower than it was, or than it may be

/// Of one rule and one slow-down.
struct Tally {
  int red = 0, open = 0;

  void add(const results::Ratio& slowness, std::size_t passes) {
    const gate::Rule
        rule;  // with the floor and the noise width that a policy has when it says nothing
    const gate::Verdict verdict =
        gate::judge_slowness({slowness, kFrameUs, passes}, {rule.floor_us, rule.noise_width})
            .verdict;
    red += verdict == gate::Verdict::kFail;
    open += verdict == gate::Verdict::kTooNoisy || verdict == gate::Verdict::kCannotJudge;
  }
  std::string text() const {
    const auto share = [](int n) { return 100.0 * n / kTrials; };
    return fmt::format("{:.1f} ({:.1f})", share(red), share(open));
  }
};

using Tallies = std::array<Tally, kSlowdowns.size()>;

results::Ratio measured(const NoiseModel& model, const RunShape& shape, Noise& noise) {
  const SimulatedRun run = simulate_run(model, shape, kFrameUs, kRatio, noise);
  const timing::TimedFrames frames = {std::vector<bool>(shape.frames, false), {}};
  return timing::compute_speedup(run.reference, run.detector, frames).playback;
}

// A detector that takes longer by a factor has the ratio of every pass divided by it: the same
// noise serves all slow-downs.
results::Ratio divided(const results::Ratio& r, double factor) {
  return {r.value / factor, r.low / factor, r.high / factor};
}

void one_trial(const NoiseModel& model, const RunShape& shape, Noise& noise, Tallies& against_limit,
               Tallies& against_baseline) {
  const results::Ratio before = measured(model, shape, noise), now = measured(model, shape, noise);
  for (std::size_t i = 0; i < kSlowdowns.size(); ++i) {
    const results::Ratio slower = divided(now, kSlowdowns[i]);
    against_limit[i].add(gate::slowness_of(slower, kRatio / kLimit), shape.passes);
    against_baseline[i].add(
        gate::over_limit(results::quotient(before, slower, shape.passes), kLimit), shape.passes);
  }
}

std::string table_line(const NoiseModel& model, const RunShape& shape, const char* rule,
                       const Tallies& tallies) {
  std::string line = fmt::format("| {} | {} | {} |", model.name, rule, shape.passes);
  for (const Tally& tally : tallies) line += " " + tally.text() + " |";
  return line + "\n";
}

std::string lines_of(const NoiseModel& model, const RunShape& shape) {
  Noise noise(kSeed);
  Tallies against_limit, against_baseline;
  for (int trial = 0; trial < kTrials; ++trial)
    one_trial(model, shape, noise, against_limit, against_baseline);
  return table_line(model, shape, "`speedup`", against_limit) +
         table_line(model, shape, "`slowdown`", against_baseline);
}

std::string head() {
  std::string titles = "| noise | rule | passes |", rule = "|---|---|---:|";
  for (const double slowdown : kSlowdowns) {
    titles += slowdown == 1.0 ? std::string(" no change |")
                              : fmt::format(" {:.0f} % slower |", 100.0 * (slowdown - 1.0));
    rule += "---:|";
  }
  return titles + "\n" + rule + "\n";
}

}  // namespace
}  // namespace contactcheck::test

int main() {
  using namespace contactcheck::test;
  std::fputs(head().c_str(), stdout);
  for (const NoiseModel& model : kModels)
    for (const std::size_t passes : kPasses)
      std::fputs(lines_of(model, {kFrames, passes}).c_str(), stdout);
  return 0;
}
