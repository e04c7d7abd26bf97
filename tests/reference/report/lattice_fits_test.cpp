#include "reference/report/lattice_fits.h"

#include <gmock/gmock.h>

#include "reference/report/markdown.h"
#include "reference/report/terminal.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using testing::HasSubstr;

TEST(LatticeFits, TellsTheErrorOverAllFramesAndTheWorstOne) {
  results::Scene scene;
  scene.fits = {{"cloth", {0.003, 0.0, 0.004, 0.0}, {0.006, 0, 0.01, 0}}, {"box", {0.0}, {0.0}}};
  const std::string table = markdown_of(fits_table(scene));
  EXPECT_THAT(table, HasSubstr("| body | RMS | max | in frame |"));
  EXPECT_THAT(table, HasSubstr("| cloth | 2.50 | 10.0 | 2 |"));
  EXPECT_THAT(table, HasSubstr("| box | 0 | 0 | 0 |"));
}

TEST(LatticeFits, LineTellsTheWorstFrameOfTheWorstBody) {
  results::Scene scene;
  scene.fits = {{"cloth", {0.003, 0.0}, {0.006, 0.0}}, {"ball", {0.0, 0.001}, {0.0, 0.007}}};
  EXPECT_EQ(fits_line(scene),
            "judged with lattices fitted to recordings: vertices at most 7.00 mm off (body ball, "
            "frame 1)");
  EXPECT_EQ(fits_line({}), "");
}

TEST(LatticeFits, AreInTheReportOfScenesThatHaveThemAlone) {
  results::Results results = results::from_json(test::sample_results());
  EXPECT_TRUE(fits_table(results.scenes[0]).rows.empty());
  EXPECT_THAT(markdown_report(results), testing::Not(HasSubstr("fitted")));
  EXPECT_THAT(terminal_tables(results, false), testing::Not(HasSubstr("fitted")));
  results.scenes[0].fits = {{"cloth", {0.001}, {0.002}}};
  EXPECT_THAT(markdown_report(results), HasSubstr("| cloth | 1.00 | 2.00 | 0 |"));
  EXPECT_THAT(
      terminal_tables(results, false),
      HasSubstr(
          "with contact\n  judged with lattices fitted to recordings: vertices at most 2.00 mm"));
}

}  // namespace
}  // namespace contactcheck::report
