#include "reference/scene/draw_rules.h"

#include <gmock/gmock.h>

#include "core/types/check.h"
#include "reference/text/file_text.h"
#include "tests/reference/scene/scratch.h"
#include "tests/reference/scene/small_draw_rules.h"

namespace contactcheck::scene {
namespace {

using test::sentence_of;

// The rules with one thing that stands there put another way.
std::string refusal(const std::string& what, const std::string& instead) {
  std::string text = test::small_draw_rules();
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  text.replace(at, what.size(), instead);
  return sentence_of([&] { parse_draw_rules(text, "rules"); });
}

TEST(DrawRules, ThoseThatComeAlongDrawContactInHalfOfTheScenes) {
  const DrawRules rules = parse_draw_rules(
      text::read_file_bytes(CONTACTCHECK_FIXTURES "/drawn.json", "rules file"), "drawn.json");
  double all = 0.0, contact = 0.0;
  for (std::size_t i = 0; i < kHappenings.size(); ++i) {
    const auto what = static_cast<Happening>(i);
    all += rules.shares[i];
    if (what == Happening::kGraze || what == Happening::kTouch || what == Happening::kDeep ||
        what == Happening::kPile)
      contact += rules.shares[i];
  }
  EXPECT_EQ(contact, 0.5 * all);
  EXPECT_GE(rules.contact_share.low, 1.0 / 3.0);
  EXPECT_EQ(rules.most_triangles, 400000u);
  EXPECT_EQ(rules.triangles.high, 200000.0);
}

TEST(DrawRules, RefusesStepsThatCannotBeDrawn) {
  const auto refused = [](const std::string& what, const std::string& instead) {
    std::string text = test::small_step_rules("\"pass\": 1");
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), instead);
    return sentence_of([&] { parse_draw_rules(text, "rules"); });
  };
  EXPECT_EQ(
      refused("[0.001, 1]", "[0, 1]"),
      "rules: speed[0] is 0; it must be above 0, since speeds of steps are drawn log-uniform.");
  EXPECT_EQ(refused("[2, 4]", "[1, 4]").substr(0, 26), "rules: bodies[0] is 1; it ");
  EXPECT_EQ(refused("\"frames\": [2, 4]", "\"frames\": [1, 4]"),
            "rules: frames[0] is 1; it must be at least 2: a step is from a frame to the next.");
  EXPECT_EQ(refused("[10, 270]", "[0, 270]"),
            "rules: steps.self_twist[0] is 0; it must be a number above 0 and at most 360.");
  EXPECT_EQ(refused("\"self_share\": 0.5", "\"self_share\": 2"),
            "rules: steps.self_share is 2; it must be a number of at least 0 and at most 1.");
  EXPECT_EQ(refused("\"most_swept\": 300, ", ""), "rules: steps.most_swept is missing.");
}

TEST(DrawRules, RefusesWhatCannotBeDrawn) {
  EXPECT_EQ(refusal("[2, 4]", "[4, 2]"),
            "rules: bodies is reversed: its lowest value 4 is above its highest, 2.");
  EXPECT_EQ(refusal("[2, 4]", "[]"),
            "rules: bodies is an array of 0; it must be an array of the lowest and the highest "
            "value.");
  EXPECT_EQ(refusal("[2, 4]", "[1, 4]"),
            "rules: bodies[0] is 1; it must be a whole number from 2 to 1000.");
  EXPECT_EQ(refusal("[0, 0.05]", "[0, 1.5]"),
            "rules: speed[1] is 1.5; it must be a number of at least 0 and at most 1.");
  EXPECT_EQ(refusal("4000", "200"),
            "rules: most_triangles is 200; it must be at least 320, so that 4 bodies can have 80 "
            "triangles each.");
  EXPECT_EQ(refusal("\"cells\"", "\"cell\"").substr(0, 12), "rules: cell ");
  EXPECT_EQ(refusal("\"cells\": [8, 60],", ""), "rules: cells is missing.");
  EXPECT_THAT(refusal("[0, 0.05]", "[0, NaN]"), testing::HasSubstr("rules"));
  EXPECT_THAT(refusal("\"torus\"", "\"box\""), testing::HasSubstr("meshes[3] is \"box\""));
  EXPECT_EQ(sentence_of([] { parse_draw_rules(test::small_draw_rules("\"pile\": 0"), "rules"); }),
            "rules: shares has no share above 0: nothing would happen.");
  EXPECT_THAT(
      sentence_of([] { parse_draw_rules(test::small_draw_rules("\"crash\": 1"), "rules"); }),
      testing::HasSubstr("crash"));
}

}  // namespace
}  // namespace contactcheck::scene
