#include "reference/diff/results_diff.h"

#include <fmt/format.h>

#include <algorithm>

namespace contactcheck {
namespace {

// What times depend on.
std::vector<std::string> machine_changes(const results::Machine& before,
                                         const results::Machine& after) {
  std::vector<std::string> out;
  const auto compare = [&](const char* what, const std::string& was, const std::string& is) {
    if (was != is) out.push_back(fmt::format("{} \"{}\" -> \"{}\"", what, was, is));
  };
  compare("cpu", before.cpu, after.cpu);
  compare("isa", before.isa, after.isa);
  compare("compiler", before.compiler, after.compiler);
  compare("build", before.build, after.build);
  return out;
}

std::vector<std::string> changed_scenes(const results::Index& before,
                                        const results::Results& after) {
  std::vector<std::string> out;
  for (const results::Scene& scene : after.scenes) {
    const results::Scene* const was = before.scene(scene.id);
    if (was != nullptr && was->truth_hash != scene.truth_hash) out.push_back(scene.id);
  }
  std::sort(out.begin(), out.end());
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

std::vector<std::string> missing_rows(const results::Index& results,
                                      const results::Results& other) {
  Counts scenes, detectors;
  for (const results::Run& row : other.runs) {
    if (results.runs_of(row.scene).empty()) {
      count(row.scene, scenes);
    } else if (results.run(row.scene, row.detector) == nullptr) {
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

ResultsDiff diff_results(const results::Results& before, const results::Results& after) {
  const results::Index was(before), is(after);
  ResultsDiff diff;
  diff.machine = machine_changes(before.machine, after.machine);
  diff.other_scenes = changed_scenes(was, after);
  diff.changes = accuracy_changes(was, is);
  diff.times = time_changes(was, after);
  diff.added = missing_rows(was, after);
  diff.gone = missing_rows(is, before);
  for (const results::Run& row : after.runs)
    if (was.run(row.scene, row.detector) != nullptr) ++diff.common;
  return diff;
}

}  // namespace contactcheck
