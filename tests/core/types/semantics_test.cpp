#include "core/types/semantics.h"

#include <gtest/gtest.h>

#include <set>

namespace contactcheck {
namespace {

TEST(Level, NamesAreTheDesignsAndReadBack) {
  for (const Level level : kLevels) EXPECT_EQ(level_from_name(name_of(level)), level);
  EXPECT_EQ(level_names(),
            (std::vector<std::string>{
                "body", "containment", "cell", "box", "triangle", "vertex", "near", "self",
                "self-vertex", "self-edge", "self-body", "self-cell", "self-near", "impact-vf",
                "impact-ee", "impact-triangle", "impact", "impact-self-vf", "impact-self-ee"}));
  EXPECT_EQ(level_from_name("Body"), std::nullopt);
  EXPECT_EQ(level_from_name(""), std::nullopt);
}

TEST(Level, FromFineToCoarseAreAll) {
  EXPECT_EQ(std::set<Level>(kFineToCoarse.begin(), kFineToCoarse.end()),
            std::set<Level>(kLevels.begin(), kLevels.end()));
}

TEST(Level, IsOfOneKindOfContact) {
  std::vector<Level> self, impact, self_impact;
  for (const Level level : kLevels) {
    if (is_self(level)) self.push_back(level);
    if (is_impact(level)) impact.push_back(level);
    if (is_self_impact(level)) self_impact.push_back(level);
  }
  EXPECT_EQ(self, (std::vector<Level>{Level::kSelf, Level::kSelfVertex, Level::kSelfEdge,
                                      Level::kSelfBody, Level::kSelfCell, Level::kSelfNear}));
  EXPECT_EQ(impact,
            (std::vector<Level>{Level::kImpactVf, Level::kImpactEe, Level::kImpactTriangle,
                                Level::kImpact, Level::kImpactSelfVf, Level::kImpactSelfEe}));
  EXPECT_EQ(self_impact, (std::vector<Level>{Level::kImpactSelfVf, Level::kImpactSelfEe}));
  EXPECT_TRUE(any_self({Level::kBody, Level::kSelfNear}));
  EXPECT_FALSE(any_self({Level::kBody, Level::kImpactSelfVf})) << "of steps";
  EXPECT_TRUE(any_impact({Level::kBody, Level::kImpactSelfEe}));
  EXPECT_FALSE(any_impact({Level::kBody, Level::kSelfBody}));
}

TEST(Level, OfStepsNamesElements) {
  for (const bool missed : {false, true}) {
    EXPECT_EQ(named_elements(Level::kImpact, missed), NamedElements{});
    EXPECT_EQ(named_elements(Level::kImpactTriangle, missed),
              (NamedElements{Element::kTriangle, Element::kTriangle}));
    for (const Level level : {Level::kImpactVf, Level::kImpactSelfVf})
      EXPECT_EQ(named_elements(level, missed),
                (NamedElements{Element::kVertex, Element::kTriangle}));
    for (const Level level : {Level::kImpactEe, Level::kImpactSelfEe})
      EXPECT_EQ(named_elements(level, missed), (NamedElements{Element::kEdge, Element::kEdge}));
  }
}

TEST(Question, NamesAreTheDesigns) {
  EXPECT_STREQ(name_of(Question::kTriangles), "triangles");
  EXPECT_STREQ(name_of(Question::kBody), "body");
  EXPECT_STREQ(name_of(Question::kCells), "cells");
  EXPECT_STREQ(name_of(Question::kContacts), "contacts");
  EXPECT_STREQ(name_of(Question::kSelf), "self");
  EXPECT_STREQ(name_of(Question::kImpacts), "impacts");
  EXPECT_STREQ(name_of(Question::kSelfImpacts), "self-impacts");
}

TEST(Question, IsOfFramesOrOfSteps) {
  std::vector<Question> of_steps;
  for (const Question question : kQuestions)
    if (is_of_steps(question)) of_steps.push_back(question);
  EXPECT_EQ(of_steps, (std::vector<Question>{Question::kImpacts, Question::kSelfImpacts}));
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
