#include "reference/report/pictures/line_plot.h"

#include <gmock/gmock.h>

#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace contactcheck::report {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

struct Dot {
  double x, y;
  std::string series;
};

/// The markers, in their order.
std::vector<Dot> dots_of(const std::string& svg) {
  static const std::regex dot(
      "translate\\(([0-9.]+) ([0-9.]+)\\)\" d=\"M-3 0a[^\"]*\" class=\"(s[0-9])\"");
  std::vector<Dot> dots;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), dot); it != std::sregex_iterator();
       ++it)
    dots.push_back({std::stod((*it)[1]), std::stod((*it)[2]), (*it)[3]});
  return dots;
}

LineChart lines_of(std::vector<LineSeries> series, double lowest = 0) {
  LineChart chart;
  chart.title = "Title";
  chart.x_axis = "across";
  chart.y_axis = "up";
  chart.series = std::move(series);
  chart.lowest = lowest;
  chart.foot = {"a foot"};
  return chart;
}

TEST(LinePlot, IsEmptyWithoutPoints) {
  EXPECT_EQ(line_plot(lines_of({})), "");
  EXPECT_EQ(line_plot(lines_of({{"a", 0, false, {}}})), "");
}

TEST(LinePlot, PlacesPointsByTheirLogarithms) {
  const auto dots =
      dots_of(line_plot(lines_of({{"a", 0, false, {{1, 1}, {10, 100}, {100, 1000}}}})));
  ASSERT_THAT(dots, SizeIs(3));
  EXPECT_NEAR(dots[1].x - dots[0].x, dots[2].x - dots[1].x, 0.2);
  EXPECT_NEAR(dots[0].y - dots[1].y, 2 * (dots[1].y - dots[2].y), 0.3) << "upwards";
}

TEST(LinePlot, HasALineAndALegendForEachSeriesWithAName) {
  const std::string svg = line_plot(lines_of({{"first", 0, false, {{1, 1}, {10, 2}}},
                                              {"", 1, true, {{1, 3}, {10, 4}}},
                                              {"<alone>", 2, false, {{1, 5}}}}));
  EXPECT_THAT(svg, HasSubstr(">first</text>"));
  EXPECT_THAT(svg, HasSubstr(">&lt;alone&gt;</text>"));
  EXPECT_THAT(svg, HasSubstr("class=\"s1 dashed\""));
  EXPECT_THAT(svg, Not(HasSubstr("class=\"s0 dashed\"")));
  EXPECT_THAT(svg, HasSubstr(">a foot</text>"));
  ASSERT_THAT(dots_of(svg), SizeIs(3)) << "of the dashed one they are squares";
  EXPECT_EQ(dots_of(svg)[2].series, "s2") << "a point alone is seen too";
  EXPECT_THAT(svg, HasSubstr("M-3 -3h6v6h-6Z\" class=\"s1\""));
}

TEST(LinePlot, LaysWhatIsBelowTheLowestValueOnALineOfItsOwn) {
  const std::string svg =
      line_plot(lines_of({{"a", 0, false, {{1, 0}, {2, 1e-20}, {3, 1}}}}, 1e-9));
  const auto dots = dots_of(svg);
  ASSERT_THAT(dots, SizeIs(3));
  EXPECT_EQ(dots[0].y, dots[1].y);
  EXPECT_LT(dots[2].y, dots[0].y);
  EXPECT_THAT(svg, HasSubstr(">0</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(LinePlot, HasTicksAcrossWhereItIsTold) {
  LineChart chart = lines_of({{"a", 0, false, {{3, 7}}}});
  chart.from = 1;
  chart.to = 10;
  const std::string svg = line_plot(chart);
  EXPECT_THAT(svg, HasSubstr(">1</text>"));
  EXPECT_THAT(svg, HasSubstr(">10</text>"));
}

TEST(LinePlot, BreaksALegendThatIsTooLong) {
  std::vector<LineSeries> many;
  for (std::size_t i = 0; i < 8; ++i)
    many.push_back({"a-detector-with-a-long-name", i, false, {{1, 1}}});
  const std::string svg = line_plot(lines_of(many));
  static const std::regex entry("<text x=\"([0-9.]+)\"[^>]*>a-detector");
  int entries = 0;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), entry); it != std::sregex_iterator();
       ++it, ++entries)
    EXPECT_LE(std::stod((*it)[1]) + 27 * 7, 656);
  EXPECT_EQ(entries, 8);
}

TEST(LinePlot, OfOnePointHasItInside) {
  const std::string svg = line_plot(lines_of({{"a", 0, false, {{5, 7}}}}));
  const auto dots = dots_of(svg);
  ASSERT_THAT(dots, SizeIs(1));
  EXPECT_GT(dots[0].x, 80);
  EXPECT_LT(dots[0].x, 640);
}

}  // namespace
}  // namespace contactcheck::report
