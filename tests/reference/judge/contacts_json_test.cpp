#include "reference/judge/contacts_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reference/judge/judge.h"

namespace contactcheck::judge {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<Body> kBodies(5, {"any", std::make_shared<BodyShape>()});

// One pair of every number in frame 7, missed; nothing spurious.
std::string missed_at(const std::string& level, const std::vector<Body>& bodies = kBodies) {
  results::Run run;
  run.detector = "any";
  run.per_frame = {level_from_name(level), {0}, {0}, {0}, {}, {}};
  const Json contacts = Json::parse(detector_contacts(run, bodies, {{7, {1, {{2, 4, 3, 5}}}, {}}}));
  EXPECT_EQ(contacts.at("level"), level);
  return contacts.at("frames").at(0).at("missed").at("pairs").dump();
}

JudgedScene scene_with(std::size_t pairs) {
  JudgedScene judged;
  judged.truth.resize(3);
  for (std::uint32_t i = 0; i < pairs; ++i)
    judged.truth[1].surface.triangles.push_back({0, 1, i, i + 1});
  return judged;
}

TEST(Contacts, PairNamesBodyElementBodyElement) {
  for (const char* level : {"triangle", "cell", "box", "near"})
    EXPECT_EQ(missed_at(level), "[2,3,4,5]") << level;
}

TEST(Contacts, WhatIsNoElementIsMinusOne) {
  EXPECT_EQ(missed_at("body"), "[2,-1,4,-1]");
  EXPECT_EQ(missed_at("containment"), "[2,-1,4,-1]");
  EXPECT_EQ(missed_at("vertex"), "[2,3,4,-1]");
}

TEST(Contacts, VertexHasTheNumberThatItWasGiven) {
  auto shape = std::make_shared<BodyShape>();
  shape->given = {{0, 1, 2, 7}, 4};
  const std::vector<Body> bodies(5, {"any", shape});
  EXPECT_EQ(missed_at("vertex", bodies), "[2,7,4,-1]");
  EXPECT_EQ(missed_at("near", bodies), "[2,7,4,5]");
  EXPECT_EQ(missed_at("triangle", bodies), "[2,3,4,5]");
}

TEST(Contacts, DetectorJudgedAtNoLevelHasNone) {
  results::Run run;
  run.per_frame.level = Level::kBody;
  EXPECT_EQ(detector_contacts(run, {}, {}), "");
}

TEST(Contacts, TruthLeavesOutFramesWithoutContact) {
  EXPECT_EQ(truth_contacts(scene_with(2)), R"([{"frame":1,"count":2,"pairs":[0,0,1,1,0,1,1,2]}])");
  EXPECT_EQ(truth_contacts(scene_with(0)), "[]");
}

TEST(Contacts, CountSaysHowManyThereAreWhereTheListIsCut) {
  const Json frame = Json::parse(truth_contacts(scene_with(kListedPairs + 3))).at(0);
  EXPECT_EQ(frame.at("count"), 503);
  EXPECT_EQ(frame.at("pairs").size(), 4 * 500u);
  EXPECT_EQ(frame.at("pairs").at(4 * 500 - 1), 500) << "the first of them in their order";
}

TEST(Contacts, FileIsOneLineWithoutSpaces) {
  EXPECT_EQ(contacts_text("s", "[]", {R"({"detector":"a"})", R"({"detector":"b"})"}),
            R"({"schema":"contactcheck-contacts/1","scene":"s","limit":500,"truth":[],)"
            R"("detectors":[{"detector":"a"},{"detector":"b"}]})"
            "\n");
  EXPECT_EQ(contacts_path("s"), "contacts/s.json");
}

}  // namespace
}  // namespace contactcheck::judge
