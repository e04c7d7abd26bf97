#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/cli/commands.h"
#include "reference/cli/results_file.h"
#include "reference/report/markdown.h"

namespace contactcheck {
int report_command(const std::filesystem::path& file, const std::vector<std::string>& formats,
                   const std::filesystem::path& out) {
  for (const std::string& format : formats)
    if (format != "md") throw InputError("--format \"" + format + "\" is not known; allowed: md");
  const ResultsFile results(file);
  const std::string text = results.read([](const auto& json) { return markdown_report(json); });
  std::error_code error;
  std::filesystem::create_directories(out, error);
  write_file_atomically(out / "report.md", text);
  std::printf("%s\n", (out / "report.md").c_str());
  return 0;
}

}  // namespace contactcheck
