#include "reference/results/schema_defect.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

namespace contactcheck::results {
namespace {

using Json = nlohmann::ordered_json;

Json read(const char* file) {
  std::ifstream in(file);
  return Json::parse(in);
}

const Json& schema() {
  static const Json schema = read(CONTACTCHECK_FIXTURES "/results.schema.json");
  return schema;
}

// The example, which satisfies the schema, with one value replaced.
std::string defect_with(const std::string& place, const Json& value) {
  Json results = read(CONTACTCHECK_EXAMPLE_RESULTS);
  results[Json::json_pointer(place)] = value;
  return schema_defect(schema(), results);
}

TEST(SchemaDefect, ExampleHasNone) {
  EXPECT_EQ(schema_defect(schema(), read(CONTACTCHECK_EXAMPLE_RESULTS)), "");
}

TEST(SchemaDefect, DocumentOfAnotherKind) {
  EXPECT_EQ(schema_defect(schema(), Json::array()),
            "the document is an array of 0; it must be of type object");
}

TEST(SchemaDefect, NamesPlaceAndValue) {
  EXPECT_EQ(defect_with("/runs/0/levels/body/truth", -1),
            "runs[0].levels.body.truth is -1; it must be at least 0");
  EXPECT_EQ(defect_with("/runs/0/levels/body/truth", 1.5),
            "runs[0].levels.body.truth is 1.5; it must be of type integer");
  EXPECT_EQ(defect_with("/runs/0/levels/body/recall", 1.5),
            "runs[0].levels.body.recall is 1.5; it must be at most 1");
  EXPECT_EQ(defect_with("/runs/0/scene", ""),
            "runs[0].scene is \"\"; it must be a text that is not empty");
  EXPECT_EQ(defect_with("/runs/0/status", "fine"),
            "runs[0].status is \"fine\"; it must be one of ok, error, absent, refused");
  EXPECT_EQ(defect_with("/libraries/fcl", 7), "libraries.fcl is 7; it must be of type string");
  EXPECT_EQ(defect_with("/schema", "else"),
            "schema is \"else\"; it must be \"contactcheck-results/2\"");
}

TEST(SchemaDefect, NamesOfMembersAreCheckedToo) {
  EXPECT_EQ(defect_with("/runs/0/speedup/spheres", Json::object()),
            "a key of runs[0].speedup is \"spheres\"; it must be one of triangles, body, cells, "
            "contacts, self");
}

TEST(SchemaDefect, WhatAConditionAsksFor) {
  Json results = read(CONTACTCHECK_EXAMPLE_RESULTS);
  results.at("runs").at(0).erase("contact_hash");
  EXPECT_EQ(schema_defect(schema(), results), "runs[0].contact_hash is missing");
}

TEST(SchemaDefect, MemberThatAnotherOneAsksFor) {
  Json results = read(CONTACTCHECK_EXAMPLE_RESULTS);
  results["goals"][0].erase("high");
  EXPECT_EQ(schema_defect(schema(), results), "goals[0].high is missing beside low");
}

TEST(SchemaDefect, AlternativesSayWhatTheFirstSays) {
  EXPECT_EQ(defect_with("/runs/0/geometry/missed_length", "long"),
            "runs[0].geometry.missed_length is \"long\"; it must be of type number");
}

TEST(SchemaDefect, ArrayThatIsTooShortOrRepeatsItself) {
  EXPECT_EQ(defect_with("/merged", Json::array()),
            "merged is an array of 0; it must be at least 1 long");
  EXPECT_EQ(defect_with("/resumed", {"a", "b", "a"}), "resumed[2] is \"a\", as an earlier one is");
  EXPECT_EQ(defect_with("/resumed", {"a", "b"}), "");
}

TEST(SchemaDefect, MemberThatIsNotAllowed) {
  EXPECT_EQ(defect_with("/known_defects/more", 1), "known_defects.more is not allowed");
}

TEST(SchemaDefect, KeywordThatNothingChecksIsRefusedWhereverItStands) {
  const Json wrong[] = {{{"maxItems", 3}},
                        {{"items", {{"pattern", "a"}}}},
                        {{"properties", {{"a", {{"format", "b"}}}}}},
                        {{"anyOf", {{{"not", true}}}}},
                        {{"$defs", {{"unused", {{"multipleOf", 2}}}}}}};
  for (const Json& schema : wrong)
    EXPECT_THROW(schema_defect(schema, Json::array()), std::invalid_argument) << schema;
  EXPECT_EQ(schema_defect({{"properties", {{"format", {{"type", "string"}}}}}},
                          {{"format", "a member, and no keyword"}}),
            "");
}

}  // namespace
}  // namespace contactcheck::results
