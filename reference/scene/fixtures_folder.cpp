#include "reference/scene/fixtures_folder.h"

#include <cstdlib>
#include <sstream>
#include <system_error>

namespace contactcheck::scene {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

}  // namespace

fs::path installed_fixtures(const fs::path& program) {
  return (program.parent_path() / CONTACTCHECK_FIXTURES_FROM_PROGRAM).lexically_normal();
}

std::vector<fs::path> shared_fixtures(const std::string& data_folders) {
  std::vector<fs::path> found;
  std::istringstream folders(data_folders);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (fs::path(folder).is_absolute())
      found.push_back(fs::path(folder) / "contactcheck" / "fixtures");
  return found;
}

fs::path fixtures_directory() {
  const std::string own = environment("CONTACTCHECK_FIXTURES", "");
  if (!own.empty()) return own;
  std::error_code ignored;
  std::vector<fs::path> candidates = {
      installed_fixtures(fs::read_symlink("/proc/self/exe", ignored)),
      CONTACTCHECK_FIXTURES_BUILT_FROM};
  for (const fs::path& each :
       shared_fixtures(environment("XDG_DATA_DIRS", "/usr/local/share:/usr/share")))
    candidates.push_back(each);
  for (const fs::path& each : candidates)
    if (each.is_absolute() && fs::is_directory(each, ignored)) return each;
  return CONTACTCHECK_FIXTURES_BUILT_FROM;
}

}  // namespace contactcheck::scene
