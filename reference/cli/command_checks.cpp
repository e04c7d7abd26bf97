#include "reference/cli/command_checks.h"

#include <unistd.h>

#include <system_error>

#include "core/types/check.h"
#include "reference/text/counted.h"
#include "reference/text/file_text.h"

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

bool names_mesh(const std::string& target) {
  const fs::path file(target);
  std::string ending = file.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (ending.empty() || ending == ".json" || ending == ".ccr") return false;
  std::error_code ignored;
  return ending == ".obj" || ending == ".ply" || ending == ".off" || ending == ".stl" ||
         fs::is_regular_file(file, ignored);
}

void refuse_left_out(const scene::FrameFiles& files) {
  if (files.unchecked.empty()) return;
  const std::size_t more = files.unchecked.size() - 1;
  throw InputError("--between needs every frame of every body, and not every body has that of " +
                   text::in_quotes(files.unchecked[0]) +
                   (more > 0 ? " and " + text::counted(more, "more file") : "") +
                   "; contact between frames that are farther apart is another question");
}

}  // namespace contactcheck::cli
