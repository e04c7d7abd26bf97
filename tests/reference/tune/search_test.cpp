// The search against measuring everything.
#include "reference/tune/search.h"

#include <gmock/gmock.h>

#include "tests/reference/tune/grids.h"

namespace contactcheck::tune {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Search, FindsWhatMeasuringEverythingFindsWithAFifthOfTheMeasurements) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const test::Grid grid = test::random_grid(seed);
    const Measure measure = grid.measure();
    const SearchOutcome found = search(grid.candidates, test::nothing_missed(), {}, measure);
    ASSERT_TRUE(found.best) << seed;
    EXPECT_EQ(found.tried[*found.best].candidate, *grid.best(test::nothing_missed())) << seed;
    EXPECT_LE(found.tried.size(), grid.candidates.size() / 5) << seed;
    EXPECT_FALSE(found.exhausted);
  }
}

// Two deformers: a hundred times the dearest detector, and nothing.
TEST(Search, MeasuresNothingWhoseStepAloneIsDearerThanTheBest) {
  test::Grid grid;
  const test::Grid detectors = test::random_grid(5);
  const double dearest =
      std::max_element(detectors.truth.begin(), detectors.truth.end(),
                       [](auto& a, auto& b) { return a.cost().ms < b.cost().ms; })
          ->cost()
          .ms;
  const auto dear_step = std::make_shared<ModelCost>();
  dear_step->step = {100.0 * dearest, 100.0 * dearest, 100.0 * dearest};
  for (std::size_t i = 0; i < detectors.candidates.size(); ++i)
    for (const bool dear : {false, true}) {
      grid.candidates.push_back(detectors.candidates[i]);
      grid.truth.push_back(detectors.truth[i]);
      grid.candidates.back().choices.push_back({"deformer", dear ? "dear" : "cheap"});
      if (!dear) continue;
      grid.candidates.back().usual = false;
      grid.candidates.back().step = dear_step->step;
      grid.truth.back().model = dear_step;
    }
  const SearchOutcome found = search(grid.candidates, test::nothing_missed(), {}, grid.measure());
  EXPECT_EQ(found.tried[*found.best].candidate, *grid.best(test::nothing_missed()));
  for (const Tried& tried : found.tried) EXPECT_EQ(grid.candidates[tried.candidate].step.ms, 0.0);
  EXPECT_LE(found.tried.size(), 40u);
}

// Noise has made one that is not the cheapest look so; measured again it does not.
TEST(Search, MeasuresAgainWhatCannotBeToldFromTheBest) {
  test::Grid grid = test::random_grid(7);
  for (Measurement& m : grid.truth) {
    m.beside_anchor.low *= 0.99;
    m.beside_anchor.high *= 1.01;
  }
  const std::size_t best = *grid.best(test::nothing_missed());
  std::size_t lucky = 0;  // as it is, so that it is measured at once
  while (!grid.candidates[lucky].usual || !test::nothing_missed().met_by(grid.truth[lucky]))
    ++lucky;
  ASSERT_NE(lucky, best);
  int times = 0;
  const Measure measure = [&](const std::vector<std::size_t>& batch) {
    std::vector<Measurement> found = grid.measure()(batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (batch[i] != lucky || ++times > 1) continue;
      const double cheapest = grid.truth[best].cost().ms, own = grid.truth[lucky].cost().ms;
      found[i].beside_anchor = {0.95 * cheapest, 0.9 * cheapest, 2.0 * own};
    }
    return found;
  };
  SearchSettings unraced;
  unraced.races = 0;
  EXPECT_EQ(search(grid.candidates, test::nothing_missed(), unraced, measure).tried.front().times,
            1u);
  EXPECT_EQ(times, 1);
  times = 0;
  const SearchOutcome found = search(grid.candidates, test::nothing_missed(), {}, measure);
  EXPECT_EQ(found.tried[*found.best].candidate, best);
  EXPECT_GT(times, 1);
  EXPECT_GT(found.measurements, found.tried.size());
}

TEST(Search, RacesNoLongerThanMayBeMeasured) {
  test::Grid grid = test::random_grid(7);
  for (Measurement& m : grid.truth)
    m.beside_anchor.high = 1e9;  // nothing is ever told from anything
  SearchSettings settings;
  for (const std::size_t most : {30u, 33u, 100u}) {
    settings.most = most;
    const SearchOutcome found =
        search(grid.candidates, test::nothing_missed(), settings, grid.measure());
    EXPECT_LE(found.measurements, most);
    EXPECT_GT(found.measurements, found.tried.size()) << "a race was held";
  }
}

