// A library that answers the question `self`, on a hinge of two triangles that folds flat at one of
// ten values.
#include <gmock/gmock.h>

#include "tests/reference/plugin/plugin_run.h"
#include "tests/support/files.h"

namespace contactcheck {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json row_saying(const std::string& what) {
  const test::Scratch scratch;
  const std::filesystem::path out = scratch.folder() / "out";
  const test::Outcome outcome = test::contactcheck_program(
      {"run", "hard-self-hinge", "--detector", CONTACTCHECK_SELF_LIBRARY ":says=" + what,
       "--no-timing", "--out", out.string()});
  EXPECT_NE(outcome.exit_code, 2) << outcome.err;
  return json::parse(test::text_of(out / "results.json")).at("runs").at(0);
}

TEST(SelfPlugin, PairsOfItsTrianglesAreJudgedByClass) {
  const json row = row_saying("pair");
  ASSERT_EQ(row.at("status"), "ok") << row.at("message");
  const json& level = row.at("levels").at("self-edge");
  EXPECT_EQ(level.at("truth"), 1);
  EXPECT_EQ(level.at("hit"), 1);
  EXPECT_EQ(level.at("spurious"), 9);
  EXPECT_FALSE(row.at("levels").contains("self")) << "neither claimed nor asked for";
}

TEST(SelfPlugin, ABodyAloneIsAnAnswerToo) {
  const json row = row_saying("body");
  EXPECT_EQ(row.at("status"), "ok") << row.at("message");
  EXPECT_EQ(row.at("semantics").at("questions"), json({"self"}));
}

TEST(SelfPlugin, APairOfTwoBodiesIsNoAnswer) {
  const json row = row_saying("others");
  EXPECT_EQ(row.at("status"), "error");
  EXPECT_THAT(row.at("message").get<std::string>(),
              HasSubstr("answers the question self with triangles of two bodies, 0 and 1"));
}

}  // namespace
}  // namespace contactcheck
