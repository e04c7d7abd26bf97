#include "core/types/semantics.h"

#include <gtest/gtest.h>

#include <set>

namespace contactcheck {
namespace {

TEST(Level, NamesAreTheDesignsAndReadBack) {
  for (const Level level : kLevels) EXPECT_EQ(level_from_name(name_of(level)), level);
  EXPECT_EQ(level_names(),
            (std::vector<std::string>{"body", "containment", "cell", "box", "triangle", "vertex",
                                      "near", "self", "self-vertex", "self-edge", "self-body",
                                      "self-cell", "self-near"}));
  EXPECT_EQ(level_from_name("Body"), std::nullopt);
  EXPECT_EQ(level_from_name(""), std::nullopt);
}

TEST(Level, FromFineToCoarseAreAll) {
  EXPECT_EQ(std::set<Level>(kFineToCoarse.begin(), kFineToCoarse.end()),
            std::set<Level>(kLevels.begin(), kLevels.end()));
}

TEST(Question, NamesAreTheDesigns) {
  EXPECT_STREQ(name_of(Question::kTriangles), "triangles");
  EXPECT_STREQ(name_of(Question::kBody), "body");
  EXPECT_STREQ(name_of(Question::kCells), "cells");
  EXPECT_STREQ(name_of(Question::kSelf), "self");
}

TEST(Precision, NamesAreTheDesigns) {
  EXPECT_STREQ(name_of(Precision::kDouble), "double");
  EXPECT_STREQ(name_of(Precision::kSingle), "single");
  EXPECT_STREQ(name_of(DepthKind::kNone), "none");
  EXPECT_STREQ(name_of(DepthKind::kVertexSurface), "vertex-surface");
  EXPECT_STREQ(name_of(DepthKind::kConvexPair), "convex-pair");
}

TEST(Semantics, ClaimsAndAnswersOnlyWhatIsListed) {
  Semantics s;
  s.levels = {Level::kBody, Level::kTriangle};
  s.questions = {Question::kTriangles};
  EXPECT_TRUE(s.claims(Level::kTriangle));
  EXPECT_FALSE(s.claims(Level::kCell));
  EXPECT_TRUE(s.answers(Question::kTriangles));
  EXPECT_FALSE(s.answers(Question::kBody));
}

}  // namespace
}  // namespace contactcheck
