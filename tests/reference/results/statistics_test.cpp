#include "reference/results/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace contactcheck::results {
namespace {

TEST(Median, OfOddEvenAndSingle) {
  EXPECT_EQ(median({5.0}), 5.0);
  EXPECT_EQ(median({9.0, 1.0, 4.0}), 4.0);
  EXPECT_EQ(median({8.0, 2.0, 4.0, 100.0}), 6.0);
  EXPECT_EQ(median({3.0, 3.0, 1.0, 3.0}), 3.0);
}

TEST(Quantile, IsTheNearestRank) {
  const std::vector<double> five = {1.0, 2.0, 3.0, 4.0, 5.0};
  EXPECT_EQ(quantile(five, 0.0), 1.0);
  EXPECT_EQ(quantile(five, 0.2), 1.0);
  EXPECT_EQ(quantile(five, 0.21), 2.0);
  EXPECT_EQ(quantile(five, 1.0), 5.0);
  EXPECT_EQ(quantile({7.0}, 0.95), 7.0);
}

// 0.95 is no double: the rank of every size is that of whole numbers all the same.
TEST(Quantile, OfAllSizesIsThatOfWholeNumbers) {
  std::vector<double> values;
  for (std::size_t n = 1; n <= 2000; ++n) {
    values.push_back(static_cast<double>(n));
    ASSERT_EQ(quantile(values, 0.95), static_cast<double>((95 * n + 99) / 100)) << n;
  }
}

TEST(RankCorrelation, IsOneForWhateverGrowsTogether) {
  const std::vector<double> x = {1.0, 2.0, 10.0, 1000.0}, up = {-5.0, 0.1, 0.2, 0.3},
                            down = {4.0, 3.0, 2.0, -100.0};
  EXPECT_DOUBLE_EQ(rank_correlation(x, up).value(), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation(x, down).value(), -1.0);
}

// By hand: ranks 1 2.5 2.5 4 against 2 1 4 3.
TEST(RankCorrelation, EqualValuesShareTheirRank) {
  EXPECT_NEAR(rank_correlation({1.0, 7.0, 7.0, 9.0}, {20.0, 10.0, 40.0, 30.0}).value(),
              1.5 / std::sqrt(4.5 * 5.0), 1e-12);
}

TEST(RankCorrelation, IsNoneWhereNothingVaries) {
  EXPECT_FALSE(rank_correlation({1.0, 1.0, 1.0}, {1.0, 2.0, 3.0}));
  EXPECT_FALSE(rank_correlation({1.0, 2.0, 3.0}, {4.0, 4.0, 4.0}));
  EXPECT_FALSE(rank_correlation({1.0}, {1.0}));
  EXPECT_FALSE(rank_correlation({}, {}));
}

TEST(ChanceCorrelation, IsRarelyPassedByWhatHasNothingToDoWithEachOther) {
  EXPECT_NEAR(chance_correlation(101, 1), 0.196, 1e-3);
  EXPECT_EQ(chance_correlation(2, 9), 1.0);
  constexpr std::size_t kValues = 30, kQuantities = 9, kTries = 1000;
  std::mt19937_64 random(1);
  const auto drawn = [&] {
    std::vector<double> values(kValues);
    for (double& value : values) value = static_cast<double>(random() % 100000);
    return values;
  };
  std::size_t passed = 0;
  for (std::size_t i = 0; i < kTries; ++i) {
    const std::vector<double> ratio = drawn();
    double strongest = 0.0;
    for (std::size_t q = 0; q < kQuantities; ++q)
      strongest = std::max(strongest, std::abs(rank_correlation(ratio, drawn()).value()));
    passed += strongest > chance_correlation(kValues, kQuantities);
  }
  EXPECT_LE(passed, 60u);
  EXPECT_GE(passed, 10u);
}

// The draws are 0, 1, ..., 199: five of them lie below the interval and five above it.
TEST(Bootstrap, LeavesAsManyDrawsOutBelowAsAbove) {
  double next = 200.0;
  const Ratio r = bootstrap(100.0, [&](Resampler&) { return next -= 1.0; });
  EXPECT_EQ(r.value, 100.0);
  EXPECT_EQ(r.low, 5.0);
  EXPECT_EQ(r.high, 194.0);
}

TEST(Bootstrap, ContainsItsEstimate) {
  const auto one = [](Resampler&) { return 1.0; };
  EXPECT_EQ(bootstrap(0.5, one).low, 0.5);
  EXPECT_EQ(bootstrap(0.5, one).high, 1.0);
  EXPECT_EQ(bootstrap(3.0, one).high, 3.0);
}

TEST(Bootstrap, DrawsTheSameEveryTimeAndAllThereIs) {
  std::vector<std::size_t> first, second, counts(7);
  for (std::vector<std::size_t>* drawn : {&first, &second})
    bootstrap(1.0, [&](Resampler& resampler) {
      drawn->push_back(resampler.below(7));
      return 1.0;
    });
  EXPECT_EQ(first, second);
  for (const std::size_t i : first) ++counts.at(i);
  EXPECT_GT(*std::min_element(counts.begin(), counts.end()), 10u);
}

TEST(GeometricMean, IsTheMeanOfTheLogarithms) {
  EXPECT_NEAR(geometric_mean({2.0, 8.0}), 4.0, 1e-12);
  EXPECT_NEAR(geometric_mean({1.0, 10.0, 100.0}), 10.0, 1e-12);
  EXPECT_NEAR(geometric_mean({7.0}), 7.0, 1e-12);
}

TEST(IntervalName, IsARangeBelowFiveMeasurements) {
  for (const std::size_t few : {1u, 2u, 4u}) EXPECT_STREQ(interval_name(few), "range");
  for (const std::size_t enough : {5u, 6u, 100u}) EXPECT_STREQ(interval_name(enough), "95 %");
}

TEST(MeanRatio, OfOneMeasurementIsThatMeasurement) {
  const Ratio ratio = mean_ratio({1.7});
  EXPECT_NEAR(ratio.value, 1.7, 1e-12);
  EXPECT_NEAR(ratio.low, 1.7, 1e-12);
  EXPECT_NEAR(ratio.high, 1.7, 1e-12);
}

TEST(MeanRatio, OfFewMeasurementsHasTheirRange) {
  const Ratio ratio = mean_ratio({4.0, 1.0, 2.0, 2.0});
  EXPECT_NEAR(ratio.value, 2.0, 1e-12);
  EXPECT_EQ(ratio.low, 1.0);
  EXPECT_EQ(ratio.high, 4.0);
}

// Logarithms -2, -1, 0, 1, 2, ...: to either side of the mean t * deviation / sqrt(n), with t from
// a table of Student's distribution.
TEST(MeanRatio, OfFiveAndMoreHasStudentsInterval) {
  struct Known {
    std::size_t measurements;
    double t, within;  ///< `within`: how far the program's t may be off
  };
  for (const Known& known : {Known{5, 2.776, 1e-3}, Known{6, 2.571, 0.03}, Known{7, 2.447, 0.02},
                             Known{10, 2.262, 5e-3}, Known{31, 2.042, 1e-3}}) {
    const auto n = static_cast<double>(known.measurements);
    std::vector<double> measured;
    for (std::size_t i = 0; i < known.measurements; ++i)
      measured.push_back(std::exp(static_cast<double>(i)));
    const Ratio ratio = mean_ratio(measured);
    EXPECT_NEAR(std::log(ratio.value), (n - 1.0) / 2.0, 1e-12);
    // The variance of 0, 1, ..., n - 1, divided by n - 1, is n (n + 1) / 12.
    const double standard_error = std::sqrt((n + 1.0) / 12.0);
    EXPECT_NEAR(std::log(ratio.high / ratio.value) / standard_error, known.t, known.within) << n;
    EXPECT_NEAR(std::log(ratio.value / ratio.low) / standard_error, known.t, known.within) << n;
  }
}

TEST(MeanRatio, ContainsItsValueWhereAllAreEqual) {
  for (const std::size_t n : {1u, 2u, 3u, 4u, 5u, 6u, 17u}) {
    const Ratio ratio = mean_ratio(std::vector<double>(n, 1.3));
    EXPECT_NEAR(ratio.value, 1.3, 1e-12);
    EXPECT_LE(ratio.low, ratio.value);
    EXPECT_GE(ratio.high, ratio.value);
    EXPECT_NEAR(ratio.high / ratio.low, 1.0, 1e-12);
  }
}

// Which side is above the bar, which unit times have and in which order passes ran say nothing.
TEST(MeanRatio, IsInvariant) {
  for (const std::vector<double>& measured :
       {std::vector<double>{1.0, 3.0, 2.0}, std::vector<double>{1.0, 3.0, 2.0, 5.0, 4.0, 2.5}}) {
    const Ratio ratio = mean_ratio(measured);
    std::vector<double> inverse, larger, reversed(measured.rbegin(), measured.rend());
    for (const double m : measured) {
      inverse.push_back(1.0 / m);
      larger.push_back(1000.0 * m);
    }
    EXPECT_NEAR(mean_ratio(inverse).value * ratio.value, 1.0, 1e-12);
    EXPECT_NEAR(mean_ratio(inverse).low * ratio.high, 1.0, 1e-12);
    EXPECT_NEAR(mean_ratio(inverse).high * ratio.low, 1.0, 1e-12);
    EXPECT_NEAR(mean_ratio(larger).low / ratio.low, 1000.0, 1e-9);
    EXPECT_NEAR(mean_ratio(larger).high / ratio.high, 1000.0, 1e-9);
    EXPECT_NEAR(mean_ratio(reversed).low, ratio.low, 1e-12);
    EXPECT_NEAR(mean_ratio(reversed).high, ratio.high, 1e-12);
  }
}

TEST(Quotient, CombinesTheIntervalsAsIndependentErrors) {
  // Of exp(3) and exp(4) to either side: sqrt(9 + 16) = 5 in the log domain.
  const Ratio now = {2.0, 2.0 * std::exp(-3.0), 2.0 * std::exp(3.0)},
              then = {4.0, 4.0 * std::exp(-4.0), 4.0 * std::exp(4.0)};
  const Ratio factor = quotient(now, then, kFewestForInterval);
  EXPECT_DOUBLE_EQ(factor.value, 0.5);
  EXPECT_NEAR(factor.low, 0.5 * std::exp(-5.0), 1e-12);
  EXPECT_NEAR(factor.high, 0.5 * std::exp(5.0), 1e-9);
}

TEST(Quotient, LowerEndComesFromTheLowEndNowAndTheHighEndThen) {
  const Ratio factor = quotient({1.0, 0.5, 1.0}, {1.0, 1.0, 1.0}, kFewestForInterval);
  EXPECT_DOUBLE_EQ(factor.low, 0.5);
  EXPECT_DOUBLE_EQ(factor.high, 1.0);
  EXPECT_DOUBLE_EQ(quotient({1.0, 1.0, 1.0}, {1.0, 1.0, 2.0}, kFewestForInterval).low, 0.5);
}

TEST(Quotient, OfSmallIntervalsIsTheSame) {
  const double e = std::exp(0.01);
  // Half-widths of 3 % and 4 %, as logarithms: 5 % together.
  const Ratio before{8.0, 8.0 / std::pow(e, 3), 8.0 * std::pow(e, 3)};
  const Ratio now{4.0, 4.0 / std::pow(e, 4), 4.0 * std::pow(e, 4)};
  const Ratio r = quotient(before, now, kFewestForInterval);
  EXPECT_DOUBLE_EQ(r.value, 2.0);
  EXPECT_NEAR(r.low, 2.0 / std::pow(e, 5), 1e-12);
  EXPECT_NEAR(r.high, 2.0 * std::pow(e, 5), 1e-12);
}

TEST(Quotient, TakesEitherEndFromTheEndsThatMoveItThere) {
  const double e = std::exp(0.01);
  // It was perhaps less fast, it may be faster now: both make the slow-down smaller.
  const Ratio r = quotient({8.0, 8.0 / std::pow(e, 3), 8.0}, {4.0, 4.0, 4.0 * std::pow(e, 4)},
                           kFewestForInterval);
  EXPECT_NEAR(r.low, 2.0 / std::pow(e, 5), 1e-12);
  EXPECT_DOUBLE_EQ(r.high, 2.0);
}

TEST(Quotient, OfRangesReachesFromTheSmallestToTheLargest) {
  const Ratio r = quotient({6.0, 4.0, 8.0}, {2.0, 1.0, 4.0}, kFewestForInterval - 1);
  EXPECT_DOUBLE_EQ(r.value, 3.0);
  EXPECT_DOUBLE_EQ(r.low, 1.0);
  EXPECT_DOUBLE_EQ(r.high, 8.0);
}

TEST(RatioText, SaysWhatItsEndsAre) {
  const Ratio r = {1.3249, 1.0, 1520.0};
  EXPECT_EQ(ratio_text(r, kFewestForInterval), "1.32x [1.00, 1520]");
  EXPECT_EQ(ratio_text(r, kFewestForInterval - 1), "1.32x (range 1.00 to 1520)");
  EXPECT_EQ(ratio_text(r, 1), "1.32x (1 pass)");
}

TEST(MedianRatio, IsTheMedianAndGetsNarrowerWithRuns) {
  const Ratio one{0.5, 0.4, 0.625};
  const Ratio odd{5.0, 4.0, 6.25};
  EXPECT_NEAR(median_ratio({one}).low, 0.4, 1e-12);
  EXPECT_EQ(median_ratio({one, odd, one}).value, 0.5);
  EXPECT_GT(median_ratio({one, odd, one}).high, one.high) << "runs that disagree";
  EXPECT_LT(median_ratio({one, one, one, one}).high, 0.99 * one.high);
  EXPECT_GT(median_ratio({one, one, one, one}).high, 0.5 * std::sqrt(1.25)) << "a median, no mean";
}

TEST(MedianRatio, OfOneRunIsThatRun) {
  const Ratio r = median_ratio({{1.0, 1.0, 1.5}});
  EXPECT_EQ(r.low, 1.0);
  EXPECT_EQ(r.high, 1.5);
}

TEST(MedianRatio, KeepsWhatIsKnownBelowApartFromWhatIsKnownAbove) {
  const Ratio lopsided{1.0, 1.0, 1.5};
  const Ratio r = median_ratio({lopsided, lopsided});
  EXPECT_NEAR(r.low, 1.0, 1e-12);
  EXPECT_NEAR(r.high, std::pow(1.5, 1.2533 / std::sqrt(2.0)), 1e-12);
}

// Runs whose speeds differ by 3 %, of which each knows its own ratio as well as it may.
double coverage(std::size_t runs, double known) {
  constexpr int kTrials = 4000;
  constexpr double kTrue = 0.5, kApart = 0.03;
  std::mt19937_64 random(runs);
  std::normal_distribution<double> normal(0.0, kApart);
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Ratio> all;
    for (std::size_t i = 0; i < runs; ++i) {
      const double ratio = kTrue * std::exp(normal(random));
      all.push_back({ratio, ratio / (1.0 + known), ratio * (1.0 + known)});
    }
    const Ratio middle = median_ratio(all);
    covered += middle.low <= kTrue && kTrue <= middle.high;
  }
  return static_cast<double>(covered) / kTrials;
}

TEST(MedianRatio, CoversTheTruthAsOftenAsItSays) {
  for (const std::size_t runs : {2u, 3u, 4u, 5u, 6u, 9u, 16u})
    for (const double known : {0.0, 0.01, 0.06}) {
      EXPECT_GE(coverage(runs, known), 0.94) << runs << " runs, each known to " << known;
    }
}

TEST(Product, IsAsUncertainAsBothTogether) {
  const Ratio r = product({2.0, 2.0, 2.0}, {3.0, 1.5, 4.0});
  EXPECT_NEAR(r.value, 6.0, 1e-12);
  EXPECT_NEAR(r.low, 3.0, 1e-12);
  EXPECT_NEAR(r.high, 8.0, 1e-12);
  const Ratio both = product({1.0, 0.5, 2.0}, {1.0, 0.5, 2.0});
  EXPECT_NEAR(both.high, std::pow(2.0, std::sqrt(2.0)), 1e-12);
}

}  // namespace
}  // namespace contactcheck::results
