#include "reference/diff/accuracy_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace contactcheck {
namespace {

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "none";
}

bool truth_differs(const ResultTable& before, const ResultTable& after, const std::string& scene) {
  const auto was = before.truth_hashes.find(scene), is = after.truth_hashes.find(scene);
  return was != before.truth_hashes.end() && is != after.truth_hashes.end() &&
         was->second != is->second;
}

/// Collects the changes of one row.
class RowComparison {
 public:
  RowComparison(const ResultRow& before, const ResultRow& after) : before_(before), after_(after) {
    change_.scene = after.scene;
    change_.detector = after.detector;
  }

  RowChange compare() {
    if (before_.status != after_.status) {
      compare_status();
    } else if (after_.status == "ok") {
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
    (before_.status == "ok" || after_.status == "error" ? worse_ : better_) = true;
    note(fmt::format("{} -> {}{}", before_.status, after_.status,
                     after_.message.empty() ? "" : ": " + after_.message));
  }

  void compare_levels() {
    std::set<std::string> names;
    for (const auto& [name, level] : before_.levels) names.insert(name);
    for (const auto& [name, level] : after_.levels) names.insert(name);
    for (const std::string& name : names) {
      const auto was = before_.levels.find(name), is = after_.levels.find(name);
      if (was == before_.levels.end() || is == after_.levels.end()) {
        note(fmt::format("level {} is judged only {}", name,
                         is == after_.levels.end() ? "before" : "after"));
      } else {
        compare_level(name, was->second, is->second);
      }
    }
  }

  void compare_level(const std::string& name, const LevelRow& was, const LevelRow& is) {
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
    for (const auto& [key, is] : after_.geometry) {
      const std::optional<double> was = before_.geometry.at(key);
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

  const ResultRow &before_, &after_;
  RowChange change_;
  bool worse_ = false, better_ = false;
};

}  // namespace

std::vector<RowChange> accuracy_changes(const ResultTable& before, const ResultTable& after) {
  std::vector<RowChange> changes;
  for (const ResultRow& row : after.rows) {
    const ResultRow* was = before.find(row.scene, row.detector);
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

}  // namespace contactcheck
