#include <cstdio>
#include <nlohmann/json.hpp>

#include "reference/cli/commands.h"
#include "reference/cli/report_folder.h"
#include "reference/results/results_file.h"

namespace contactcheck {

int report_command(const std::filesystem::path& file, const std::vector<std::string>& formats,
                   const std::filesystem::path& out) {
  check_report_formats(formats);
  const ResultsFile results(file);
  const std::filesystem::path folder = file.parent_path();
  const auto files = results.read([&](const auto& json) {
    return report_texts(with_reproduction(json, folder), folder, formats);
  });
  write_report(out, files);
  std::printf("%s\n", report_paths(out, files).c_str());
  return 0;
}

}  // namespace contactcheck
