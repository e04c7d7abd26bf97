#include "reference/mesh/data_package.h"

#include <cstdlib>

#include "core/types/check.h"
#include "reference/text/file_text.h"

namespace contactcheck::mesh {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::vector<std::filesystem::path> data_roots() {
  const std::string own = environment("CONTACTCHECK_DATA");
  if (!own.empty()) return {own};
  std::vector<std::filesystem::path> roots = {"/"};
  const std::string cache = environment("XDG_CACHE_HOME"), home = environment("HOME");
  if (!cache.empty()) {
    roots.push_back(std::filesystem::path(cache) / "contactcheck");
  } else if (!home.empty()) {
    roots.push_back(std::filesystem::path(home) / ".cache" / "contactcheck");
  }
  return roots;
}

std::filesystem::path find_package_file(const std::vector<std::filesystem::path>& roots,
                                        const std::string& package, const std::string& path) {
  std::string searched;
  for (const std::filesystem::path& root : roots) {
    std::filesystem::path file = root / path;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
    searched += (searched.empty() ? "" : " or ") + text::in_quotes(file.string());
  }
  throw InputError("the Debian package " + package + " is missing (no file " + searched +
                   "): install it with \"apt-get install " + package +
                   "\", or run .ci/setup, which also unpacks it where /usr/share/doc is left out.");
}

}  // namespace contactcheck::mesh
