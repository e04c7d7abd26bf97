// Costs out of what several runs have timed, in several models.
#include "reference/tune/measuring.h"

#include <gmock/gmock.h>

#include "reference/tune/search.h"

namespace contactcheck::tune {
namespace {

using ::testing::DoubleNear;

const ModelKey kOwn, kCoarse{0.5, ""}, kSoft{1.0, "shape-matching"};

// Two frames of five passes whose quotients differ by up to `spread` to either side.
PairedRun times(double ratio, double spread = 0.0) {
  PairedRun run;
  for (std::size_t f = 0; f < 2; ++f)
    for (int r = -2; r <= 2; ++r) {
      run[f].anchor.push_back(10.0);
      run[f].own.push_back(10.0 * ratio * (1.0 + 0.5 * spread * r));
    }
  return run;
}

class CostBooks : public ::testing::Test {
 protected:
  CostBooks() {
    book_.set_unit(2.0);
    book_.add_model(kOwn, {});
    book_.add_model(kCoarse, {});
    book_.add_model(kSoft, {10.0, 8.0, 12.0});
  }
  Measurement priced(std::size_t candidate, const ModelKey& key) {
    Measurement m;
    EXPECT_TRUE(book_.price(candidate, key, m));
    return m;
  }

  CostBook book_;
};

TEST_F(CostBooks, CountInWhatTheAnchorTakes) {
  book_.take(7, times(1.5));
  EXPECT_THAT(priced(7, kOwn).cost().ms, DoubleNear(3.0, 1e-12));
  book_.take(8, times(1.5));
  book_.take_anchor(kCoarse, times(0.5));
  EXPECT_THAT(priced(8, kCoarse).cost().ms, DoubleNear(1.5, 1e-12));
}

TEST_F(CostBooks, PoolRuns) {
  book_.take(7, times(1.0));
  book_.take(7, times(3.0));
  EXPECT_THAT(priced(7, kOwn).beside_anchor.value, DoubleNear(2.0, 1e-12));
}

// Its scale is as uncertain for the one as for the other: pairs say which of them is cheaper.
TEST_F(CostBooks, TellCandidatesOfOneLatticeApartWhateverItsScale) {
  book_.take_anchor(kCoarse, times(0.5, 0.5));
  book_.take(0, times(1.0, 0.02));
  book_.take(1, times(1.3, 0.02));
  const Measurement cheap = priced(0, kCoarse), dear = priced(1, kCoarse);
  ASSERT_GT(cheap.cost().high_ms, dear.cost().low_ms) << "in milliseconds they are not known";
  EXPECT_FALSE(as_cheap_within_noise(cheap, dear));
  EXPECT_TRUE(as_cheap_within_noise(cheap, cheap));
}

TEST_F(CostBooks, TellCandidatesOfOneDeformerApartWhateverItsStep) {
  book_.take_anchor(kSoft, times(1.0));
  book_.take(0, times(0.5));
  book_.take(1, times(1.0));
  const Measurement cheap = priced(0, kSoft), dear = priced(1, kSoft);
  ASSERT_GT(cheap.cost().high_ms, dear.cost().low_ms);
  EXPECT_FALSE(as_cheap_within_noise(cheap, dear));
}

TEST_F(CostBooks, CountTheScaleBetweenModels) {
  book_.take_anchor(kCoarse, times(0.5, 0.5));
  book_.take(0, times(1.0));
  book_.take(1, times(0.55));
  book_.take(2, times(2.0));
  EXPECT_TRUE(as_cheap_within_noise(priced(0, kCoarse), priced(1, kOwn)));
  EXPECT_FALSE(as_cheap_within_noise(priced(0, kCoarse), priced(2, kOwn)));
}

// The first run has made the coarse lattice too cheap; the next two say so.
TEST_F(CostBooks, CorrectWhatWasPricedBeforeWhenAModelsScaleChanges) {
  book_.take_anchor(kCoarse, times(0.1));
  book_.take(0, times(1.0));
  book_.take(1, times(0.4));
  const std::vector<Tried> tried = {{0, priced(0, kCoarse)}, {1, priced(1, kOwn)}};
  EXPECT_EQ(cheapest(tried, {}), 0u);
  book_.take_anchor(kCoarse, times(0.5));
  book_.take_anchor(kCoarse, times(0.5));
  EXPECT_THAT(tried[0].measurement.cost().ms, DoubleNear(1.0, 1e-12));
  EXPECT_EQ(cheapest(tried, {}), 1u);
}

// A command that hits the call limit once is no anchor in that run.
TEST_F(CostBooks, AnswerByEarlierRunsWhereOneTimedNothing) {
  book_.take(0, times(1.5));
  book_.take(0, {});
  EXPECT_THAT(priced(0, kOwn).cost().ms, DoubleNear(3.0, 1e-12));
}

TEST_F(CostBooks, PriceNothingThatWasNeverTimed) {
  Measurement m;
  book_.take(0, {});
  EXPECT_FALSE(book_.price(0, kOwn, m));
  book_.take(0, times(1.0));
  EXPECT_FALSE(book_.price(0, kCoarse, m)) << "the anchor was not timed in it";
  EXPECT_EQ(m.model, nullptr);
  book_.take_anchor(kCoarse, {});
  EXPECT_FALSE(book_.price(0, kCoarse, m));
}

}  // namespace
}  // namespace contactcheck::tune
