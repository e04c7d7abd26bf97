#include "reference/judge/graded_errors.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace contactcheck::results {

static bool operator==(const HistogramBin& x, const HistogramBin& y) {
  return x.from == y.from && x.below == y.below && x.count == y.count;
}

}  // namespace contactcheck::results

namespace contactcheck::judge {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Histogram, LengthsGoByOneTwoAndFive) {
  EXPECT_THAT(histogram({0.003, 1.5, 0.002, 0.0049, 7.0}, length_edges()),
              ElementsAre(results::HistogramBin{0.002, 0.005, 3},
                          results::HistogramBin{1.0, 2.0, 1}, results::HistogramBin{5.0, 10.0, 1}));
}

TEST(Histogram, AnEdgeBelongsToTheBinAboveIt) {
  EXPECT_THAT(histogram({std::nextafter(0.5, 0.0), 0.5}, length_edges()),
              ElementsAre(results::HistogramBin{0.2, 0.5, 1}, results::HistogramBin{0.5, 1.0, 1}));
  EXPECT_THAT(histogram({4.999, 5.0}, angle_edges()),
              ElementsAre(results::HistogramBin{0.0, 5.0, 1}, results::HistogramBin{5.0, 10.0, 1}));
}

TEST(Histogram, BothEndsHoldWhatIsThere) {
  constexpr double kMax = std::numeric_limits<double>::max();
  EXPECT_THAT(
      histogram({0.0, 1e-300, kMax, std::numeric_limits<double>::infinity()}, length_edges()),
      ElementsAre(results::HistogramBin{0.0, 1e-12, 2}, results::HistogramBin{5e307, kMax, 2}));
  EXPECT_THAT(
      histogram({180.0, 0.0}, angle_edges()),
      ElementsAre(results::HistogramBin{0.0, 5.0, 1}, results::HistogramBin{175.0, 180.0, 1}));
  EXPECT_THAT(histogram({}, angle_edges()), IsEmpty());
}

}  // namespace
}  // namespace contactcheck::judge
