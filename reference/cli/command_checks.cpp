#include "reference/cli/command_checks.h"

#include <unistd.h>

#include "core/types/check.h"

namespace contactcheck::cli {

namespace fs = std::filesystem;

void check_out(const fs::path& out) {
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw InputError("--out " + out.string() + ": " + error.message());
  if (!fs::is_directory(out)) throw InputError("--out " + out.string() + ": is not a folder");
  if (access(out.c_str(), W_OK) != 0)
    throw InputError("--out " + out.string() + ": cannot be written");
}

}  // namespace contactcheck::cli
