#include "reference/report/tables/scale_ranges.h"

#include <gmock/gmock.h>

#include "core/types/check.h"
#include "reference/report/formats/markdown.h"
#include "reference/report/tables/headline.h"

namespace contactcheck::report {
namespace {

using results::Index, results::Status;
using ::testing::ElementsAre;

// With one true contact at each value. The values are in no order, as files may have them.
results::Scene family(const std::string& id, const std::string& range,
                      const std::vector<std::string>& values) {
  results::Scene scene;
  scene.id = id;
  scene.frames = values.size();
  scene.family = results::Family{
      "edge, m", "o", "s", values, std::vector<std::uint64_t>(values.size(), 1), range};
  return scene;
}

results::Run answers(const std::string& scene, const std::string& detector,
                     const std::vector<std::uint64_t>& missed,
                     const std::vector<std::uint64_t>& spurious) {
  results::Run run;
  run.scene = scene;
  run.detector = detector;
  run.status = Status::kOk;
  run.per_frame.level = Level::kTriangle;
  run.per_frame.truth.assign(missed.size(), 1);
  run.per_frame.missed = missed;
  run.per_frame.spurious = spurious;
  return run;
}

const std::vector<std::string> kValues = {"1", "1e-3", "0.1", "10", "100"};

TEST(ScaleRanges, AreTheLongestRunOfValuesThatAllFamiliesHaveRight) {
  results::Results results;
  results.scenes = {family("one", "size", kValues), family("two", "size", {"10", "0.1"})};
  results.runs = {answers("one", "d", {0, 1, 0, 0, 0}, {0, 0, 0, 0, 3}),
                  answers("one", "right", {0, 0, 0, 0, 0}, {0, 0, 0, 0, 0}),
                  answers("two", "d", {0, 0}, {0, 0}), answers("two", "right", {0, 0}, {0, 0})};
  std::vector<TitledTable> tables = range_tables(scale_ranges(Index(results)));
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].title, "In which range of sizes each is right");
  ASSERT_EQ(tables[0].rows.size(), 2u);
  EXPECT_THAT(tables[0].rows[0], ElementsAre("d", "triangle", "0.1", "10", "5 of 7",
                                             "one@1e-3: 1 missed, 0 spurious of 1 true",
                                             "one@100: 0 missed, 3 spurious of 1 true"));
  EXPECT_THAT(tables[0].rows[1], ElementsAre("right", "triangle", "1e-3 (smallest tried)",
                                             "100 (largest tried)", "7 of 7", "-", "-"));

  const std::string page = markdown_report(Index(results));
  EXPECT_NE(page.find("### In which range of sizes each is right"), std::string::npos);
  EXPECT_NE(page.find("| d | triangle | 0.1 | 10 | 5 of 7 |"), std::string::npos) << page;

  results.runs[2].per_frame.missed[0] = 1;  // at 10, in the other family
  tables = range_tables(scale_ranges(Index(results)));
  EXPECT_THAT(tables[0].rows[0], ElementsAre("d", "triangle", "0.1", "1", "4 of 7",
                                             "one@1e-3: 1 missed, 0 spurious of 1 true",
                                             "two@10: 1 missed, 0 spurious of 1 true"));
}

TEST(ScaleRanges, HaveNoRightCaseWithoutAnAnswer) {
  results::Results results;
  results.scenes = {family("one", "distance", kValues)};
  results.runs = {answers("one", "d", {0, 0, 0, 0, 0}, {0, 0, 0, 0, 0})};
  results.runs[0].status = Status::kRefused;
  const std::vector<TitledTable> tables = range_tables(scale_ranges(Index(results)));
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].title, "How far from the origin each is right");
  EXPECT_THAT(tables[0].rows, ElementsAre(ElementsAre("d", "-", "nowhere", "-", "0 of 5", "-",
                                                      "one@1e-3: refused")));
}

