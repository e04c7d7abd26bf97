#include "reference/report/pictures/bar_plot.h"

#include <gmock/gmock.h>

#include <regex>

namespace contactcheck::report {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

struct Bar {
  double x, width;
  std::string series;
};

// Those of the rows: squares of the legend stand higher.
std::vector<Bar> bars_of(const std::string& svg) {
  static const std::regex rect(
      "<g><title>[^<]*</title>\\s*<rect x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\" "
      "height=\"[0-9.]+\" class=\"(s[0-9])\"");
  std::vector<Bar> bars;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), rect); it != std::sregex_iterator();
       ++it)
    bars.push_back({std::stod((*it)[1]), std::stod((*it)[2]), (*it)[3]});
  return bars;
}

BarChart chart_of(std::vector<BarRow> rows) {
  return {"Title", {"first", "second"}, std::move(rows), "share", BarChart::Scale::kLinear, {}};
}

TEST(BarPlot, IsEmptyWithoutRows) { EXPECT_EQ(bar_plot(chart_of({})), ""); }

TEST(BarPlot, LaysTheBarsOfALaneEndToEnd) {
  const auto bars = bars_of(bar_plot(chart_of({{"a", {{{0, 0.2, "one"}, {1, 0.1, "two"}}}, ""}})));
  ASSERT_THAT(bars, SizeIs(2));
  EXPECT_NEAR(bars[0].x + bars[0].width, bars[1].x, 0.11);
  EXPECT_NEAR(bars[0].width, 2.0 * bars[1].width, 0.31) << "lengths are shares";
  EXPECT_EQ(bars[0].series + bars[1].series, "s0s1");
}

TEST(BarPlot, ComparesRowsOnOneScale) {
  const auto bars = bars_of(
      bar_plot(chart_of({{"a", {{{0, 0.4, ""}}}, ""}, {"longer name", {{{0, 0.1, ""}}}, ""}})));
  ASSERT_THAT(bars, SizeIs(2));
  EXPECT_EQ(bars[0].x, bars[1].x);
  EXPECT_NEAR(bars[0].width, 4.0 * bars[1].width, 0.5);
}

TEST(BarPlot, ShowsTheSmallestShareButNotNone) {
  for (const auto scale : {BarChart::Scale::kLinear, BarChart::Scale::kErrors}) {
    BarChart chart = chart_of({{"a", {{{0, 1.0, ""}}, {{1, 1e-9, ""}}}, ""}});
    chart.scale = scale;
    EXPECT_THAT(bars_of(bar_plot(chart)), SizeIs(2));
    EXPECT_GE(bars_of(bar_plot(chart))[1].width, 1.0);
    chart.rows[0].lanes[1][0].share = 0.0;
    EXPECT_THAT(bars_of(bar_plot(chart)), SizeIs(1));
  }
}

TEST(BarPlot, SpreadsSmallErrorsOnTheScaleOfErrors) {
  BarChart chart = chart_of({{"a", {{{0, 0.5, ""}}}, ""}, {"b", {{{0, 0.005, ""}}}, ""}});
  chart.scale = BarChart::Scale::kErrors;
  const auto bars = bars_of(bar_plot(chart));
  EXPECT_GT(bars[1].width, 0.2 * bars[0].width) << "1 % of it on a linear scale";
}

TEST(BarPlot, SaysWhatItIsTold) {
  BarChart chart = chart_of({{"a & b", {{{0, 0.5, "half"}}}, "beside <it>"}});
  chart.foot = {"beneath"};
  const std::string svg = bar_plot(chart);
  for (const char* words : {"<title>half</title>", "a &amp; b", "beside &lt;it&gt;", "beneath",
                            ">first<", ">share<", "50 %"})
    EXPECT_THAT(svg, HasSubstr(words));
}

}  // namespace
}  // namespace contactcheck::report
