#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/cli/commands.h"
#include "reference/cli/report_folder.h"
#include "reference/cli/results_file.h"
#include "reference/report/report_files.h"

namespace contactcheck {
int report_command(const std::filesystem::path& file, const std::vector<std::string>& formats,
                   const std::filesystem::path& out) {
  for (const std::string& format : formats)
    if (format != "md") throw InputError("--format \"" + format + "\" is not known; allowed: md");
  const ResultsFile results(file);
  write_report(out, results.read([](const auto& json) { return report_files(json); }));
  std::printf("%s\n", (out / "report.md").c_str());
  return 0;
}

}  // namespace contactcheck
