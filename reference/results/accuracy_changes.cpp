#include "reference/results/accuracy_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace contactcheck::results {
namespace {

// Four digits, or as many as show the difference.
std::string change_text(const std::optional<double>& was, const std::optional<double>& is) {
  const auto text = [](const std::optional<double>& value, int digits) {
    return value ? fmt::format("{:.{}g}", *value, digits) : "none";
  };
  int digits = 4;
  while (digits < 17 && text(was, digits) == text(is, digits)) ++digits;
  return text(was, digits) + " -> " + text(is, digits);
}

double error_size(const std::string& key, double value) {
  if (key == "covered_length_fraction") return 1.0 - value;
  return std::fabs(value);  // late_frames is signed, and early is no better than late
}

using NamedLevels = std::map<std::string, const results::LevelCounts*>;

// "triangle"; against the truth of the values that it was fed, "triangle rounded".
NamedLevels levels_of(const results::Run& run) {
  NamedLevels named;
  for (const auto& [level, counts] : run.levels) named[name_of(level)] = &counts;
  for (const auto& [level, counts] : run.levels_rounded)
    named[name_of(level) + std::string(" rounded")] = &counts;
  return named;
}

RowChange row_change(const results::Run& before, const results::Run& after) {
  RowChange change;
  change.scene = after.scene;
  change.detector = after.detector;
  bool worse = false, better = false;
  const auto note = [&](std::string what) { change.what.push_back(std::move(what)); };
  if (before.status != after.status) {
    change.weight = std::numeric_limits<double>::infinity();
    (before.ok() || after.status == results::Status::kError ? worse : better) = true;
    note(fmt::format("{} -> {}{}", name_of(before.status), name_of(after.status),
                     after.message.empty() ? "" : ": " + after.message));
  } else if (after.ok()) {
    const auto compare_count = [&](const std::string& name, std::uint64_t was, std::uint64_t is,
                                   bool informative) {
      if (was == is) return;
      note(fmt::format("{} {} -> {}", name, was, is));
      // What a detector does not claim is nothing that it could get wrong.
      if (informative) return;
      (is > was ? worse : better) = true;
      change.weight =
          std::max(change.weight, std::fabs(static_cast<double>(is) - static_cast<double>(was)));
    };
    const NamedLevels levels_before = levels_of(before), levels_after = levels_of(after);
    NamedLevels all = levels_before;
    all.insert(levels_after.begin(), levels_after.end());
    for (const auto& [name, counts] : all) {
      const auto then = levels_before.find(name), now = levels_after.find(name);
      if (then == levels_before.end() || now == levels_after.end()) {
        note(fmt::format("level {} is judged only {}", name,
                         now == levels_after.end() ? "before" : "after"));
        continue;
      }
      const results::LevelCounts &was = *then->second, &is = *now->second;
      const std::string shown = name + (is.informative ? " (informative)" : "");
      if (was.truth != is.truth) note(fmt::format("{} truth {} -> {}", shown, was.truth, is.truth));
      compare_count(shown + " missed", was.missed, is.missed, is.informative);
      compare_count(shown + " spurious", was.spurious, is.spurious, is.informative);
    }

    const results::NamedErrors errors_before = results::errors_of(before),
                               errors_after = results::errors_of(after);
    for (std::size_t i = 0; i < errors_after.size(); ++i) {
      const auto& [key, is] = errors_after[i];
      const std::optional<double> was = errors_before[i].second;
      if (was == is) continue;
      note(key + (" " + change_text(was, is)));
      if (!was || !is) continue;
      // Equal where only the sign of late_frames has changed.
      const double size_before = error_size(key, *was), size_after = error_size(key, *is);
      worse = worse || size_after > size_before;
      better = better || size_after < size_before;
    }

    if (before.contact_hash != after.contact_hash)
      note(fmt::format("contact hash {} -> {}", before.contact_hash, after.contact_hash));
  }
  if (worse && better) note("mixed: better in some of these");
  if (worse || better) change.direction = worse ? Direction::kWorse : Direction::kBetter;
  return change;
}

}  // namespace

std::vector<RowChange> accuracy_changes(const results::Index& before, const results::Index& after) {
  std::vector<RowChange> changes;
  for (const results::Run& row : after.results().runs) {
    const results::Run* was = before.run(row.scene, row.detector);
    if (was == nullptr) continue;
    RowChange change = row_change(*was, row);
    const results::Scene *scene_before = before.scene(row.scene), *scene = after.scene(row.scene);
    if (was->status == row.status && scene_before != nullptr && scene != nullptr &&
        scene_before->truth_hash != scene->truth_hash)
      change.direction = Direction::kOther;
    if (!change.what.empty()) changes.push_back(std::move(change));
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const RowChange& a, const RowChange& b) { return a.weight > b.weight; });
  return changes;
}

}  // namespace contactcheck::results
