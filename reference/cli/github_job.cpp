#include "reference/cli/github_job.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "core/types/check.h"

namespace contactcheck::cli {

std::filesystem::path github_summary_file() {
  const char* const file = std::getenv("GITHUB_STEP_SUMMARY");
  return file == nullptr ? "" : file;
}

void append_github_summary(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out << text;
  out.close();
  if (!out)
    throw InputError("cannot append to " + file.string() +
                     ", which GITHUB_STEP_SUMMARY names: " + std::strerror(errno));
}

}  // namespace contactcheck::cli
