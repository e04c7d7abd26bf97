#include <cstdio>
#include <optional>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/cli/commands.h"
#include "reference/gate/baseline.h"
#include "reference/results/results_file.h"
#include "reference/results/results_json.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Anything else in its place is no baseline, and not ours to replace.
std::optional<ResultsFile> baseline_in_place(const fs::path& file) {
  if (file.extension() != ".json")
    throw InputError("--as " + file.string() + ": a baseline's name ends in .json");
  if (!fs::exists(file)) return std::nullopt;
  return ResultsFile(file);
}

std::string changes_text(const results::Results& before, const results::Results& now) {
  std::string out;
  for (const std::string& line : baseline_changes(before, now)) out += "  " + line + "\n";
  return out.empty() ? "no row, count or contact changed\n" : "changed:\n" + out;
}

std::string written_text(const fs::path& file, const Json& baseline) {
  return file.string() + ": " + std::to_string(baseline.at("runs").size()) + " rows of " +
         baseline.at("command").get<std::string>() + "\n";
}

}  // namespace

int accept_command(const fs::path& results_file, const fs::path& file) {
  const ResultsFile results(results_file);
  results.require_schema();
  const std::optional<ResultsFile> before = baseline_in_place(file);
  if (results.read([](const Json& json) { return json.contains("shard"); }))
    throw InputError(results_file.string() +
                     ": is a shard of a run; a baseline is made of the merged results");
  const Json baseline = results.read([](const Json& json) { return baseline_of(json); });
  if (baseline.at("runs").empty())
    throw InputError(results_file.string() +
                     ": runs is empty; a baseline of nothing holds nothing");
  const std::string changes =
      before ? changes_text(before->read(results::from_json), results::from_json(baseline)) : "";
  write_file_atomically(file, baseline_text(baseline));
  std::fputs((written_text(file, baseline) + changes).c_str(), stdout);
  return 0;
}

}  // namespace contactcheck
