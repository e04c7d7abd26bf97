#include <algorithm>
#include <cstdio>

#include "reference/cli/commands.h"
#include "reference/cli/report_folder.h"
#include "reference/results/results_file.h"

namespace contactcheck::cli {

int report_command(const std::filesystem::path& file, const std::vector<std::string>& formats,
                   const std::filesystem::path& out) {
  check_report_formats(formats);
  const results::Results results = results::results_in(file);
  const auto folder = file.parent_path();
  const bool page = std::find(formats.begin(), formats.end(), "html") != formats.end();
  const auto files =
      report_texts(results, folder, formats, page ? paper_part_in(folder, results) : std::nullopt);
  write_report(out, files);
  std::printf("%s\n", report_paths(out, files).c_str());
  return 0;
}

}  // namespace contactcheck::cli
