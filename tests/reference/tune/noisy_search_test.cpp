// The search on a machine that spoils times, whose true costs are known.
#include <gtest/gtest.h>

#include "reference/tune/measuring.h"
#include "tests/reference/tune/grids.h"
#include "tests/reference/tune/noisy_machine.h"

namespace contactcheck::tune {
namespace {

using test::Grid;
using test::Noise;
using test::NoisyMachine;

constexpr std::size_t kPasses = 5;  ///< what `tune` does unless it is told otherwise
constexpr std::uint64_t kGrids = 25;
constexpr double kSame = 1.02;  ///< times the true cost of the cheapest: not worth a search

using Samples = std::map<std::size_t, timing::QuestionSamples>;

// One run of a batch beside the first candidate, which costs are taken against.
Samples run_beside_anchor(NoisyMachine& machine, const std::vector<std::size_t>& batch) {
  std::vector<std::size_t> entries = {0};
  for (const std::size_t i : batch)
    if (i != 0) entries.push_back(i);
  return machine.run(entries);
}

Measurement with_cost(Measurement m, const results::Ratio& cost) {
  m.beside_anchor = cost;
  return m;
}

// As Measuring does it.
Measure paired(const Grid& grid, NoisyMachine& machine) {
  CostBook book;
  book.set_unit(1.0);
  return [&grid, &machine, book](const std::vector<std::size_t>& batch) mutable {
    const Samples samples = run_beside_anchor(machine, batch);
    std::vector<Measurement> found;
    for (const std::size_t i : batch) {
      book.take(i, pair_up(samples.at(i), samples.at(0)));
      found.push_back(grid.truth[i]);
      book.price(i, {}, found.back());
    }
    return found;
  };
}

// What it is held against: sums over frames, each side for itself.
Measure apart(const Grid& grid, NoisyMachine& machine) {
  return [&](const std::vector<std::size_t>& batch) {
    const Samples samples = run_beside_anchor(machine, batch);
    const timing::TimedFrames no_contact = {std::vector<bool>(NoisyMachine::kFrames), {}};
    std::vector<Measurement> found;
    for (const std::size_t i : batch) {
      const results::Ratio r =
          timing::compute_speedup(samples.at(0), samples.at(i), no_contact).playback;
      found.push_back(with_cost(grid.truth[i], {1.0 / r.value, 1.0 / r.high, 1.0 / r.low}));
    }
    return found;
  };
}

struct Score {
  int right = 0;         ///< grids whose answer costs, in truth, what the cheapest costs
  std::size_t most = 0;  ///< measurements, of any grid
};

bool is_right(const Grid& grid, std::size_t candidate) {
  const double best = grid.truth[*grid.best(test::nothing_missed())].cost().ms;
  return test::nothing_missed().met_by(grid.truth[candidate]) &&
         grid.truth[candidate].cost().ms <= kSame * best;
}

template <class MakeMeasure>
Score score(const MakeMeasure& make_measure, std::size_t races, const Noise& noise) {
  Score score;
  for (std::uint64_t seed = 0; seed < kGrids; ++seed) {
    const Grid grid = test::random_grid(seed);
    NoisyMachine machine(grid, noise, kPasses, 1000 + seed);
    SearchSettings settings;
    settings.races = races;
    const SearchOutcome found =
        search(grid.candidates, test::nothing_missed(), settings, make_measure(grid, machine));
    score.right += is_right(grid, found.tried[*found.best].candidate);
    score.most = std::max(score.most, found.measurements);
  }
  return score;
}

struct Busy {
  double preempted;
  int right_before, right_after;  ///< at most, at least
};

// Times of neighbours in a pass are further apart than their frames: drift counts, too.
TEST(NoisySearch, PairsAndRacesAreRightMoreOftenThanSums) {
  for (const Busy& busy : {Busy{0.1, 24, 24}, Busy{0.25, 10, 19}}) {
    Noise noise;
    noise.preempted = busy.preempted;
    const Score before = score(apart, 0, noise), after = score(paired, 3, noise);
    EXPECT_LE(before.right, busy.right_before) << busy.preempted;
    EXPECT_GE(after.right, busy.right_after) << busy.preempted;
    EXPECT_LE(after.most, 200u / 5) << "races included";
  }
}

// A quiet machine: nothing is preempted, its speed stays, and no answer is left to chance.
TEST(NoisySearch, IsRightOnAQuietMachine) {
  Noise quiet;
  quiet.preempted = 0.0;
  quiet.wander = 0.0;
  EXPECT_EQ(score(paired, 3, quiet).right, static_cast<int>(kGrids));
}

}  // namespace
}  // namespace contactcheck::tune
