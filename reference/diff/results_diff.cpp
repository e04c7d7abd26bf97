#include "reference/diff/results_diff.h"

#include <fmt/format.h>

#include <algorithm>

namespace contactcheck {
namespace {

std::vector<std::string> machine_changes(const ResultTable& before, const ResultTable& after) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < before.machine.size(); ++i) {
    const auto& [key, was] = before.machine[i];
    const std::string& is = after.machine[i].second;
    if (was != is) out.push_back(fmt::format("{} \"{}\" -> \"{}\"", key, was, is));
  }
  return out;
}

std::vector<std::string> changed_scenes(const ResultTable& before, const ResultTable& after) {
  std::vector<std::string> out;
  for (const auto& [scene, hash] : after.truth_hashes) {
    const auto was = before.truth_hashes.find(scene);
    if (was != before.truth_hashes.end() && was->second != hash) out.push_back(scene);
  }
  return out;
}

using Counts = std::vector<std::pair<std::string, std::size_t>>;

void count(const std::string& name, Counts& counts) {
  const auto it = std::find_if(counts.begin(), counts.end(),
                               [&](const auto& entry) { return entry.first == name; });
  if (it == counts.end()) {
    counts.emplace_back(name, 1);
  } else {
    ++it->second;
  }
}

std::string plural(std::size_t n, const char* one) {
  return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
}

}  // namespace

std::vector<std::string> missing_rows(const ResultTable& table, const ResultTable& other) {
  Counts scenes, detectors;
  for (const ResultRow& row : other.rows) {
    if (!table.has_scene(row.scene)) {
      count(row.scene, scenes);
    } else if (table.find(row.scene, row.detector) == nullptr) {
      count(row.detector, detectors);
    }
  }
  std::vector<std::string> out;
  for (const auto& [name, n] : scenes)
    out.push_back(fmt::format("scene {} ({})", name, plural(n, "detector")));
  for (const auto& [name, n] : detectors)
    out.push_back(fmt::format("detector {} (in {})", name, plural(n, "scene")));
  return out;
}

ResultsDiff diff_results(const ResultTable& before, const ResultTable& after) {
  ResultsDiff diff;
  diff.machine = machine_changes(before, after);
  diff.other_scenes = changed_scenes(before, after);
  diff.changes = accuracy_changes(before, after);
  diff.times = time_changes(before, after);
  diff.added = missing_rows(before, after);
  diff.gone = missing_rows(after, before);
  for (const ResultRow& row : after.rows)
    if (before.find(row.scene, row.detector) != nullptr) ++diff.common;
  return diff;
}

}  // namespace contactcheck
