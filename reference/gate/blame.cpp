#include "reference/gate/blame.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "reference/gate/accuracy_rule.h"
#include "reference/results/rerun.h"

namespace contactcheck::gate {
namespace {

std::optional<std::size_t> largest(const std::vector<std::uint64_t>& counts) {
  std::optional<std::size_t> at;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > (at ? counts[*at] : 0)) at = i;
  return at;
}

std::optional<std::size_t> smallest_share(const std::vector<std::optional<double>>& shares) {
  std::optional<std::size_t> at;
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (shares[i] && *shares[i] < (at ? *shares[*at] : 1.0)) at = i;
  return at;
}

// What the rule counts: "missed", "spurious", or "" for any.
std::string kind_of(const Rule& rule) {
  const std::string name = rule.measure->name;
  if (name == "missed" || name == "recall" || name == "missed_length" || name == "stage_missed")
    return "missed";
  return name.rfind("spurious", 0) == 0 ? "spurious" : "";
}

std::optional<std::size_t> frame_to_blame(const Rule& rule, const results::Results& results,
                                          const results::Run& row) {
  if (!row.ok()) return row.failed_frame;
  if (rule.measure->name == std::string("covered_length_fraction"))
    return smallest_share(row.per_frame.covered_length_fraction);
  if (rule.rounded) return std::nullopt;  // per frame there are counts of the doubles alone
  const MeasureKind measure = rule.measure->kind;
  const std::string kind = kind_of(rule);
  if (kind.empty() && measure != MeasureKind::kLevel && measure != MeasureKind::kHash &&
      measure != MeasureKind::kStages)
    return std::nullopt;
  const std::optional<Level> level =
      measure == MeasureKind::kLevel ? level_of(rule, row) : std::nullopt;
  if (!level || level == row.per_frame.level) {
    const auto missed = kind == "spurious" ? std::nullopt : largest(row.per_frame.missed);
    return missed || kind == "missed" ? missed : largest(row.per_frame.spurious);
  }
  for (const results::Disagreement& d : results.disagreements)
    if (d.scene == row.scene && d.detector == row.detector && d.level == name_of(*level) &&
        (kind.empty() || d.kind == kind))
      return d.frame;
  return std::nullopt;
}

// " --processes 3"; nothing where the results do not say how they were timed. A seed that was not
// asked for is every run's.
std::string timing_flags(const results::Results& results, Verdict verdict) {
  const results::Timing timing = results.timing.value_or(results::Timing{0, 0.0, 1, 0});
  std::size_t processes = timing.processes;
  if (verdict == Verdict::kCannotJudge)
    processes = std::max(processes, results::kFewestForInterval);
  std::string out = processes == 0 ? "" : " --processes " + std::to_string(processes);
  if (timing.seed != 1) out += " --seed " + std::to_string(timing.seed);
  return out;
}

}  // namespace

std::string worst_frame(const Rule& rule, const results::Index& index, const results::Run& row) {
  const auto frame = frame_to_blame(rule, index.results(), row);
  if (!frame) return "";
  std::string out = "frame " + std::to_string(*frame);
  const results::Scene* const scene = index.scene(row.scene);
  if (scene == nullptr || !scene->family || *frame >= scene->family->values.size()) return out;
  return out + " (" + scene->family->values[*frame] + ")";
}

std::string rerun_command(const Rule& rule, const results::Index& index, const results::Run& row,
                          Verdict verdict) {
  const results::Scene* const scene = index.scene(row.scene);
  const bool timed = is_timing(*rule.measure);
  std::vector<std::string> detectors = {row.detector};
  if (timed) detectors.push_back(rule.reference);
  std::string flags;
  for (const std::string& detector : detectors) {
    const std::string words = results::detector_words(index.results(), detector);
    if (words.empty()) return "";
    flags += " " + words;
  }
  flags += timed ? timing_flags(index.results(), verdict) : " --no-timing";
  if (scene != nullptr && scene->pairs) return pairs_command(*scene) + flags;
  const std::string target = results::scene_words(index.results(), row.scene);
  std::string command = "contactcheck run " + target;
  // The frames of families and recordings are fixed.
  const bool fixed = (scene != nullptr && scene->family) || target.ends_with(".ccr") ||
                     target.ends_with(".ccr'") || row.frames == 0;
  if (!fixed) command += " --frames " + std::to_string(row.frames);
  return command + flags;
}

std::string pairs_command(const results::Scene& scene) {
  return "contactcheck run --pairs " + std::to_string(scene.pairs->count) + " --seed " +
         std::to_string(scene.pairs->seed);
}

}  // namespace contactcheck::gate
