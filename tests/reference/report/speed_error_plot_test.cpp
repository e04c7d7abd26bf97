#include "reference/report/pictures/speed_error_plot.h"

#include <gmock/gmock.h>

#include <iomanip>
#include <regex>
#include <sstream>

#include "reference/report/pictures/label_layout.h"
#include "reference/report/pictures/plot_axis.h"
#include "reference/report/tables/detector_group.h"

namespace contactcheck::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

SpeedErrorPoint point(const std::string& detector, double ms, double error) {
  SpeedErrorPoint p;
  p.detector = detector;
  p.ms = ms;
  p.error = error;
  p.truth = 1000;
  p.missed = static_cast<std::uint64_t>(1000 * error);
  return p;
}

std::string plot_of(std::vector<SpeedErrorPoint> points) {
  mark_front(points);
  return speed_error_plot({"scene hello", std::move(points), {}}, "A CPU");
}

// The boxes of all names, with the width of the letters of a monospaced font of 11 pixels.
std::vector<Box> names_in(const std::string& svg) {
  static const std::regex name(
      "<text x=\"([0-9.]+)\" y=\"([0-9.]+)\" text-anchor=\"start\" class=\"name\">([^<]*)<");
  std::vector<Box> boxes;
  for (std::sregex_iterator it(svg.begin(), svg.end(), name), end; it != end; ++it)
    boxes.push_back({std::stod((*it)[1]), std::stod((*it)[2]) - 9,
                     0.6021 * 11 * static_cast<double>((*it)[3].length()), 11});
  return boxes;
}

// Where the markers are, in order.
std::vector<std::pair<double, double>> markers_in(const std::string& svg) {
  static const std::regex marker(
      "</title>\n<path transform=\"translate\\(([0-9.]+) ([0-9.]+)\\)\" [^\n]*dot g");
  std::vector<std::pair<double, double>> places;
  for (std::sregex_iterator it(svg.begin(), svg.end(), marker), end; it != end; ++it)
    places.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  return places;
}

TEST(SpeedErrorPlot, FasterIsLeftAndBetterIsDown) {
  const auto at =
      markers_in(plot_of({point("a", 1, 0.1), point("b", 10, 0.1), point("c", 100, 0)}));
  ASSERT_EQ(at.size(), 3u);
  EXPECT_NEAR(at[1].first - at[0].first, at[2].first - at[1].first, 0.11) << "a logarithm";
  EXPECT_EQ(at[0].second, at[1].second);
  EXPECT_GT(at[2].second, at[0].second + 100);
}

TEST(SpeedErrorPlot, NamesDoNotCoverEachOther) {
  std::vector<SpeedErrorPoint> points;
  for (int i = 0; i < 18; ++i)
    points.push_back(point("ffd-aabb-sphere" + std::to_string(i) + "+tri", 1 + 0.01 * i, 0));
  const std::vector<Box> names = names_in(plot_of(points));
  ASSERT_EQ(names.size(), 18u);
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(names[i], names[j])) << i << " " << j;
}

TEST(SpeedErrorPlot, SaysHowManyNamesFoundNoRoom) {
  const std::string svg = plot_of({point(std::string(300, 'x'), 1, 0)});
  EXPECT_THAT(svg, HasSubstr("No room for the names of 1 of 1 points."));
  EXPECT_THAT(plot_of({point("x", 1, 0)}), Not(HasSubstr("No room")));
}

TEST(SpeedErrorPlot, DrawsAFrontPerQuestion) {
  std::vector<SpeedErrorPoint> points = {point("a", 1, 0.5), point("b", 2, 0), point("c", 3, 0)};
  points[2].question = Question::kBody;
  const std::string svg = plot_of(points);
  const std::regex front("<path [^>]*class=\"front\"/>");
  EXPECT_EQ(std::distance(std::sregex_iterator(svg.begin(), svg.end(), front), {}), 2);
  const auto at = markers_in(svg);
  const auto corner = [&](std::size_t i) {
    std::ostringstream text;
    text << "H" << std::fixed << std::setprecision(1) << at[i].first << "V" << at[i].second;
    return text.str();
  };
  EXPECT_THAT(svg, HasSubstr(corner(0) + corner(1) + "H")) << "through a, then b";
}

TEST(SpeedErrorPlot, OnePointHasAxesToo) {
  for (const double ms : {1e-300, 1.0, 1.7e308}) {
    const std::string svg = plot_of({point("only", ms, 1.0)});
    EXPECT_EQ(markers_in(svg).size(), 1u) << ms;
    EXPECT_THAT(svg, Not(HasSubstr("nan"))) << ms;
    EXPECT_THAT(svg, Not(HasSubstr("inf"))) << ms;
  }
}

TEST(SpeedErrorPlot, IsNoneWithoutPoints) { EXPECT_EQ(plot_of({}), ""); }

std::vector<std::string> names_of(const std::vector<Tick>& ticks) {
  std::vector<std::string> names;
  for (const Tick& tick : ticks) names.push_back(tick.name);
  return names;
}

TEST(PlotAxis, NamesRoundNumbersWithin) {
  EXPECT_THAT(names_of(LogAxis(0.3, 7).ticks()), ElementsAre("0.2", "0.5", "1", "2", "5", "10"));
  EXPECT_THAT(names_of(LogAxis(0.01, 1000).ticks()),
              ElementsAre("0.01", "0.1", "1", "10", "100", "1000"));
  EXPECT_LE(LogAxis(1e-300, 1e300).ticks().size(), 13u);
  EXPECT_THAT(names_of(ErrorAxis(0.0).ticks()), ElementsAre("0 %", "0.1 %", "1 %"));
  EXPECT_THAT(names_of(ErrorAxis(1.0).ticks()),
              ElementsAre("0 %", "0.1 %", "1 %", "10 %", "50 %", "100 %"));
}

TEST(PlotAxis, PlacesWhatIsWithinBetweenZeroAndOne) {
  const LogAxis time(0.3, 7);
  EXPECT_GT(time.place(0.3), 0.0);
  EXPECT_LT(time.place(7), 1.0);
  EXPECT_EQ(ErrorAxis(0.4).place(0.0), 0.0);
  EXPECT_DOUBLE_EQ(ErrorAxis(1.0).place(1.0), 1.0);
  EXPECT_GT(ErrorAxis(1.0).place(0.0001), 0.01) << "1 in 10,000 is seen";
}

TEST(DetectorGroup, GoesByTheDetectorAndNotByItsOptions) {
  const auto name = [](const char* detector) { return detector_group(group_of(detector)).name; };
  EXPECT_STREQ(name("ffd-aabb+tri:bounds=paper"), "FFD with exact triangle test (+tri)");
  EXPECT_STREQ(name("ffd-aabb:mine=+tri"), "FFD, node against plane (the paper)");
  EXPECT_STREQ(name("ffd-lazy:isa=SSE4"), "lazy and refitted tree");
  EXPECT_STREQ(name("fcl-obbrss"), "FCL");
  EXPECT_STREQ(name("mine"), "other");
}

}  // namespace
}  // namespace contactcheck::report
