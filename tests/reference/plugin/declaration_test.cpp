#include "reference/plugin/declaration.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "reference/plugin/plugin.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::plugin {
namespace {

using testing::HasSubstr;

constexpr const char* kWhole = R"({
  "id": "mine", "summary": "finds all", "version": "2.1", "later": "unknown keys are passed over",
  "options": [{"name": "leaf", "default": "4", "min": 1, "max": 8, "integer": true, "help": "size"},
              {"name": "tree", "default": "box", "choices": ["box", "ball"]}],
  "needs": ["nodes"], "prepares_again": true, "warm_up": 3,
  "semantics": {"levels": ["body", "near"], "informative": ["vertex"], "questions": ["body", "contacts"],
    "body": "solid", "touching": "open", "margin": 0.01, "precision": "single", "scale": 100,
    "depth_kind": "vertex-surface", "whole_cells": true, "means": "closer than 1 cm"}})";

const std::string& document() {
  static const std::string name = "hello";
  return name;
}

Declaration declaration_in(const std::string& text) {
  const text::JsonValue value = text::parse_json(text, document());
  return read_declaration({value, document()});
}

std::string sentence_about(const std::string& semantics) {
  return test::sentence_of(
      [&] { declaration_in(R"({"id": "mine", "semantics": )" + semantics + "}"); });
}

TEST(Declaration, IsReadWhole) {
  const Declaration d = declaration_in(kWhole);
  EXPECT_EQ(d.id, "mine");
  EXPECT_EQ(d.version, "2.1");
  ASSERT_EQ(d.options.size(), 2u);
  EXPECT_TRUE(d.options[0].integer);
  EXPECT_EQ(d.options[0].max, 8.0);
  EXPECT_THAT(d.options[1].choices, testing::ElementsAre("box", "ball"));
  EXPECT_FALSE(d.needs_vertices);
  EXPECT_TRUE(d.needs_nodes);
  EXPECT_TRUE(d.prepares_again);
  EXPECT_EQ(d.warm_up, 3u);
  const Semantics& s = d.semantics;
  EXPECT_THAT(s.levels, testing::ElementsAre(Level::kBody, Level::kNear));
  EXPECT_THAT(s.informative, testing::ElementsAre(Level::kVertex));
  EXPECT_THAT(s.questions, testing::ElementsAre(Question::kBody, Question::kContacts));
  EXPECT_TRUE(s.solid && !s.closed && !s.exact && s.whole_cells);
  EXPECT_EQ(s.margin, 0.01);
  EXPECT_EQ(s.precision, Precision::kSingle);
  EXPECT_EQ(s.scale, 100.0);
  EXPECT_EQ(s.depth, DepthKind::kVertexSurface);
  EXPECT_EQ(s.means, "closer than 1 cm");
}

TEST(Declaration, NamesKeysThatResembleItsOwn) {
  const auto sentence = [](const std::string& text) {
    return test::sentence_of([&] { declaration_in(text); });
  };
  EXPECT_THAT(sentence(R"({"id": "m", "warmup": 3, "semantics":
                           {"levels": ["body"], "questions": ["body"]}})"),
              HasSubstr("warmup is not a known key; did you mean warm_up?"));
  EXPECT_THAT(sentence_about(R"({"levels": ["near"], "questions": ["contacts"], "marign": 3})"),
              HasSubstr("semantics.marign is not a known key; did you mean margin?"));
  EXPECT_THAT(sentence(R"({"id": "m", "impacts": {"kinds": ["edge-edge"], "tolerence": 1}})"),
              HasSubstr("impacts.tolerence is not a known key; did you mean tolerance?"));
}

TEST(Declaration, WarmUpHasALimitAndNeedsToBePreparedAgain) {
  const auto with = [](const std::string& keys) {
    return R"({"id": "m", "semantics": {"levels": ["body"], "questions": ["body"]}, )" + keys + "}";
  };
  for (const std::uint32_t frames : {0u, kMostWarmUpFrames - 1, kMostWarmUpFrames})
    EXPECT_EQ(
        declaration_in(with("\"prepares_again\": true, \"warm_up\": " + std::to_string(frames)))
            .warm_up,
        frames);
  EXPECT_THAT(test::sentence_of([&] {
                declaration_in(with("\"prepares_again\": true, \"warm_up\": " +
                                    std::to_string(kMostWarmUpFrames + 1)));
              }),
              HasSubstr("a whole number from 0 to 10000"));
  EXPECT_THAT(test::sentence_of([&] { declaration_in(with("\"warm_up\": 1")); }),
              HasSubstr("warm_up needs \"prepares_again\": true"));
  EXPECT_FALSE(declaration_in(with("\"warm_up\": 0")).prepares_again);
}

TEST(Declaration, SurvivesBeingWritten) {
  const std::string once = to_json(declaration_in(kWhole)).dump();
  EXPECT_EQ(to_json(declaration_in(once)).dump(), once);
  const std::string bare =
      to_json(declaration_in(
                  R"({"id": "m", "semantics": {"levels": ["body"], "questions": ["body"]}})"))
          .dump();
  EXPECT_EQ(to_json(declaration_in(bare)).dump(), bare) << "also with empty texts";
}

