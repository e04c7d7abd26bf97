#include "reference/report/scale_ranges.h"

#include <gmock/gmock.h>

#include "core/types/check.h"
#include "reference/report/hard_cases.h"

namespace contactcheck::report {
namespace {

using results::Status;
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
  std::vector<TitledTable> tables = scale_ranges(results);
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].title, "In which range of sizes each is right");
  ASSERT_EQ(tables[0].rows.size(), 2u);
  EXPECT_THAT(tables[0].rows[0], ElementsAre("d", "triangle", "0.1", "10", "5 of 7",
                                             "one@1e-3: 1 missed, 0 spurious of 1 true",
                                             "one@100: 0 missed, 3 spurious of 1 true"));
  EXPECT_THAT(tables[0].rows[1], ElementsAre("right", "triangle", "1e-3 (smallest tried)",
                                             "100 (largest tried)", "7 of 7", "-", "-"));

  const std::string page = hard_cases_markdown(results);
  EXPECT_NE(page.find("### In which range of sizes each is right"), std::string::npos);
  EXPECT_NE(page.find("| d | triangle | 0.1 | 10 | 5 of 7 |"), std::string::npos) << page;

  results.runs[2].per_frame.missed[0] = 1;  // at 10, in the other family
  tables = scale_ranges(results);
  EXPECT_THAT(tables[0].rows[0], ElementsAre("d", "triangle", "0.1", "1", "4 of 7",
                                             "one@1e-3: 1 missed, 0 spurious of 1 true",
                                             "two@10: 1 missed, 0 spurious of 1 true"));
}

TEST(ScaleRanges, HaveNoRightCaseWithoutAnAnswer) {
  results::Results results;
  results.scenes = {family("one", "distance", kValues)};
  results.runs = {answers("one", "d", {0, 0, 0, 0, 0}, {0, 0, 0, 0, 0})};
  results.runs[0].status = Status::kRefused;
  const std::vector<TitledTable> tables = scale_ranges(results);
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].title, "How far from the origin each is right");
  EXPECT_THAT(tables[0].rows, ElementsAre(ElementsAre("d", "-", "nowhere", "-", "0 of 5", "-",
                                                      "one@1e-3: refused")));
}

TEST(ScaleRanges, AreOfFamiliesWithARangeAlone) {
  results::Results results;
  results.scenes = {family("one", "", kValues)};
  results.runs = {answers("one", "d", {0, 0, 0, 0, 0}, {0, 0, 0, 0, 0})};
  EXPECT_TRUE(scale_ranges(results).empty());
  results.scenes = {family("one", "size", {"1", "thick", "2", "3", "4"})};
  EXPECT_THROW(scale_ranges(results), InputError);
}

}  // namespace
}  // namespace contactcheck::report
