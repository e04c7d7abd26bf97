#include <cstdio>
#include <optional>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/cli/commands.h"
#include "reference/gate/baseline.h"
#include "reference/results/results_file.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
// Anything else in its place is no baseline, and not ours to replace.
std::optional<results::Results> baseline_in_place(const fs::path& file) {
  if (file.extension() != ".json")
    throw InputError("--as " + file.string() + ": a baseline's name ends in .json");
  if (!fs::exists(file)) return std::nullopt;
  return results::results_in(file);
}

std::string changes_text(const results::Results& before, const results::Results& now) {
  std::string out;
  for (const std::string& line : gate::baseline_changes(before, now)) out += "  " + line + "\n";
  return out.empty() ? "no row, count or contact changed\n" : "changed:\n" + out;
}

}  // namespace

int accept_command(const fs::path& results_file, const fs::path& file) {
  const results::Results results = results::results_in(results_file);
  const std::optional<results::Results> before = baseline_in_place(file);
  if (results.shard)
    throw InputError(results_file.string() +
                     ": is a shard of a run; a baseline is made of the merged results");
  if (results.runs.empty())
    throw InputError(results_file.string() +
                     ": runs is empty; a baseline must contain at least one run");
  const results::Results baseline = gate::baseline_of(results);
  const std::string changes = before ? changes_text(*before, baseline) : "";
  write_file_atomically(file, gate::baseline_text(baseline));
  std::printf("%s: %zu rows of %s\n%s", file.c_str(), baseline.runs.size(),
              baseline.command.c_str(), changes.c_str());
  return 0;
}

}  // namespace contactcheck::cli
