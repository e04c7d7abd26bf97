// Every field of the results of a run, of every other kind: the report is made, or a sentence
// refuses it. (Thousands of reports: too many for a child process each. What the sentences say of
// single fields is in bad_results_refusals.toml.)
#include <gmock/gmock.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/report/formats/markdown.h"
#include "reference/results/results_json.h"
#include "reference/results/schema_defect.h"
#include "reference/scene/catalogue.h"
#include "tests/reference/cli/program.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::Scratch;
using test::text_of;

// Of a run with times and disagreements.
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
    const results::Results read = results::from_json(results);
    return !report::markdown_report(results::Index(read)).empty();
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
