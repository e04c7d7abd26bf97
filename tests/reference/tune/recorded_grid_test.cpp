// The search over the measurements of a real run, against that run, which measured everything.
#include "tests/reference/tune/recorded_grid.h"

#include <gtest/gtest.h>

namespace contactcheck {
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

// The cheapest of a noisy record is one of several that the next run may order otherwise. Found is
// what cannot be told from it: inside its interval, and 10 % dearer at most, however wide that is.
bool as_cheap_as(const Measurement& best, const Measurement& answer) {
  return answer.cost_ms <= best.cost_high_ms && answer.cost_ms <= 1.1 * best.cost_ms;
}

TEST_P(RecordedGrid, IsSearchedWithAFifthOfTheMeasurements) {
  const Limits& limits = GetParam().limits;
  const SearchOutcome found = search(grid().candidates, limits, {}, grid().measure());
  ASSERT_TRUE(found.best);
  const Tried& answer = found.tried[*found.best];
  const std::size_t best = *grid().best(limits);
  EXPECT_TRUE(limits.met_by(answer.measurement));
  EXPECT_TRUE(as_cheap_as(grid().truth[best], answer.measurement))
      << grid().candidates[answer.candidate].detector << " at " << answer.measurement.cost_ms
      << " and not " << grid().candidates[best].detector << " at " << grid().truth[best].cost_ms;
  EXPECT_LE(found.tried.size(), grid().candidates.size() / 5);
  EXPECT_FALSE(found.exhausted);
  RecordProperty("measured", static_cast<int>(found.tried.size()));
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
}  // namespace contactcheck
