#include "reference/cli/command_checks.h"

#include <unistd.h>

#include "core/types/check.h"

namespace contactcheck {

namespace fs = std::filesystem;

Scene load_any_scene(const fs::path& file, std::size_t frames) {
  const bool recorded = file.extension() == ".ccr";
  if (recorded && frames > 0)
    throw InputError("--frames: recording \"" + file.string() +
                     "\" has its own frames and cannot be given others");
  return recorded ? load_recording(file) : load_scene(file, frames);
}

void check_out(const fs::path& out) {
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw InputError("--out " + out.string() + ": " + error.message());
  if (!fs::is_directory(out)) throw InputError("--out " + out.string() + ": is not a folder");
  if (access(out.c_str(), W_OK) != 0)
    throw InputError("--out " + out.string() + ": cannot be written");
}

}  // namespace contactcheck
