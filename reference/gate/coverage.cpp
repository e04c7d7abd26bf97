#include "reference/gate/coverage.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "reference/gate/blame.h"
#include "reference/scene/file_text.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;
using Rows = std::vector<const Json*>;

Check failure(const std::string& rule, const std::string& reason) {
  Check out;
  out.rule = rule;
  out.verdict = Verdict::kFail;
  out.red = true;
  out.reason = reason;
  return out;
}

std::string quoted(const std::vector<std::string>& patterns) {
  std::string out;
  for (const std::string& pattern : patterns) out += (out.empty() ? "" : ", ") + in_quotes(pattern);
  return out;
}

Check idle_rule(const Rule& rule) {
  Check out =
      failure(rule.name, "matches nothing: no row has a scene of " + quoted(rule.scenes.wanted));
  if (!rule.detectors.wanted.empty())
    out.reason += " and a detector of " + quoted(rule.detectors.wanted);
  out.why = rule.why;
  return out;
}

void add_idle(const Rule& rule, const Patterns& patterns, const char* key, const Rows& rows,
              std::vector<Check>& out) {
  for (const std::string& pattern : patterns.wanted) {
    const bool used = std::any_of(rows.begin(), rows.end(), [&](const Json* row) {
      return matches(pattern, row->at(key).get<std::string>());
    });
    if (used) continue;
    out.push_back(failure(rule.name, "matches nothing: no row of the rule has a " +
                                         std::string(key) + " " + in_quotes(pattern)));
    out.back().why = rule.why;
  }
}

Check lost(const Json& old, const std::string& reason) {
  Check out = failure(kBaselineRule, reason);
  out.scene = old.at("scene").get<std::string>();
  out.detector = old.at("detector").get<std::string>();
  return out;
}

// Status and message of a row that ended well before.
Check ended(const RowIndex& now, const Json& row) {
  static const Rule accuracy = [] {
    Rule rule;
    rule.measure = find_measure("status");
    return rule;
  }();
  Check out = lost(row, row.at("message").get<std::string>());
  out.measured = "status " + row.at("status").get<std::string>();
  out.allowed = "ok, that of the baseline";
  out.frame = worst_frame(accuracy, now, row);
  out.rerun = rerun_command(accuracy, now, row);
  return out;
}

}  // namespace

std::vector<Check> idle_patterns(const Rule& rule, const Rows& rows) {
  if (rows.empty()) return {idle_rule(rule)};
  std::vector<Check> out;
  add_idle(rule, rule.scenes, "scene", rows, out);
  add_idle(rule, rule.detectors, "detector", rows, out);
  return out;
}

std::vector<Check> lost_rows(const RowIndex& now, const RowIndex& before) {
  std::vector<Check> out;
  std::set<std::string> lost_scenes;
  for (const Json& old : before.results().at("runs")) {
    const auto scene = old.at("scene").get<std::string>();
    const Json* const row = now.row(scene, old.at("detector").get<std::string>());
    if (row != nullptr) {
      if (old.at("status") == "ok" && row->at("status") != "ok") out.push_back(ended(now, *row));
    } else if (now.has_scene(scene)) {
      out.push_back(lost(old, "the baseline has this detector in this scene, the results do not"));
    } else if (lost_scenes.insert(scene).second) {
      out.push_back(failure(kBaselineRule, "the baseline has this scene, the results do not"));
      out.back().scene = scene;
    }
  }
  return out;
}

}  // namespace contactcheck
