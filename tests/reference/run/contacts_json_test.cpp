#include "reference/run/contacts_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reference/compare/judge.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

// One pair of every number in frame 7, missed; nothing spurious.
std::string missed_at(const std::string& level) {
  RunResult run;
  run.detector = "any";
  run.per_frame = {level, {0}, {0}, {0}, {}};
  run.differences = {{7, {1, {{2, 4, 3, 5}}}, {}}};
  return detector_contacts(run).at("frames").at(0).at("missed").at("pairs").dump();
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

TEST(Contacts, DetectorJudgedAtNoLevelHasNone) {
  RunResult run;
  run.per_frame.level = "body";
  EXPECT_TRUE(detector_contacts(run).is_null());
}

TEST(Contacts, TruthLeavesOutFramesWithoutContact) {
  EXPECT_EQ(truth_contacts(scene_with(2)).dump(),
            R"([{"frame":1,"count":2,"pairs":[0,0,1,1,0,1,1,2]}])");
  EXPECT_EQ(truth_contacts(scene_with(0)), Json::array());
}

TEST(Contacts, CountSaysHowManyThereAreWhereTheListIsCut) {
  const Json frame = truth_contacts(scene_with(kListedPairs + 3)).at(0);
  EXPECT_EQ(frame.at("count"), 503);
  EXPECT_EQ(frame.at("pairs").size(), 4 * 500u);
  EXPECT_EQ(frame.at("pairs").at(4 * 500 - 1), 500) << "the first of them in their order";
}

TEST(Contacts, FileIsOneLineWithoutSpaces) {
  const Json detector = {{"detector", "a"}, {"level", "cell"}, {"frames", Json::array()}};
  EXPECT_EQ(contacts_text("s", Json::array(), Json::array({detector})),
            R"({"schema":"contactcheck-contacts/1","scene":"s","limit":500,"truth":[],)"
            R"("detectors":[{"detector":"a","level":"cell","frames":[]}]})"
            "\n");
  EXPECT_EQ(contacts_path("s"), "contacts/s.json");
}

}  // namespace
}  // namespace contactcheck
