// Fuzz target: a results.json of any content, through what `contactcheck report` and the tables on
// the terminal make of it. What breaks the schema is refused at the door; of what does not, there
// is a report, or one sentence says why not.

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/types/check.h"
#include "reference/report/markdown.h"
#include "reference/report/terminal.h"
#include "reference/results/results_json.h"
#include "reference/results/schema_defect.h"
#include "reference/scene/catalogue.h"
#include "tests/fuzz/fuzz_target.h"

namespace contactcheck::test {
namespace {

using Json = nlohmann::ordered_json;

template <typename Report>
void require_text_or_refusal(const Report& report) {
  try {
    require(!report().empty(), "a report is not empty");
  } catch (const InputError&) {
  }
}

const Json& schema() {
  static const Json read = [] {
    std::ifstream in(scene::fixtures_directory() / "results.schema.json");
    return Json::parse(in);
  }();
  return read;
}

}  // namespace
}  // namespace contactcheck::test

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contactcheck;
  const test::Json json = test::Json::parse(data, data + size, nullptr, false);
  if (!json.is_object() || !results::schema_defect(test::schema(), json).empty()) return 0;
  const results::Results results = results::from_json(json);
  test::require_text_or_refusal([&] { return report::report_files(results).at("report.md"); });
  test::require_text_or_refusal([&] { return report::terminal_tables(results, true); });
  return 0;
}