TEST(Search, MeasuresNothingTwiceThatIsToldApart) {
  const test::Grid grid = test::random_grid(7);
  std::vector<int> measured(grid.candidates.size());
  const Measure measure = [&](const std::vector<std::size_t>& batch) {
    for (const std::size_t i : batch) ++measured[i];
    return grid.measure()(batch);
  };
  search(grid.candidates, test::nothing_missed(), {}, measure);
  EXPECT_LE(*std::max_element(measured.begin(), measured.end()), 1);
}

TEST(Search, EndsWithoutAnAnswerWhereNothingMeetsTheLimits) {
  test::Grid grid = test::random_grid(1);
  for (Measurement& m : grid.truth) m.missed = 1;
  const SearchOutcome found = search(grid.candidates, test::nothing_missed(), {}, grid.measure());
  EXPECT_FALSE(found.best);
  EXPECT_LT(found.tried.size(), grid.candidates.size()) << "it sees that there is no hope";
}

TEST(Search, StopsAtTheMostThatMayBeMeasuredAndSaysSo) {
  const test::Grid grid = test::random_grid(2);
  SearchSettings settings;
  settings.most = 6;
  const SearchOutcome found =
      search(grid.candidates, test::nothing_missed(), settings, grid.measure());
  EXPECT_THAT(found.tried, SizeIs(6));
  EXPECT_TRUE(found.exhausted);
}

TEST(Search, PassesOverWhatFails) {
  test::Grid grid = test::random_grid(3);
  const std::size_t best = *grid.best(test::nothing_missed());
  grid.truth[best] = {};
  grid.truth[best].failure = "error: crashed";
  const SearchOutcome found = search(grid.candidates, test::nothing_missed(), {}, grid.measure());
  EXPECT_EQ(found.tried[*found.best].candidate, *grid.best(test::nothing_missed()));
}

TEST(Search, AllFailing) {
  test::Grid grid = test::random_grid(3);
  for (Measurement& m : grid.truth) m.failure = "refused: NaN";
  const SearchOutcome found = search(grid.candidates, test::nothing_missed(), {}, grid.measure());
  EXPECT_FALSE(found.best);
  EXPECT_THAT(pareto_front(found.tried), IsEmpty());
}

Tried tried(double cost, std::uint64_t missed, double hover) {
  Tried out;
  out.measurement.beside_anchor = {cost, cost, cost};
  out.measurement.missed = missed;
  out.measurement.hover = hover;
  return out;
}

TEST(ParetoFront, HoldsWhatNothingBeatsInEverything) {
  const std::vector<Tried> all = {tried(3.0, 0, 0.0), tried(1.0, 9, 0.1), tried(2.0, 9, 0.1),
                                  tried(2.0, 0, 0.2), tried(4.0, 0, 0.0)};
  EXPECT_THAT(pareto_front(all), ElementsAre(1, 3, 0));
}

TEST(Limits, EachOfThemCounts) {
  Measurement m;
  m.missed = 2;
  m.spurious = 3;
  m.hover = 0.004;
  m.late_frames = -2;
  m.deviation = 0.01;
  EXPECT_TRUE(Limits{}.met_by(m));
  Limits exact{2, 3, 0.004, 0.01, 2};
  EXPECT_TRUE(exact.met_by(m));
  const auto one_less = [&](auto change) {
    Limits less = exact;
    change(less);
    return less.met_by(m);
  };
  EXPECT_FALSE(one_less([](Limits& l) { l.missed = 1; }));
  EXPECT_FALSE(one_less([](Limits& l) { l.spurious = 2; }));
  EXPECT_FALSE(one_less([](Limits& l) { l.hover = 0.003; }));
  EXPECT_FALSE(one_less([](Limits& l) { l.deviation = 0.009; }));
  EXPECT_FALSE(one_less([](Limits& l) { l.late_frames = 1; }));
  m.failure = "error: crashed";
  EXPECT_FALSE(Limits{}.met_by(m));
}

}  // namespace
}  // namespace contactcheck::tune
