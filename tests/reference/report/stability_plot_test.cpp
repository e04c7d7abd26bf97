#include "reference/report/stability_plot.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/report_files.h"
#include "reference/report/svg.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/hard_results.h"

namespace contactcheck {
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
  return stability_plot(*results.scene(id), family_results(results));
}

auto files_of(const Json& results) { return report_files(results::from_json(results)); }

TEST(StabilityPlot, HasASquareForEveryCaseOfWhoGoesWrong) {
  const std::string plot = plot_of("one", hard_results());
  EXPECT_THAT(plot, HasSubstr("skin at 0: 0 missed of 4, 0 spurious"));
  EXPECT_THAT(plot, HasSubstr("skin at 1e-9: 0 missed of 0, 3 spurious"));
  EXPECT_THAT(plot, HasSubstr("crash at 1e-3: signal 11"));
  EXPECT_THAT(plot, Not(HasSubstr("exact")));
  EXPECT_EQ(count_of("<g>", plot), 3u + 1u) << "of the crash, the case alone that it died of";
  EXPECT_EQ(count_of("class=\"unknown\"", plot), 2u);
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
}  // namespace contactcheck