results::ScaleRange known(const std::string& detector, const std::string& by,
                          const std::string& from, const std::string& to) {
  results::ScaleRange out;
  out.detector = detector;
  out.by = by;
  out.from = from;
  out.to = to;
  out.least = "1e-12";
  out.most = "1e12";
  out.right = 7;
  out.cases = 8;
  return out;
}

TEST(ScaleRanges, StandBesideTheScenesOfARun) {
  results::Results results;
  results.known_ranges = {known("all", "size", "1e-12", "1e12"), known("some", "size", "0.1", "10"),
                          known("some", "distance", "1", "100"), known("none", "size", "", "")};
  const auto add_scene = [&](const std::string& id, std::optional<results::SceneScale> scale) {
    results.scenes.emplace_back().id = id;
    results.scenes.back().scale = scale;
    for (const char* detector : {"all", "some", "none"})
      results.runs.push_back(answers(id, detector, {}, {}));
  };
  add_scene("within", results::SceneScale{0.1, 10.0, 10.0});
  add_scene("small", results::SceneScale{0.0123456, 1.0, 1.0});
  add_scene("far", results::SceneScale{0.5, 1.0, 1000.0});
  add_scene("hard", std::nullopt);
  const TitledTable table = known_ranges_table(Index(results));
  EXPECT_THAT(table.rows,
              ElementsAre(ElementsAre("all", "size", "1e-12 to 1e12 (all tried)", "-"),
                          ElementsAre("some", "size", "0.1 to 10", "small (0.0123 to 1)"),
                          ElementsAre("some", "distance", "1 to 100", "far (2e+03)"),
                          ElementsAre("none", "size", "nowhere",
                                      "within (0.1 to 10), small (0.0123 to 1), far (0.5 to 1)")));
  EXPECT_NE(
      markdown_report(Index(results)).find("| some | size | 0.1 to 10 | small (0.0123 to 1) |"),
      std::string::npos);

  EXPECT_THAT(detectors_out_of_range(Index(results)), ElementsAre("some", "none"));
  const std::vector<HeadlineFinding> findings = headline_of(results).findings;
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const HeadlineFinding& finding) {
    return finding.topic == "Sizes" && finding.sentence.ends_with("right: some and none.");
  }));

  add_scene("fourth", results::SceneScale{0.5, 1.0, 1.0});
  add_scene("fifth", results::SceneScale{0.5, 1.0, 1.0});
  EXPECT_EQ(known_ranges_table(Index(results)).rows[3][3],
            "within (0.1 to 10), small (0.0123 to 1), far (0.5 to 1) and 2 more");

  std::erase_if(results.scenes, [](const auto& scene) { return scene.scale.has_value(); });
  EXPECT_TRUE(known_ranges_table(Index(results)).rows.empty())
      << "of hard cases alone it says nothing";
}

TEST(ScaleRanges, ThatDifferFromTheListAreNamed) {
  const results::ScaleRange listed = known("a", "size", "0.1", "10");
  EXPECT_EQ(range_changes({listed}, {listed}), "");
  EXPECT_EQ(range_changes({listed}, {known("a", "size", "0.1", "100"), known("b", "size", "", "")}),
            "  a  size  0.1 to 10, 7 of 8 right -> 0.1 to 100, 7 of 8 right\n"
            "  b  size  - -> nowhere, 7 of 8 right\n");
}

TEST(ScaleRanges, AreOfFamiliesWithARangeAlone) {
  results::Results results;
  results.scenes = {family("one", "", kValues)};
  results.runs = {answers("one", "d", {0, 0, 0, 0, 0}, {0, 0, 0, 0, 0})};
  EXPECT_TRUE(scale_ranges(Index(results)).empty());
  results.scenes = {family("one", "size", {"1", "thick", "2", "3", "4"})};
  EXPECT_THROW(scale_ranges(Index(results)), InputError);
}

}  // namespace
}  // namespace contactcheck::report
