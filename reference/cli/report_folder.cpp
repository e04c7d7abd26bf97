#include "reference/cli/report_folder.h"

#include <system_error>

#include "core/deform/atomic_file.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;

// No other files: the folder is the user's.
void remove_old_plots(const fs::path& plots) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(plots, error))
    if (entry.path().extension() == ".svg") fs::remove(entry.path(), error);
  fs::remove(plots, error);  // where nothing is left
}

}  // namespace

void write_report(const fs::path& folder, const std::map<std::string, std::string>& files) {
  remove_old_plots(folder / "plots");
  for (const auto& [name, text] : files) {
    std::error_code error;  // is told by the write
    fs::create_directories((folder / name).parent_path(), error);
    write_file_atomically(folder / name, text);
  }
}

}  // namespace contactcheck
