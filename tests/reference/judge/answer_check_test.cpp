#include "reference/judge/answer_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck::judge {
namespace {

// Two boxes of 8 vertices and 12 triangles, in lattices of one cell.
scene::Scene standing_boxes() {
  const auto box = test::make_body("", test::unit_box_mesh(1), {1, 1, 1}).shape;
  return test::approach_scene(box, box, {{0.0, 0.5}}, 0, 0, 1, 1.0, {Level::kBody});
}

std::string complaint(ContactSet answer) {
  const scene::Scene scene = standing_boxes();
  answer.canonicalize();
  try {
    check_answer(scene, 3, answer);
    return "";
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

ContactSet with_piece(const ElementPair& pieces, double depth, const Vec3& normal) {
  ContactSet answer;
  answer.triangles = {{0, 1, 11, 11}};
  answer.piece_contacts = {{pieces, depth, normal}};
  return answer;
}

TEST(AnswerCheck, AcceptsWhatIsThere) {
  ContactSet answer = with_piece({0, 1, 11, 11}, 0.5, Vec3::UnitX());
  answer.near = {{1, 0, 7, 11}};
  answer.vertices = {{0, 1, 7}};
  answer.vertex_contacts = {{{1, 0, 7}, 0.0, Vec3::UnitZ()}};
  answer.cells = {{1, 0, 0, 0}};
  EXPECT_EQ(complaint(answer), "");
}

TEST(AnswerCheck, RefusesNearPairsThatNameWhatIsNotThere) {
  ContactSet answer;
  answer.near = {{1, 0, 8, 0}};
  EXPECT_EQ(complaint(answer),
            "frame 3: the answer names vertex 8 of body \"moving\", which has 8");
  answer.near = {{0, 1, 0, 12}};
  EXPECT_EQ(complaint(answer),
            "frame 3: the answer names triangle 12 of body \"moving\", which has 12");
  answer.near = {{0, 2, 0, 0}};
  EXPECT_EQ(complaint(answer), "frame 3: the answer names body 2 of 2 bodies");
}

TEST(AnswerCheck, RefusesContactsOfPiecesThatAreNotThere) {
  EXPECT_EQ(complaint(with_piece({0, 1, 12, 0}, 0.5, Vec3::UnitX())),
            "frame 3: the answer names triangle 12 of body \"resting\", which has 12");
  EXPECT_EQ(complaint(with_piece({0, 5, 0, 0}, 0.5, Vec3::UnitX())),
            "frame 3: the answer names body 5 of 2 bodies");
  EXPECT_EQ(complaint(with_piece({1, 1, 0, 0}, 0.5, Vec3::UnitX())),
            "frame 3: the answer names body \"moving\" in contact with itself");
}

// A ball of over 100 triangles after a box of 12.
TEST(AnswerCheck, SaysWhereExchangedElementsWouldExist) {
  const auto box = test::make_body("", test::unit_box_mesh(1), {1, 1, 1}).shape;
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 2), {1, 1, 1}).shape;
  const scene::Scene scene =
      test::approach_scene(box, ball, {{0.0, 0.5}}, 0, 0, 1, 1.0, {Level::kBody});
  const auto complaint_about = [&](const ElementPair& pair) -> std::string {
    ContactSet answer;
    answer.triangles = {pair};
    answer.canonicalize();
    try {
      check_answer(scene, 0, answer);
      return "";
    } catch (const std::runtime_error& e) {
      return e.what();
    }
  };
  EXPECT_EQ(complaint_about({0, 1, 70, 5}),
            "frame 0: the answer names triangle 70 of body \"resting\", which has 12; exchanged, "
            "both would exist: a belongs to the body with the lower index");
  EXPECT_EQ(complaint_about({0, 1, 70, 40}),
            "frame 0: the answer names triangle 70 of body \"resting\", which has 12");
}

TEST(AnswerCheck, RefusesDepthsAndNormalsThatAreNoNumbers) {
  const std::string sentence =
      "frame 3: the answer holds a depth or normal that is negative or no number";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint(with_piece({0, 1, 0, 0}, nan, Vec3::UnitX())), sentence);
  EXPECT_EQ(complaint(with_piece({0, 1, 0, 0}, -1e-9, Vec3::UnitX())), sentence);
  EXPECT_EQ(complaint(with_piece({0, 1, 0, 0}, 0.5, Vec3(0, nan, 0))), sentence);
  ContactSet answer;
  answer.vertex_contacts = {{{0, 1, 0}, std::numeric_limits<double>::infinity(), Vec3::UnitX()}};
  EXPECT_EQ(complaint(answer), sentence);
}

}  // namespace
}  // namespace contactcheck::judge
