#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/cli/commands.h"
#include "reference/report/markdown.h"
#include "reference/run/job.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "contactcheck-results/1";

Json read_results(const std::filesystem::path& file) {
  Json results;
  try {
    results = Json::parse(read_text_file(file));
  } catch (const Json::parse_error& e) {
    throw InputError(file.string() + ": not JSON at byte " + std::to_string(e.byte));
  }
  const auto schema = results.is_object() ? results.find("schema") : results.end();
  if (!results.is_object() || schema == results.end() || *schema != kSchema)
    throw InputError(file.string() + ": field schema is not \"" + kSchema + "\"");
  return results;
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
    throw InputError(file.string() + ": not complete: " + e.what());
  }
  std::error_code error;
  std::filesystem::create_directories(out, error);
  write_file_atomically(out / "report.md", text);
  std::printf("%s\n", (out / "report.md").c_str());
  return 0;
}

}  // namespace contactcheck
