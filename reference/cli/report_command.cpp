#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/cli/commands.h"
#include "reference/cli/schema_defect.h"
#include "reference/report/markdown.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/file_text.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "contactcheck-results/1";

Json read_results(const std::filesystem::path& file) {
  Json results;
  try {
    results = Json::parse(read_file_bytes(file, "results file"));
  } catch (const Json::parse_error& e) {
    throw InputError(file.string() + ": not JSON at byte " + std::to_string(e.byte));
  }
  const auto schema = results.is_object() ? results.find("schema") : results.end();
  if (!results.is_object() || schema == results.end() || *schema != kSchema)
    throw InputError(file.string() + ": field schema is not \"" + kSchema + "\"");
  return results;
}

// The place that the report could not use. It is looked for only then: results of another program
// may break the schema where no report looks.
std::string defect_of(const Json& results, const Json::exception& e) {
  const std::filesystem::path schema_file = fixtures_directory() / "results.schema.json";
  std::string found;
  if (std::filesystem::is_regular_file(schema_file))
    found = schema_defect(Json::parse(read_file_bytes(schema_file, "schema file")), results);
  if (!found.empty()) return found;
  const std::string what = e.what();  // "[json.exception.type_error.302] sentence"
  const std::size_t bracket = what.find("] ");
  return bracket == std::string::npos ? what : what.substr(bracket + 2);
}

}  // namespace

int report_command(const std::filesystem::path& file, const std::vector<std::string>& formats,
                   const std::filesystem::path& out) {
  for (const std::string& format : formats)
    if (format != "md") throw InputError("--format \"" + format + "\" is not known; allowed: md");
  const Json results = read_results(file);
  std::string text;
  try {
    text = markdown_report(results);
  } catch (const Json::exception& e) {
    throw InputError(file.string() + ": not complete: " + defect_of(results, e));
  }
  std::error_code error;
  std::filesystem::create_directories(out, error);
  write_file_atomically(out / "report.md", text);
  std::printf("%s\n", (out / "report.md").c_str());
  return 0;
}

}  // namespace contactcheck
