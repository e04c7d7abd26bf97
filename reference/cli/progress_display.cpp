#include "reference/cli/progress_display.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace contactcheck::cli {
namespace {

// A share grows in jumps: the first ones say little about the rest.
constexpr double kLeastShare = 0.02, kLeastSeconds = 2.0;
// Wider lines would only take the eye further.
constexpr std::size_t kMostColumns = 120;

std::string bar(double share) {
  constexpr int kBarWidth = 20;
  const int filled = static_cast<int>(share * kBarWidth);
  return "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "]";
}

// A line that is broken cannot be drawn again in its place.
std::size_t columns_of_terminal() {
  struct winsize size = {};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? std::min<std::size_t>(size.ws_col - 1u, kMostColumns) : 79;
}

}  // namespace

std::optional<double> seconds_left(double elapsed, double first_share, double share) {
  const double done = share - first_share;
  if (done < kLeastShare || elapsed < kLeastSeconds) return std::nullopt;
  return elapsed * (1.0 - share) / done;
}

std::string time_left_text(double seconds) {
  const long whole = std::lround(std::min(seconds, 1e6));
  char text[48];
  if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld left", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld left", whole / 3600, whole / 60 % 60,
                  whole % 60);
  }
  return text;
}

std::string progress_line(const suite::SuiteProgress& progress, std::optional<double> seconds_left,
                          std::size_t columns) {
  char percent[16];
  std::snprintf(percent, sizeof percent, " %3.0f %%", 100.0 * progress.share);
  std::string line = bar(progress.share) + percent;
  if (seconds_left) line += "  " + time_left_text(*seconds_left);
  line += "  " + progress.scene_id;
  if (progress.frame)
    line +=
        "  frame " + std::to_string(*progress.frame + 1) + " of " + std::to_string(progress.frames);
  if (!progress.detector.empty()) line += "  " + progress.detector;
  return line.substr(0, columns);
}

void ProgressDisplay::show(const suite::SuiteProgress& progress,
                           std::optional<double> seconds_left) {
  if (quiet_) return;
  if (!terminal_) {
    if (progress.scene_id == last_scene_) return;
    last_scene_ = progress.scene_id;
    std::fprintf(stderr, "scene %zu of %zu: %s\n", progress.scene + 1, progress.scenes,
                 progress.scene_id.c_str());
    return;
  }
  const std::string line = progress_line(progress, seconds_left, columns_of_terminal());
  if (line == last_line_) return;
  last_line_ = line;
  drawn_ = true;
  std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
}

void ProgressDisplay::finish() {
  if (drawn_) std::fprintf(stderr, "\r\x1b[K");
  drawn_ = false;
}

}  // namespace contactcheck::cli
