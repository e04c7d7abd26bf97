#include "reference/report/stability_plot.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/markdown.h"
#include "reference/report/svg.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/hard_results.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;
using test::hard_results;
using testing::AllOf;
using testing::HasSubstr;
using testing::Key;
using testing::Not;
using testing::UnorderedElementsAre;

std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

std::string plot_of(const char* id, const Json& json) {
  const results::Results results = results::from_json(json);
  return stability_plot(*results::Index(results).scene(id), family_results(results));
}

auto files_of(const Json& results) { return report_files(results::from_json(results)); }

TEST(StabilityPlot, HasASquareForEveryCaseOfWhoGoesWrong) {
  const std::string plot = plot_of("one", hard_results());
  EXPECT_THAT(plot, HasSubstr("skin at 0: 0 missed of 4, 0 spurious"));
  EXPECT_THAT(plot, HasSubstr("skin at 1e-9: 0 missed of 0, 3 spurious"));
  EXPECT_THAT(plot, HasSubstr("crash at 1e-3: signal 11"));
  EXPECT_THAT(plot, Not(HasSubstr("exact")));
  EXPECT_THAT(plot, HasSubstr("crash at 0: no answer"));
  EXPECT_EQ(count_of("class=\"error\"", plot), 2u) << "the legend, and the case that it died of";
  EXPECT_EQ(count_of("class=\"unknown\"", plot), 2u);
}

TEST(StabilityPlot, SquaresSayWhichCaseTheyAre) {
  const std::string plot = plot_of("one", hard_results());
  EXPECT_EQ(count_of("<g data-detector=\"skin\" data-frame=", plot), 3u);
  EXPECT_THAT(plot, HasSubstr("<g data-detector=\"skin\" data-frame=\"1\"><title>skin at 1e-9: "));
  EXPECT_THAT(plot,
              HasSubstr("<g data-detector=\"crash\" data-frame=\"2\"><title>crash at 1e-3: "));
}

TEST(StabilityPlot, TellsMissedFromSpuriousWithoutColour) {
  const std::string one = plot_of("one", hard_results()), two = plot_of("two", hard_results());
  const std::string down = "d=\"M-3.5 -2.5h7l-3.5 5Z\" class=\"mark\"",
                    up = "d=\"M-3.5 2.5h7l-3.5 -5Z\" class=\"mark\"";
  EXPECT_EQ(count_of(up, one), 3u) << "the legend, and two cases with spurious contacts";
  EXPECT_EQ(count_of(down, one), 1u) << "the legend";
  EXPECT_EQ(count_of(down, two), 2u) << "the legend, and one case";
  EXPECT_EQ(count_of(up, two), 1u) << "the legend";
}

TEST(StabilityPlot, TakesTheColoursOfThePageAroundIt) {
  const std::string plot = plot_of("one", hard_results());
  const auto dark = plot.find("@media(prefers-color-scheme:dark)");
  ASSERT_NE(dark, std::string::npos);
  for (const char* rule : {".missed{fill:#0b62c4;fill:var(--missed,#0b62c4)}",
                           ".paper{fill:#fff;fill:var(--surface,#fff)}"})
    EXPECT_THAT(plot, HasSubstr(rule));
  EXPECT_THAT(plot.substr(dark), HasSubstr(".missed{fill:#58a6ff;fill:var(--missed,#58a6ff)}"))
      << "a light page on a dark system is light";
}

TEST(StabilityPlot, ShadesByShare) {
  Json results = hard_results();
  const std::string before = plot_of("two", results);
  EXPECT_EQ(count_of("class=\"missed\"", before), 2u) << "the legend, and 1 of 4";
  EXPECT_THAT(before, HasSubstr("class=\"missed\" fill-opacity=\"0.47\"")) << "0.3 + 0.7 / 4";
  results["runs"][4]["per_frame"]["missed"][0] = 4;
  EXPECT_THAT(plot_of("two", results), Not(HasSubstr("class=\"missed\" fill-opacity")));
}

TEST(StabilityPlot, IsNoneWhereNobodyGoesWrong) {
  Json results = hard_results();
  results["runs"][4]["per_frame"]["missed"][0] = 0;
  EXPECT_EQ(plot_of("two", results), "");
}

TEST(StabilityPlot, TakesNoMarkupFromResults) {
  Json results = hard_results();
  results["scenes"][0]["title"] = "<script>&\"\n";
  EXPECT_THAT(plot_of("one", results),
              AllOf(HasSubstr("&lt;script&gt;&amp;&quot; "), Not(HasSubstr("<script"))));
  results["runs"][1]["detector"] = "a\" onclick=\"b<";
  EXPECT_THAT(plot_of("one", results),
              HasSubstr("data-detector=\"a&quot; onclick=&quot;b&lt;\" data-frame=\"0\""));
  EXPECT_EQ(xml_text("a\x01<b>"), "a &lt;b&gt;");
}

TEST(ReportFiles, AreTheReportAndItsPictures) {
  EXPECT_THAT(files_of(hard_results()),
              UnorderedElementsAre(Key("report.md"), Key("plots/one.svg"), Key("plots/two.svg"),
                                   Key("plots/speed_error.svg")));
  EXPECT_THAT(files_of(hard_results()).at("report.md"), HasSubstr("](plots/one.svg)"));
}

TEST(ReportFiles, StayInTheirFolder) {
  Json results = hard_results();
  results["scenes"][0]["id"] = "../../one";
  for (int run = 0; run < 3; ++run) results["runs"][run]["scene"] = "../../one";
  EXPECT_THAT(files_of(results), testing::Contains(Key("plots/------one.svg")));
}

}  // namespace
}  // namespace contactcheck::report
