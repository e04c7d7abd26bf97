#include "reference/results/accuracy_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace contactcheck::results {
namespace {

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "none";
}

bool truth_differs(const results::Index& before, const results::Index& after,
                   const std::string& scene) {
  const results::Scene *was = before.scene(scene), *is = after.scene(scene);
  return was != nullptr && is != nullptr && was->truth_hash != is->truth_hash;
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

/// Collects the changes of one row.
class RowComparison {
 public:
  RowComparison(const results::Run& before, const results::Run& after)
      : before_(before), after_(after) {
    change_.scene = after.scene;
    change_.detector = after.detector;
  }

  RowChange compare() {
    if (before_.status != after_.status) {
      compare_status();
    } else if (after_.ok()) {
      compare_levels();
      compare_geometry();
      if (before_.contact_hash != after_.contact_hash)
        note(fmt::format("contact hash {} -> {}", before_.contact_hash, after_.contact_hash));
    }
    if (worse_ || better_) change_.direction = worse_ ? Direction::kWorse : Direction::kBetter;
    return std::move(change_);
  }

 private:
  void note(std::string what) { change_.what.push_back(std::move(what)); }

  void compare_status() {
    change_.weight = std::numeric_limits<double>::infinity();
    (before_.ok() || after_.status == results::Status::kError ? worse_ : better_) = true;
    note(fmt::format("{} -> {}{}", name_of(before_.status), name_of(after_.status),
                     after_.message.empty() ? "" : ": " + after_.message));
  }

  void compare_levels() {
    const NamedLevels before = levels_of(before_), after = levels_of(after_);
    NamedLevels all = before;
    all.insert(after.begin(), after.end());
    for (const auto& [name, counts] : all) {
      const auto was = before.find(name), is = after.find(name);
      if (was == before.end() || is == after.end()) {
        note(fmt::format("level {} is judged only {}", name,
                         is == after.end() ? "before" : "after"));
      } else {
        compare_level(name, *was->second, *is->second);
      }
    }
  }

  void compare_level(const std::string& name, const results::LevelCounts& was,
                     const results::LevelCounts& is) {
    const std::string shown = name + (is.informative ? " (informative)" : "");
    if (was.truth != is.truth) note(fmt::format("{} truth {} -> {}", shown, was.truth, is.truth));
    compare_count(shown + " missed", was.missed, is.missed, is.informative);
    compare_count(shown + " spurious", was.spurious, is.spurious, is.informative);
  }

  void compare_count(const std::string& name, std::uint64_t was, std::uint64_t is,
                     bool informative) {
    if (was == is) return;
    note(fmt::format("{} {} -> {}", name, was, is));
    // What a detector does not claim is nothing that it could get wrong.
    if (informative) return;
    (is > was ? worse_ : better_) = true;
    change_.weight =
        std::max(change_.weight, std::fabs(static_cast<double>(is) - static_cast<double>(was)));
  }

  void compare_geometry() {
    const results::NamedErrors before = results::errors_of(before_.geometry),
                               after = results::errors_of(after_.geometry);
    for (std::size_t i = 0; i < after.size(); ++i) {
      const auto& [key, is] = after[i];
      const std::optional<double> was = before[i].second;
      if (was == is) continue;
      note(fmt::format("{} {} -> {}", key, text_of(was), text_of(is)));
      if (was && is) compare_errors(error_of(key, *was), error_of(key, *is));
    }
  }

  // Equal where only the sign of late_frames has changed.
  void compare_errors(double was, double is) {
    worse_ = worse_ || is > was;
    better_ = better_ || is < was;
  }

  static double error_of(const std::string& key, double value) {
    if (key == "covered_length_fraction") return 1.0 - value;
    return std::fabs(value);  // late_frames is signed, and early is no better than late
  }

  const results::Run &before_, &after_;
  RowChange change_;
  bool worse_ = false, better_ = false;
};

}  // namespace

std::vector<RowChange> accuracy_changes(const results::Index& before, const results::Index& after) {
  std::vector<RowChange> changes;
  for (const results::Run& row : after.results().runs) {
    const results::Run* was = before.run(row.scene, row.detector);
    if (was == nullptr) continue;
    RowChange change = RowComparison(*was, row).compare();
    if (was->status == row.status && truth_differs(before, after, row.scene))
      change.direction = Direction::kOther;
    if (!change.what.empty()) changes.push_back(std::move(change));
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const RowChange& a, const RowChange& b) { return a.weight > b.weight; });
  return changes;
}

}  // namespace contactcheck::results
