// Whatever the schema of results accepts, the reports are written of. Not by way of `report`: it
// would take a process for each of some hundred documents, and it prints no tables.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "reference/cli/report_folder.h"
#include "reference/report/formats/terminal.h"
#include "reference/results/results_json.h"
#include "reference/results/schema_defect.h"

namespace contactcheck::cli {
namespace {

using Json = nlohmann::ordered_json;
using Place = Json::json_pointer;

Json read(const char* file) {
  std::ifstream in(file);
  return Json::parse(in);
}

bool is_valid(const Json& results) {
  static const Json schema = read(CONTACTCHECK_FIXTURES "/results.schema.json");
  return results::schema_defect(schema, results).empty();
}

// Every member of every object, outer ones first.
void add_members(const Json& value, const Place& place, std::vector<Place>& out) {
  if (value.is_object())
    for (const auto& [key, member] : value.items()) {
      out.push_back(place / key);
      add_members(member, place / key, out);
    }
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) add_members(value[i], place / i, out);
}

Json without(Json results, const Place& place) {
  results[place.parent_pointer()].erase(place.back());
  return results;
}

void write_all_reports(const Json& document) {
  const results::Results results = results::from_json(document);
  report_texts(results, "no-folder", all_report_formats());
  report::terminal_tables(results, false);
}

TEST(ReportOfValidResults, NoMemberIsMissedThatTheSchemaDoesWithout) {
  const Json example = read(CONTACTCHECK_EXAMPLE_RESULTS);
  std::vector<Place> places;
  add_members(example, Place(), places);
  std::size_t valid = 0;
  for (const Place& place : places) {
    const Json results = without(example, place);
    if (!is_valid(results)) continue;
    ++valid;
    EXPECT_NO_THROW(write_all_reports(results)) << "without " << place;
  }
  EXPECT_GT(valid, 80u);
}

}  // namespace
}  // namespace contactcheck::cli
