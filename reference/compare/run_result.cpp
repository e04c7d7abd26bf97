#include "reference/compare/run_result.h"

#include <algorithm>
#include <cstdlib>

namespace contactcheck {
namespace {

std::optional<double> rate(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

const char* name_of(RunStatus status) {
  switch (status) {
    case RunStatus::kOk:
      return "ok";
    case RunStatus::kError:
      return "error";
    case RunStatus::kAbsent:
      return "absent";
    case RunStatus::kRefused:
      return "refused";
  }
  return "unknown";
}

std::optional<double> LevelCounts::recall() const { return rate(hit, truth); }
std::optional<double> LevelCounts::spurious_rate() const { return rate(spurious, reported); }

LevelCounts& LevelCounts::operator+=(const LevelCounts& other) {
  truth += other.truth;
  reported += other.reported;
  hit += other.hit;
  missed += other.missed;
  spurious += other.spurious;
  return *this;
}

std::optional<double> RunResult::hover_gap_max() const {
  std::optional<double> worst;
  for (const Episode& e : episodes)
    if (e.hover_gap) worst = std::max(worst.value_or(0.0), *e.hover_gap);
  return worst;
}

std::optional<long> RunResult::late_frames_worst() const {
  std::optional<long> worst;
  for (const Episode& e : episodes) {
    if (e.late_frames && (!worst || std::labs(*e.late_frames) > std::labs(*worst)))
      worst = e.late_frames;
  }
  return worst;
}

}  // namespace contactcheck
