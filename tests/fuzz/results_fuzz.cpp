// Fuzz target: a results.json of any content, through what `contactcheck report` and the tables on
// the terminal make of it. A file that is no JSON or lacks a field is refused by nlohmann's own
// exceptions, which the command turns into one sentence; nothing else may come out.

#include <nlohmann/json.hpp>
#include <string>

#include "core/types/check.h"
#include "reference/report/report_files.h"
#include "reference/report/terminal.h"
#include "tests/fuzz/fuzz_target.h"

namespace contactcheck::test {
namespace {

using Json = nlohmann::ordered_json;

template <typename Report>
void require_text_or_refusal(const Report& report) {
  try {
    require(!report().empty(), "a report is not empty");
  } catch (const Json::exception&) {
  } catch (const InputError&) {
  }
}

}  // namespace
}  // namespace contactcheck::test

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contactcheck;
  const test::Json results = test::Json::parse(data, data + size, nullptr, false);
  if (!results.is_object()) return 0;
  test::require_text_or_refusal([&] { return report_files(results).at("report.md"); });
  test::require_text_or_refusal([&] { return terminal_tables(results, true); });
  return 0;
}
