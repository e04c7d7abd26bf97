#include "reference/results/diff_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace contactcheck::results {
namespace {

// A row may differ at seven levels and in eleven errors.
constexpr std::size_t kDifferencesPerLine = 3;

using Lines = std::vector<std::string>;

std::string section(const std::string& title, const Lines& lines) {
  if (lines.empty()) return "";
  std::string text = fmt::format("{} ({})\n", title, lines.size());
  for (std::size_t i = 0; i < std::min(lines.size(), kLinesPerSection); ++i)
    text += "  " + lines[i] + "\n";
  if (lines.size() > kLinesPerSection)
    text += fmt::format("  ... and {} more\n", lines.size() - kLinesPerSection);
  return text;
}

Lines lines_of(const std::vector<RowChange>& changes, Direction direction) {
  Lines lines;
  for (const RowChange& change : changes)
    if (change.direction == direction) lines.push_back(change_line(change));
  return lines;
}

// "1.32x [1.28, 1.36] slower, measured against fcl-aabb".
std::string time_line(const TimeChange& change) {
  Ratio f = change.factor;
  const bool slower = f.value < 1.0;
  if (slower) f = {1.0 / f.value, 1.0 / f.high, 1.0 / f.low};
  return fmt::format("{}  {}  {} {}, measured against {}", change.scene, change.detector,
                     ratio_text(f, change.passes), slower ? "slower" : "faster", change.reference);
}

Lines time_lines(const std::vector<TimeChange>& times, bool slower) {
  Lines lines;
  for (const TimeChange& change : times)
    if ((change.factor.value < 1.0) == slower) lines.push_back(time_line(change));
  return lines;
}

}  // namespace

std::string change_line(const RowChange& change) {
  std::string what;
  const std::size_t shown = std::min(change.what.size(), kDifferencesPerLine);
  for (std::size_t i = 0; i < shown; ++i) what += (i > 0 ? ", " : "") + change.what[i];
  if (const std::size_t left = change.what.size() - shown; left > 0)
    what += fmt::format(", and {} more", left);
  return fmt::format("{}  {}  {}", change.scene, change.detector, what);
}

std::string diff_text(const ResultsDiff& diff) {
  std::string text;
  text += section("Another machine: times compare ratios, but caches and instructions differ",
                  diff.machine);
  text += section("Another scene of the same name: its exact truth differs", diff.other_scenes);
  text += section("Worse", lines_of(diff.changes, Direction::kWorse));
  text += section("Better", lines_of(diff.changes, Direction::kBetter));
  text +=
      section("Other answers, neither better nor worse", lines_of(diff.changes, Direction::kOther));
  text += section("Slower", time_lines(diff.times, true));
  text += section("Faster", time_lines(diff.times, false));
  text += section("New", diff.added);
  text += section("Gone", diff.gone);
  text += fmt::format("{} of {} common rows have the same answers; {} differ clearly in time.\n",
                      diff.common - diff.changes.size(), diff.common, diff.times.size());
  return text;
}

}  // namespace contactcheck::results
