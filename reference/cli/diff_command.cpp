#include "reference/results/results_diff.h"

#include <algorithm>
#include <cstdio>

#include "reference/cli/commands.h"
#include "reference/process/exit_codes.h"
#include "reference/results/results_file.h"

namespace contactcheck::cli {
namespace {

void print_heading(const char* label, const std::filesystem::path& file,
                   const results::Results& results) {
  std::printf("%-7s %s  version %s, %zu rows\n", label, file.c_str(), results.version.c_str(),
              results.runs.size());
}

}  // namespace

int diff_command(const std::filesystem::path& before, const std::filesystem::path& after,
                 bool fail) {
  const results::Results was = results::results_in(before), is = results::results_in(after);
  print_heading("before", before, was);
  print_heading("after", after, is);
  const results::ResultsDiff diff = results::diff_results(was, is);
  std::printf("\n%s", results::diff_text(diff).c_str());
  const bool worse =
      std::any_of(diff.changes.begin(), diff.changes.end(), [](const results::RowChange& change) {
        return change.direction == results::Direction::kWorse;
      });
  return fail && (worse || !diff.gone.empty()) ? process::kExitNo : 0;
}

}  // namespace contactcheck::cli
