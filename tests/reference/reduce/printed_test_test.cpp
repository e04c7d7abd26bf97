#include "reference/reduce/minimal_case.h"

#include <gmock/gmock.h>

#include "tests/reference/reduce/candidates.h"

namespace contactcheck::reduce {
namespace {

MinimalCase printed_case(const Finding& finding) {
  MinimalCase out;
  out.scene = "hard-balls";
  out.place = "value 1e-3 (frame 4)";
  out.detector = "fcl-obbrss";
  out.library = "fcl 0.7.0";
  out.finding = finding;
  out.candidate = test::two_triangles({0, 1, 2, -3, 0.5, 1.0 / 3.0, 0, 0, 0,  //
                                       1e-5, 6, 7, 8, 9, 1, 2, 3, 1e300});
  return out;
}

ProbeVerdict verdict(const Finding& finding) {
  ProbeVerdict v;
  judge::Disagreement d;
  d.level = finding.level;
  d.kind = finding.kind;
  d.pair = {0, 1, 0, 0};
  v.disagreements = {d};
  v.levels[*level_from_name(finding.level)] = {3, 1, 1, 2, 0};
  return v;
}

// A report's text, literally.
TEST(PrintedTest, IsATestWithExactNumbers) {
  const Finding finding{"triangle", "missed"};
  const MinimalCase minimal = printed_case(finding);
  EXPECT_EQ(
      printed_test(minimal, answers_of(minimal, verdict(finding)), TestLanguage::kCpp),
      R"(// fcl-obbrss (fcl 0.7.0): missed at level triangle. From hard-balls, value 1e-3 (frame 4).
TEST(FclObbrss, MissedTriangleHardBalls) {
  const std::array<std::array<double, 3>, 3> first_vertices = {{
      {{0.0, 1.0, 2.0}},
      {{-3.0, 0.5, 0x1.5555555555555p-2}},
      {{0.0, 0.0, 0.0}},
  }};
  const std::array<std::array<int, 3>, 1> first_triangles = {{
      {{0, 1, 2}},
  }};
  const std::array<std::array<double, 3>, 3> second_vertices = {{
      {{1e-05, 6.0, 7.0}},
      {{8.0, 9.0, 1.0}},
      {{2.0, 3.0, 1e+300}},
  }};
  const std::array<std::array<int, 3>, 1> second_triangles = {{
      {{0, 1, 2}},
  }};
  // Exact: triangle 0 of first and triangle 0 of second share a point.
  // fcl-obbrss answered: 1 pair at level triangle of 3 true: 2 missed, 0 spurious.
  // your_detector: does it report triangle 0 of first with triangle 0 of second?
  EXPECT_TRUE(your_detector(first_vertices, first_triangles, second_vertices, second_triangles, 0, 0));
}
)");
}

TEST(PrintedTest, IsJavaScriptWithDecimals) {
  const Finding finding{"triangle", "missed"};
  const MinimalCase minimal = printed_case(finding);
  const std::string test =
      printed_test(minimal, answers_of(minimal, verdict(finding)), TestLanguage::kJavaScript);
  EXPECT_THAT(test, testing::HasSubstr(R"(
import assert from "node:assert/strict";
import test from "node:test";

test("test_fcl_obbrss_missed_triangle_hard_balls", () => {
  const first_vertices = [
      [0.0, 1.0, 2.0],
      [-3.0, 0.5, 0.3333333333333333],
      [0.0, 0.0, 0.0],
  ];
  const first_triangles = [
      [0, 1, 2],
  ];
)"));
  EXPECT_THAT(test, testing::EndsWith("  assert.ok(your_detector(first_vertices, first_triangles, "
                                      "second_vertices, second_triangles, 0, 0));\n});\n"));
}

TEST(PrintedTest, IsPythonOrC) {
  const Finding finding{"triangle", "spurious"};
  const MinimalCase minimal = printed_case(finding);
  const CaseAnswers answers = answers_of(minimal, verdict(finding));
  EXPECT_EQ(
      printed_test(minimal, answers, TestLanguage::kPython),
      R"(# fcl-obbrss (fcl 0.7.0): spurious at level triangle. From hard-balls, value 1e-3 (frame 4).
def test_fcl_obbrss_spurious_triangle_hard_balls():
    first_vertices = [
        [0.0, 1.0, 2.0],
        [-3.0, 0.5, 0.3333333333333333],
        [0.0, 0.0, 0.0],
    ]
    first_triangles = [
        [0, 1, 2],
    ]
    second_vertices = [
        [1e-05, 6.0, 7.0],
        [8.0, 9.0, 1.0],
        [2.0, 3.0, 1e+300],
    ]
    second_triangles = [
        [0, 1, 2],
    ]
    # Exact: triangle 0 of first and triangle 0 of second share no point.
    # fcl-obbrss answered: 1 pair at level triangle of 3 true: 2 missed, 0 spurious.
    # your_detector: does it report triangle 0 of first with triangle 0 of second?
    assert not your_detector(first_vertices, first_triangles, second_vertices, second_triangles, 0, 0)


if __name__ == "__main__":
    test_fcl_obbrss_spurious_triangle_hard_balls()
)");
  const std::string c = printed_test(minimal, answers, TestLanguage::kC);
  EXPECT_THAT(c,
              testing::HasSubstr(
                  "#include <assert.h>\nvoid test_fcl_obbrss_spurious_triangle_hard_balls(void) {\n"
                  "  const double first_vertices[3][3] = {\n"
                  "      {0.0, 1.0, 2.0},\n"
                  "      {-3.0, 0.5, 0x1.5555555555555p-2},\n"));
  EXPECT_THAT(c, testing::HasSubstr("\n  assert(!your_detector(first_vertices, "));
}

// Of bodies the answer is yes or no; of an error any answer will do.
TEST(PrintedTest, AssertsWhatTheLevelIsAbout) {
  const auto test_of = [](const Finding& finding) {
    const MinimalCase minimal = printed_case(finding);
    const ProbeVerdict answered = finding.kind == "error" ? ProbeVerdict() : verdict(finding);
    return printed_test(minimal, answers_of(minimal, answered), TestLanguage::kCpp);
  };
  EXPECT_THAT(test_of({"body", "missed"}),
              testing::AllOf(testing::HasSubstr("does it report a contact of the two?"),
                             testing::HasSubstr("\n  EXPECT_TRUE(your_detector(first_vertices, "
                                                "first_triangles, second_vertices, "
                                                "second_triangles));\n")));
  EXPECT_THAT(test_of({"cell", "missed"}), testing::HasSubstr("second_triangles, 0, 0));\n"));
  EXPECT_THAT(test_of({"cell", "spurious"}), testing::HasSubstr("second_triangles));\n"));
  EXPECT_THAT(test_of({"", "error", "threw"}),
              testing::HasSubstr("\n  EXPECT_NO_THROW(your_detector("));
}

TEST(AnswersOf, NameTheEdgesThatMeetTheOtherTriangle) {
  const Finding finding{"triangle", "missed"};
  MinimalCase minimal = printed_case(finding);
  // The second stands upright in the plane x = y and passes through the first.
  minimal.candidate = test::two_triangles({0, 0, 0, 4, 0, 0, 0, 4, 0,  //
                                           1, 1, 1, 1, 1, -1, 9, 9, 0});
  EXPECT_EQ(answers_of(minimal, verdict(finding)).exact,
            "triangle 0 of first and triangle 0 of second share a point: edge 1-2 of first meets "
            "triangle 0 of second; edge 0-1 of second meets triangle 0 of first");
}

TEST(AnswersOf, SayWhatIsTrueAtEveryLevel) {
  const auto exact = [](const std::string& level, const std::string& kind) {
    const Finding finding{level, kind};
    return answers_of(printed_case(finding), verdict(finding)).exact;
  };
  EXPECT_EQ(exact("body", "missed"), "first and second share a point");
  EXPECT_EQ(exact("body", "spurious"), "first and second share no point");
  EXPECT_EQ(exact("triangle", "spurious"),
            "triangle 0 of first and triangle 0 of second share no point");
  EXPECT_EQ(exact("cell", "missed"), "triangle 0 of first and triangle 0 of second share a point");
  EXPECT_EQ(exact("cell", "spurious"),
            "cell 0 of first and cell 0 of second hold no pair of triangles that touch");
  EXPECT_EQ(exact("box", "missed"),
            "cell 0 of first and cell 0 of second have mapped boxes that overlap");
  EXPECT_EQ(exact("near", "spurious"),
            "vertex 0 of first and triangle 0 of second are not nearer than the margin");
}

TEST(AnswersOf, AnErrorSayHowItEnded) {
  ProbeVerdict v;
  v.status = results::Status::kError;
  v.how = "threw";
  v.message = "stack overflow in tree";
  EXPECT_EQ(answers_of(printed_case({"", "error", "threw"}), v).detector,
            "error: threw: stack overflow in tree");
}

}  // namespace
}  // namespace contactcheck::reduce
