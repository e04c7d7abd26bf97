#include "reference/compare/histogram.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace contactcheck {
namespace results {

static bool operator==(const HistogramBin& x, const HistogramBin& y) {
  return x.from == y.from && x.below == y.below && x.count == y.count;
}

}  // namespace results

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<results::HistogramBin> bins_of(Histogram histogram, const std::vector<double>& values) {
  for (double value : values) histogram.add(value);
  return histogram.bins();
}

TEST(Histogram, LengthsGoByOneTwoAndFive) {
  EXPECT_THAT(bins_of(Histogram::of_lengths(), {0.003, 1.5, 0.002, 0.0049, 7.0}),
              ElementsAre(results::HistogramBin{0.002, 0.005, 3},
                          results::HistogramBin{1.0, 2.0, 1}, results::HistogramBin{5.0, 10.0, 1}));
}

TEST(Histogram, AnEdgeBelongsToTheBinAboveIt) {
  EXPECT_THAT(bins_of(Histogram::of_lengths(), {std::nextafter(0.5, 0.0), 0.5}),
              ElementsAre(results::HistogramBin{0.2, 0.5, 1}, results::HistogramBin{0.5, 1.0, 1}));
  EXPECT_THAT(bins_of(Histogram::of_angles(), {4.999, 5.0}),
              ElementsAre(results::HistogramBin{0.0, 5.0, 1}, results::HistogramBin{5.0, 10.0, 1}));
}

TEST(Histogram, BothEndsHoldWhatIsThere) {
  constexpr double kMax = std::numeric_limits<double>::max();
  EXPECT_THAT(
      bins_of(Histogram::of_lengths(),
              {0.0, 1e-300, kMax, std::numeric_limits<double>::infinity()}),
      ElementsAre(results::HistogramBin{0.0, 1e-12, 2}, results::HistogramBin{5e307, kMax, 2}));
  EXPECT_THAT(
      bins_of(Histogram::of_angles(), {180.0, 0.0}),
      ElementsAre(results::HistogramBin{0.0, 5.0, 1}, results::HistogramBin{175.0, 180.0, 1}));
  EXPECT_THAT(Histogram::of_angles().bins(), IsEmpty());
}

}  // namespace
}  // namespace contactcheck
