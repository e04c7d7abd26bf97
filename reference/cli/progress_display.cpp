#include "reference/cli/progress_display.h"

#include <cstdio>

namespace contactcheck {
namespace {

std::string bar(double share) {
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(share * kWidth);
  return "[" + std::string(filled, '#') + std::string(kWidth - filled, '.') + "]";
}

}  // namespace

void ProgressDisplay::show(const SuiteProgress& progress) {
  if (quiet_) return;
  if (!terminal_) {
    if (progress.scene_id == last_scene_) return;
    last_scene_ = progress.scene_id;
    std::fprintf(stderr, "scene %zu of %zu: %s\n", progress.scene + 1, progress.scenes,
                 progress.scene_id.c_str());
    return;
  }
  char percent[16];
  std::snprintf(percent, sizeof percent, " %3.0f %% ", 100.0 * progress.share);
  const std::string line =
      bar(progress.share) + percent + progress.scene_id + "  " + progress.detector;
  if (line == last_line_) return;
  last_line_ = line;
  drawn_ = true;
  std::fprintf(stderr, "\r\x1b[K%.100s", line.c_str());
}

void ProgressDisplay::finish() {
  if (drawn_) std::fprintf(stderr, "\r\x1b[K");
  drawn_ = false;
}

}  // namespace contactcheck
