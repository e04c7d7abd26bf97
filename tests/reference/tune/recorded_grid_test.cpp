// The search over the measurements of a real run, against that run, which measured everything.
#include "tests/reference/tune/recorded_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace contactcheck::tune {
namespace {

const test::Grid& grid() {
  static const test::Grid recorded =
      test::recorded_grid(std::filesystem::path(CONTACTCHECK_FIXTURES) / "tune/bunny-touch.json");
  return recorded;
}

struct Case {
  const char* name;
  Limits limits;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class RecordedGrid : public ::testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(
    Limits, RecordedGrid,
    ::testing::Values(Case{"NothingMissed", Limits{0, {}, {}, {}, {}}},
                      Case{"NothingMissedInTheScenesOwnModel", Limits{0, {}, {}, 0.0, {}}},
                      Case{"NothingMissedNorMadeUp", Limits{0, 0, {}, {}, {}}},
                      Case{"AtMostTwoMissed", Limits{2, {}, {}, {}, {}}}, Case{"Any", Limits{}}),
    [](const auto& p) { return std::string(p.param.name); });

TEST(Recording, IsAboutTwoHundredConfigurations) { EXPECT_GE(grid().candidates.size(), 200u); }

constexpr double kNotWorthASearch = 1.05;  ///< times the cost of the cheapest
constexpr double kTooDear = 1.1;           ///< however wide the intervals of a busy machine are

// The cheapest of a record is one of several that the next run may order otherwise. As good as
// found is what the record itself cannot tell from it, or what is hardly dearer.
bool as_cheap_as(const Measurement& best, const Measurement& answer) {
  return answer.cost().ms <= kNotWorthASearch * best.cost().ms ||
         (as_cheap_within_noise(answer, best) && answer.cost().ms <= kTooDear * best.cost().ms);
}

TEST_P(RecordedGrid, IsSearchedWithAFifthOfTheMeasurements) {
  const Limits& limits = GetParam().limits;
  const SearchOutcome found = search(grid().candidates, limits, {}, grid().measure());
  ASSERT_TRUE(found.best);
  const Tried& answer = found.tried[*found.best];
  const std::size_t best = *grid().best(limits);
  EXPECT_TRUE(limits.met_by(answer.measurement));
  EXPECT_TRUE(as_cheap_as(grid().truth[best], answer.measurement))
      << grid().candidates[answer.candidate].detector << " at " << answer.measurement.cost().ms
      << " and not " << grid().candidates[best].detector << " at " << grid().truth[best].cost().ms;
  EXPECT_LE(found.measurements, grid().candidates.size() / 5) << "races included";
  EXPECT_FALSE(found.exhausted);
  RecordProperty("measurements", static_cast<int>(found.measurements));
}

// The recording as another run might have made it: every cost 2 % off, as on a quiet machine, and
// known that well. What is promised must not hang on the noise of one recording.
test::Grid recorded_again(std::uint64_t seed) {
  constexpr double kNoise = 0.02, kNormal95 = 1.96;
  test::Grid again = grid();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (Measurement& m : again.truth) {
    const double cost = m.beside_anchor.value * std::exp(kNoise * normal(random));
    m.beside_anchor = {cost, cost * std::exp(-kNormal95 * kNoise),
                       cost * std::exp(kNormal95 * kNoise)};
  }
  return again;
}

TEST_P(RecordedGrid, IsSearchedAsWellHadItBeenRecordedAgain) {
  constexpr int kRecordings = 20;
  const Limits& limits = GetParam().limits;
  int found = 0;
  for (int seed = 0; seed < kRecordings; ++seed) {
    const test::Grid again = recorded_again(static_cast<std::uint64_t>(seed));
    const SearchOutcome outcome = search(again.candidates, limits, {}, again.measure());
    ASSERT_TRUE(outcome.best);
    found +=
        as_cheap_as(again.truth[*again.best(limits)], outcome.tried[*outcome.best].measurement) &&
        outcome.measurements <= again.candidates.size() / 5;
  }
  RecordProperty("found", found);
  // Seen: 16 of 20 in the worst of the five limits, within which many lie as near as the noise.
  EXPECT_GE(found, 16);
}

// What the test above is for: a guess of the options' effects is needed to find it.
TEST_P(RecordedGrid, IsNotSolvedByTryingEveryDetectorAsItIs) {
  SearchSettings few;
  few.most = 4;
  const SearchOutcome found = search(grid().candidates, GetParam().limits, few, grid().measure());
  const Measurement& best = grid().truth[*grid().best(GetParam().limits)];
  EXPECT_FALSE(found.best && as_cheap_as(best, found.tried[*found.best].measurement));
}

}  // namespace
}  // namespace contactcheck::tune
