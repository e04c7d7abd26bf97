// Fuzz target: a results.json of any content, through what `contactcheck report`, the tables on the
// terminal and `contactcheck accept` make of it. What breaks the schema is refused at the door; of
// what does not, there is a report, or one sentence says why not. It is the same once it is written
// and read again, and the baseline made of it satisfies the schema, too.

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/types/check.h"
#include "reference/gate/baseline.h"
#include "reference/report/formats/markdown.h"
#include "reference/report/formats/terminal.h"
#include "reference/results/results_json.h"
#include "reference/results/schema_defect.h"
#include "reference/scene/catalogue.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

using Json = nlohmann::ordered_json;

template <typename Report>
void require_text_or_refusal(const Report& report) {
  try {
    require(!report().empty(), "a report is not empty");
  } catch (const InputError& refusal) {
    require_sentence(refusal.what());
  }
}

const Json& schema() {
  static const Json read = [] {
    std::ifstream in(scene::fixtures_directory() / "results.schema.json");
    return Json::parse(in);
  }();
  return read;
}

void check_round_trip(const results::Results& results) {
  const Json once = results::to_json(results);
  require(once == results::to_json(results::from_json(once)),
          "results that are written and read are the same");
}

void check_baseline(const results::Results& results) {
  if (results.shard) return;  // refused before
  const results::Results baseline = gate::baseline_of(results);
  const std::string text = gate::baseline_text(baseline);
  const Json json = Json::parse(text);
  require(results::schema_defect(schema(), json).empty(),
          "a baseline satisfies the schema of results");
  const results::Results again = results::from_json(json);
  require(text == gate::baseline_text(again), "a baseline that is written and read is the same");
  require(gate::baseline_changes(baseline, again).empty(),
          "a baseline changes nothing in its own place");
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(results) {
  using namespace contactcheck;
  const test::Json json = test::Json::parse(data, data + size, nullptr, false);
  if (!json.is_object() || !results::schema_defect(test::schema(), json).empty()) return 0;
  const results::Results results = results::from_json(json);
  test::check_round_trip(results);
  test::check_baseline(results);
  test::require_text_or_refusal([&] { return report::report_files(results).at("report.md"); });
  test::require_text_or_refusal([&] { return report::terminal_tables(results, true); });
  return 0;
}