TEST(Plugin, RecordIsReadAsItWasWritten) {
  Plugin plugin;
  plugin.source = {PluginKind::kCommand, "./mine --fast"};
  plugin.content = "0x1";
  plugin.declaration = declaration_in(kWhole);
  const std::string record = to_json(plugin).dump();
  EXPECT_EQ(to_json(plugin_from_text(record)).dump(), record);
}

TEST(Declaration, OfSemanticsThatDoNotFitTogetherIsRefused) {
  EXPECT_THAT(sentence_about(R"({"levels": [], "questions": ["body"]})"), HasSubstr("no level"));
  EXPECT_THAT(sentence_about(R"({"levels": ["body"], "questions": []})"), HasSubstr("no question"));
  EXPECT_THAT(sentence_about(R"({"levels": ["body", "body"], "questions": ["body"]})"),
              HasSubstr("names a level twice"));
  EXPECT_THAT(sentence_about(R"({"levels": ["body"], "questions": ["body", "body"]})"),
              HasSubstr("names a question twice"));
  EXPECT_THAT(sentence_about(R"({"levels": ["triangle"], "questions": ["body"]})"),
              HasSubstr("does not answer the question triangles"));
  EXPECT_THAT(sentence_about(R"({"levels": ["cell"], "questions": ["body"]})"),
              HasSubstr("does not answer the question cells"));
  EXPECT_THAT(sentence_about(R"({"levels": ["self"], "questions": ["body"]})"),
              HasSubstr("and the question self go together"));
  EXPECT_THAT(sentence_about(R"({"levels": ["body"], "questions": ["body", "self"]})"),
              HasSubstr("and the question self go together"));
  EXPECT_THAT(sentence_about(R"({"levels": ["body"], "questions": ["body", "contacts"]})"),
              HasSubstr("kind of depth go together"));
  EXPECT_THAT(
      sentence_about(
          R"({"informative": ["body"], "levels": [], "questions": ["body"], "exact": true})"),
      HasSubstr("exact at no level"));
}

TEST(Declaration, OfNumbersThatCannotBeUsedIsRefused) {
  EXPECT_THAT(sentence_about(R"({"levels": ["near"], "questions": ["body"]})"),
              HasSubstr("margin of 0"));
  EXPECT_THAT(sentence_about(R"({"levels": ["self-near"], "questions": ["self"]})"),
              HasSubstr("the level self-near with a margin of 0"));
  EXPECT_THAT(sentence_about(R"({"levels": ["body"], "questions": ["body"], "margin": -1})"),
              HasSubstr("margin"));
  EXPECT_THAT(sentence_about(R"({"levels": ["body"], "questions": ["body"], "scale": 0})"),
              HasSubstr("scale"));
  EXPECT_THAT(sentence_about(R"({"levels": ["body"], "questions": ["body"], "scale": 2})"),
              HasSubstr("no single precision"));
  Semantics s;
  s.levels = {Level::kBody};
  s.questions = {Question::kBody};
  EXPECT_EQ(semantics_fault(s), "");
  s.margin = std::numeric_limits<double>::quiet_NaN();  // of a library; JSON has none
  EXPECT_THAT(semantics_fault(s), HasSubstr("margin"));
}

TEST(Declaration, OfBadOptionsIsRefused) {
  const auto sentence = [](const std::string& option) {
    return test::sentence_of([&] {
      declaration_in(R"({"id": "mine", "options": [)" + option +
                     R"(], "semantics": {"levels": ["body"], "questions": ["body"]}})");
    });
  };
  EXPECT_THAT(sentence(R"({"name": "a=b", "default": "1", "min": 0, "max": 1})"),
              HasSubstr("options[0].name"));
  EXPECT_THAT(sentence(R"({"name": "a", "default": "1", "min": 2, "max": 1})"),
              HasSubstr("options[0].max is 1"));
  EXPECT_THAT(sentence(R"({"name": "a", "default": "x,y", "choices": ["x,y"]})"),
              HasSubstr("options[0].choices[0]"));
  const std::string a = R"({"name": "a", "default": "1", "min": 0, "max": 1})";
  EXPECT_THAT(sentence(a + ", " + a), HasSubstr("options[1] is an option that is there already"));
}

TEST(SelfAnswer, NearPairsAreThoseOfOneBody) {
  ContactSet answer;
  answer.near = {{2, 2, 5, 1}};
  read_self_answer("it", answer);
  EXPECT_EQ(answer.self_near, (std::vector<NearPair>{{2, 2, 5, 1}}));
  EXPECT_TRUE(answer.near.empty());
  answer.near = {{2, 0, 5, 1}};
  EXPECT_THAT(test::sentence_of([&] { read_self_answer("it", answer); }),
              HasSubstr("with a vertex and a triangle of two bodies, 2 and 0"));
}

TEST(Declaration, TextsAreOneLine) {
  EXPECT_THAT(test::sentence_of([] {
                declaration_in(R"({"id": "mine", "summary": "a\nb",
                                   "semantics": {"levels": ["body"], "questions": ["body"]}})");
              }),
              HasSubstr("one line"));
}

}  // namespace
}  // namespace contactcheck::plugin
