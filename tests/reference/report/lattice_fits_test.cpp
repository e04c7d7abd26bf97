#include "reference/report/lattice_fits.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/markdown.h"
#include "reference/report/terminal.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

TEST(LatticeFits, TellsTheErrorOverAllFramesAndTheWorstOne) {
  const Json scene = {
      {"fits",
       {{{"body", "cloth"}, {"rms", {0.003, 0.0, 0.004, 0.0}}, {"max", {0.006, 0, 0.01, 0}}},
        {{"body", "box"}, {"rms", {0.0}}, {"max", {0.0}}}}}};
  const std::string table = fits_markdown(scene);
  EXPECT_THAT(table, HasSubstr("| body | RMS | max | in frame |"));
  EXPECT_THAT(table, HasSubstr("| cloth | 2.50 | 10.0 | 2 |"));
  EXPECT_THAT(table, HasSubstr("| box | 0 | 0 | 0 |"));
}

TEST(LatticeFits, LineTellsTheWorstFrameOfTheWorstBody) {
  const Json scene = {{"fits",
                       {{{"body", "cloth"}, {"rms", {0.003, 0.0}}, {"max", {0.006, 0.0}}},
                        {{"body", "ball"}, {"rms", {0.0, 0.001}}, {"max", {0.0, 0.007}}}}}};
  EXPECT_EQ(fits_line(scene),
            "judged with lattices fitted to recordings: vertices at most 7.00 mm off (body ball, "
            "frame 1)");
  EXPECT_EQ(fits_line(Json::object()), "");
}

TEST(LatticeFits, AreInTheReportOfScenesThatHaveThemAlone) {
  Json results = test::sample_results();
  EXPECT_EQ(fits_markdown(results["scenes"][0]), "");
  EXPECT_THAT(markdown_report(results), testing::Not(HasSubstr("fitted")));
  EXPECT_THAT(terminal_tables(results, false), testing::Not(HasSubstr("fitted")));
  results["scenes"][0]["fits"] = {{{"body", "cloth"}, {"rms", {0.001}}, {"max", {0.002}}}};
  EXPECT_THAT(markdown_report(results), HasSubstr("| cloth | 1.00 | 2.00 | 0 |"));
  EXPECT_THAT(
      terminal_tables(results, false),
      HasSubstr(
          "with contact\n  judged with lattices fitted to recordings: vertices at most 2.00 mm"));
}

}  // namespace
}  // namespace contactcheck
