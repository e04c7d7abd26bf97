// Files that `report` cannot use: no JSON, another schema, fields that are missing or of another
// kind.
#include <gmock/gmock.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/report/markdown.h"
#include "reference/results/results_json.h"
#include "reference/results/schema_defect.h"
#include "reference/scene/catalogue.h"
#include "tests/reference/cli/refusal.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::Scratch;
using test::text_of;
using test::Words;

// Of a run with times, disagreements and a row of every kind that this machine can give.
const Json& good_results() {
  static const Json results = [] {
    const Scratch scratch;
    const fs::path out = scratch.folder() / "out";
    const test::Outcome outcome = test::contactcheck_program(
        {"run", scratch.write("tiny.json", test::tiny_scene()).string(), "--quiet", "--processes",
         "2", "--detector", "fcl-aabb", "--detector", "ffd-aabb", "--detector", "ffd-aabb+tri",
         "--out", out.string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(text_of(out / "results.json"));
  }();
  return results;
}

void expect_report_refused(const std::string& bytes, Words named) {
  const Scratch scratch;
  scratch.write("r.json", bytes);
  named.emplace_back("DIR/r.json");
  test::expect_refused({"", {"report", "DIR/r.json", "--out", "DIR/out"}, named}, scratch);
}

struct BadBytes {
  std::string name, bytes;
  Words named;
};
void PrintTo(const BadBytes& results, std::ostream* out) { *out << results.name; }

class BadResults : public testing::TestWithParam<BadBytes> {};

TEST_P(BadResults, AreRefusedWithOneSentence) {
  expect_report_refused(GetParam().bytes, GetParam().named);
}

const Words kNotOurs = {"field schema is not \"contactcheck-results/2\""};

INSTANTIATE_TEST_SUITE_P(
    Bytes, BadResults,
    testing::Values(
        BadBytes{"Empty", "", {"is empty"}},
        BadBytes{"Binary", std::string("\0\1\2\xff", 4), {"not JSON at byte 1"}},
        BadBytes{"CutShort", R"({"schema": "contactcheck-results/2", "runs": [)", {"not JSON at"}},
        BadBytes{"NotANumber", R"({"schema": "contactcheck-results/2", "x": NaN})", {"byte 43"}},
        BadBytes{"NumberOutOfRange",
                 R"({"schema": "contactcheck-results/2", "x": 1e999})",
                 {"number overflow parsing '1e999'"}},
        BadBytes{"Deep", std::string(100'000, '['), {"not JSON at byte 100001"}},
        BadBytes{"ClosedDeep", std::string(100'000, '[') + std::string(100'000, ']'), kNotOurs},
        BadBytes{"DeepInside",
                 R"({"schema": "contactcheck-results/2", "scenes": )" + std::string(100'000, '[') +
                     std::string(100'000, ']') + "}",
                 {"nested 100001 deep; at most 64 is allowed"}},
        BadBytes{"DeepTextIsNotDeep",
                 R"({"schema": "contactcheck-results/2", "command": ")" +
                     std::string(100'000, '[') + R"(\"{"})",
                 {"version is missing"}},
        BadBytes{"Null", "null", kNotOurs}, BadBytes{"Text", "\"results\"", kNotOurs},
        BadBytes{"Number", "1", kNotOurs}, BadBytes{"EmptyObject", "{}", kNotOurs},
        BadBytes{"NextSchema", R"({"schema": "contactcheck-results/3"})", kNotOurs},
        BadBytes{"LastSchema",
                 R"({"schema": "contactcheck-results/1"})",
                 {"results of an earlier version, to be recorded anew with `contactcheck run`"}},
        BadBytes{"SchemaAsNumber", R"({"schema": 1})", kNotOurs},
        BadBytes{"NothingButTheSchema",
                 R"({"schema": "contactcheck-results/2"})",
                 {"version is missing"}}),
    [](const testing::TestParamInfo<BadBytes>& test) { return test.param.name; });

struct BadField {
  std::string name, place;  // JSON pointer
  Json value;               // discarded: the field is removed
  Words named;
};
void PrintTo(const BadField& field, std::ostream* out) { *out << field.name; }

class BadResultsField : public testing::TestWithParam<BadField> {};

TEST_P(BadResultsField, IsRefusedWithItsPlaceAndValue) {
  const BadField& field = GetParam();
  Json results = good_results();
  const Json::json_pointer place(field.place);
  if (field.value.is_discarded()) {
    results.at(place.parent_pointer()).erase(place.back());
  } else {
    results.at(place) = field.value;
  }
  expect_report_refused(results.dump(), field.named);
}

const Json kRemoved = Json(Json::value_t::discarded);

INSTANTIATE_TEST_SUITE_P(
    Fields, BadResultsField,
    testing::Values(
        BadField{"NoRuns", "/runs", kRemoved, {"runs is missing"}},
        BadField{"NoScenes", "/scenes", kRemoved, {"scenes is missing"}},
        BadField{"NoMachine", "/machine", kRemoved, {"machine is missing"}},
        BadField{"NoDisagreements", "/disagreements", kRemoved, {"disagreements is missing"}},
        BadField{"RunsAsNumber", "/runs", 5, {"runs is 5; it must be of type array"}},
        BadField{"RunAsText", "/runs/1", "x", {"runs[1] is \"x\"; it must be of type object"}},
        BadField{"MachineAsNull", "/machine", nullptr, {"machine is null"}},
        BadField{"CoresAsText", "/machine/cores", "two", {"machine.cores is \"two\""}},
        BadField{"LibraryAsList", "/libraries/fcl", Json::array(), {"libraries.fcl is an array"}},
        BadField{"NoDetector", "/runs/2/detector", kRemoved, {"runs[2].detector is missing"}},
        BadField{"StatusAsNumber", "/runs/0/status", 1, {"runs[0].status is 1"}},
        BadField{"NoLevels", "/runs/0/levels", kRemoved, {"runs[0].levels is missing"}},
        BadField{"TruthAsText",
                 "/runs/0/levels/triangle/truth",
                 "many",
                 {"runs[0].levels.triangle.truth is \"many\"; it must be of type integer"}},
        BadField{"NoGeometry", "/runs/0/geometry", kRemoved, {"runs[0].geometry is missing"}},
        BadField{"StagesAsObject", "/runs/1/stages", 7, {"runs[1].stages is 7"}},
        BadField{"DisagreementWithoutACase",
                 "/disagreements/0/case",
                 kRemoved,
                 {"disagreements[0].case is missing"}}),
    [](const testing::TestParamInfo<BadField>& test) { return test.param.name; });

// Every place of a document.
void for_each_place(const Json& value, const Json::json_pointer& place,
                    const std::function<void(const Json::json_pointer&)>& action) {
  if (!place.empty()) action(place);
  if (value.is_object())
    for (const auto& [key, member] : value.items()) for_each_place(member, place / key, action);
  // Of long arrays the first two: the others are alike.
  if (value.is_array())
    for (std::size_t i = 0; i < std::min<std::size_t>(value.size(), 2); ++i)
      for_each_place(value[i], place / i, action);
}

// Refused at the door, or else neither crashes nor leaves by another exception than the one that
// becomes a sentence.
bool reported(const Json& results) {
  static const Json schema =
      Json::parse(text_of(scene::fixtures_directory() / "results.schema.json"));
  if (!results::schema_defect(schema, results).empty()) return false;
  try {
    return !report::markdown_report(results::from_json(results)).empty();
  } catch (const InputError&) {
    return false;
  }
}

TEST(ResultsField, OfAnyOtherKindIsReportedOrRefused) {
  const Json& good = good_results();
  ASSERT_TRUE(reported(good));
  std::size_t places = 0, refused = 0;
  for_each_place(good, Json::json_pointer(), [&](const Json::json_pointer& place) {
    SCOPED_TRACE(place.to_string());
    ++places;
    for (const Json& value : {Json(), Json(-1), Json(1e300), Json("x"), Json::array(),
                              Json::object(), Json::array({Json::object()}), Json(true)}) {
      Json results = good;
      results.at(place) = value;
      if (!reported(results)) ++refused;
    }
    Json results = good;
    if (results.at(place.parent_pointer()).is_object()) {
      results.at(place.parent_pointer()).erase(place.back());
      if (!reported(results)) ++refused;
    }
  });
  EXPECT_GT(places, 300u);
  EXPECT_GT(refused, places) << "most other kinds cannot be shown";
}

}  // namespace
}  // namespace contactcheck::cli
