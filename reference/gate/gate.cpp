#include "reference/gate/gate.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "reference/gate/accuracy_rule.h"
#include "reference/gate/blame.h"
#include "reference/gate/timing_rule.h"
#include "reference/text/file_text.h"
#include "reference/text/json_value.h"
#include "reference/text/lists.h"

namespace contactcheck::gate {
namespace {

Check failure(const std::string& rule, const std::string& reason) {
  Check out;
  out.rule = rule;
  out.verdict = Verdict::kFail;
  out.red = true;
  out.reason = reason;
  return out;
}

std::string quoted(const std::vector<std::string>& patterns) {
  return text::joined(patterns, [](const std::string& one) { return text::in_quotes(one); });
}

// Whether it shared a process with what it could have changed, and that with it.
bool is_unisolated(const results::Results& results, const results::Run& row) {
  const results::Plugin* const plugin = results.plugin_of(row.detector);
  return plugin != nullptr && plugin->unisolated;
}

// A row without an answer cannot be judged, except by a rule about the status itself.
Check judge_row(const Rule& rule, const results::Index& now, const results::Index* before,
                const results::Run& row) {
  if (is_unisolated(now.results(), row))
    return cannot_judge(rule, "unisolated: it was asked in the process that called run()");
  if (row.ok() || rule.measure->kind == MeasureKind::kStatus)
    return is_timing(*rule.measure) ? judge_timing(rule, now, before, row)
                                    : judge_accuracy(rule, now, before, row);
  Check out = cannot_judge(rule, name_of(row.status) + (": " + row.message));
  if (row.status == results::Status::kAbsent) return out;
  const bool fails = row.status == results::Status::kError ? rule.error_fails : rule.refused_fails;
  out.verdict = fails ? Verdict::kFail : Verdict::kCannotJudge;
  out.measured = std::string("status ") + name_of(row.status);
  out.reason = row.message;
  return out;
}

void apply_rule(const Rule& rule, const results::Index& now, const results::Index* before,
                std::vector<Check>& out) {
  std::vector<RowName> rows;
  const auto add = [&](Check check, const std::string& scene, const std::string& detector) {
    check.rule = rule.name;
    check.why = rule.why;
    check.scene = scene;
    check.detector = detector;
    check.red = check.verdict == Verdict::kFail ||
                (check.verdict == Verdict::kTooNoisy && rule.noisy_fails) ||
                (check.verdict == Verdict::kCannotJudge && rule.unjudged_fails);
    out.push_back(std::move(check));
  };
  if (rule.measure->kind == MeasureKind::kOracle) {
    for (const results::Scene& scene : now.results().scenes) {
      if (!scene.pairs || !rule.scenes.hold(scene.id)) continue;
      rows.push_back({scene.id, ""});
      Check check = judge_oracle(rule, scene);
      if (check.verdict != Verdict::kPass) check.rerun = pairs_command(scene);
      add(std::move(check), scene.id, "oracle");
    }
  } else {
    for (const results::Run& row : now.results().runs) {
      if (!rule.scenes.hold(row.scene) || !rule.detectors.hold(row.detector)) continue;
      rows.push_back({row.scene, row.detector});
      Check check = judge_row(rule, now, before, row);
      if (check.verdict == Verdict::kFail) check.frame = worst_frame(rule, now, row);
      if (check.verdict != Verdict::kPass)
        check.rerun = rerun_command(rule, now, row, check.verdict);
      add(std::move(check), row.scene, row.detector);
    }
  }
  for (Check& idle : idle_patterns(rule, rows, now.results())) out.push_back(std::move(idle));
}

// "x in the baseline, y now"
std::string change(const std::string& what, const std::string& before, const std::string& now) {
  return what + " " + before + " in the baseline, " + now + " now";
}

std::vector<std::string> levels_no_more(const results::Run& row, const results::Run& old) {
  std::vector<std::string> out;
  for (const auto& [level, counts] : old.levels) {
    const auto now = row.levels.find(level);
    if (counts.informative || (now != row.levels.end() && !now->second.informative)) continue;
    const auto reason = row.not_judged.find(level);
    out.push_back(std::string("level ") + name_of(level) + " was judged in the baseline; now " +
                  (!row.semantics.claims(level)     ? "the detector does not claim it"
                   : reason != row.not_judged.end() ? "it is " + reason->second
                                                    : "the scene does not ask for it"));
  }
  return out;
}

// What is judged by another measure cannot be compared: a wider margin or tolerance excuses more.
std::vector<std::string> changed_measures(const Semantics& now, const Semantics& before) {
  std::vector<std::string> out;
  const auto compare = [&](const std::string& what, const std::string& a, const std::string& b) {
    if (a != b) out.push_back(change("it declares " + what, a, b));
  };
  const auto yes = [](bool b) { return std::string(b ? "yes" : "no"); };
  compare("margin (metres)", text::shown(before.margin), text::shown(now.margin));
  if (now.tolerance.absolute > before.tolerance.absolute)
    compare("tolerance (metres)", text::shown(before.tolerance.absolute),
            text::shown(now.tolerance.absolute));
  if (now.tolerance.of_start > before.tolerance.of_start)
    compare("tolerance (share of the distance at the start)",
            text::shown(before.tolerance.of_start), text::shown(now.tolerance.of_start));
  compare("that containment is contact:", yes(before.solid), yes(now.solid));
  compare("that touching is contact:", yes(before.closed), yes(now.closed));
  if (before.exact) compare("that it is exact:", "yes", yes(now.exact));
  compare("precision", name_of(before.precision), name_of(now.precision));
  compare("scale", text::shown(before.scale), text::shown(now.scale));
  if (before.depth != DepthKind::kNone) compare("depth", name_of(before.depth), name_of(now.depth));
  return out;
}

}  // namespace

std::vector<std::string> judged_no_more(const results::Run& row, const results::Run& old) {
  std::vector<std::string> out = levels_no_more(row, old);
  for (const Question question : old.semantics.questions)
    if (!row.semantics.answers(question))
      out.push_back(std::string("question ") + name_of(question) +
                    " was answered in the baseline; now the detector does not answer it");
  for (std::string& changed : changed_measures(row.semantics, old.semantics))
    out.push_back(std::move(changed));
  if (row.frames < old.frames)
    out.push_back(change("judged frames:", std::to_string(old.frames), std::to_string(row.frames)));
  const auto none_now = [&](const std::string& what, std::uint64_t before, std::uint64_t now) {
    if (before > 0 && now == 0) out.push_back(change(what, std::to_string(before), "none"));
  };
  none_now("judged depths:", old.geometry.depth.judged, row.geometry.depth.judged);
  none_now("judged normals:", old.geometry.normal_deg.judged, row.geometry.normal_deg.judged);
  none_now("judged times within steps:", old.impacts ? old.impacts->timed : 0,
           row.impacts ? row.impacts->timed : 0);
  if (old.closed_loop && !row.closed_loop)
    out.push_back("the motion that it drives was judged in the baseline, and is not now");
  return out;
}

std::vector<Check> idle_patterns(const Rule& rule, const std::vector<RowName>& rows,
                                 const results::Results& results) {
  std::vector<Check> out;
  const auto add = [&](const std::string& reason) {
    out.push_back(failure(rule.name, "matches nothing: no row " + reason));
    out.back().why = rule.why;
  };
  const auto names_in_results = [&](const std::string& what, std::string results::Run::*name) {
    constexpr std::size_t kMost = 8;
    std::vector<std::string> names;
    for (const results::Run& run : results.runs)
      if (std::find(names.begin(), names.end(), run.*name) == names.end())
        names.push_back(run.*name);
    const std::size_t more = names.size() > kMost ? names.size() - kMost : 0;
    names.resize(names.size() - more);
    return names.empty()
               ? "; the results have none"
               : "; the results have the " + what + (names.size() > 1 ? "s " : " ") +
                     quoted(names) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
  };
  const std::string has_scenes = names_in_results("scene", &results::Run::scene),
                    has_detectors = names_in_results("detector", &results::Run::detector);
  if (rows.empty()) {
    const std::vector<std::string>& detectors = rule.detectors.wanted;
    const bool has_scene =
        std::any_of(results.runs.begin(), results.runs.end(),
                    [&](const results::Run& run) { return rule.scenes.hold(run.scene); });
    add("has a scene of " + quoted(rule.scenes.wanted) +
        (detectors.empty() ? "" : " and a detector of " + quoted(detectors)) +
        (has_scene && !detectors.empty() ? has_detectors : has_scenes));
    return out;
  }
  const auto add_unused = [&](const Patterns& patterns, const std::string& what,
                              std::string RowName::*name, const std::string& has) {
    for (const std::string& pattern : patterns.wanted)
      if (std::none_of(rows.begin(), rows.end(),
                       [&](const RowName& row) { return matches(pattern, row.*name); }))
        add("of the rule has a " + what + " " + text::in_quotes(pattern) + has);
  };
  add_unused(rule.scenes, "scene", &RowName::scene, has_scenes);
  add_unused(rule.detectors, "detector", &RowName::detector, has_detectors);
  return out;
}

std::optional<Check> too_many_open(const Policy& policy, const GateResult& result) {
  const std::vector<std::string> open = result.rules_with(Verdict::kCannotJudge);
  if (!policy.cannot_judge_at_most || open.size() <= *policy.cannot_judge_at_most)
    return std::nullopt;
  Check out = failure(kOpenRule, "they are " + quoted(open));
  out.measured = "rules that cannot judge " + std::to_string(open.size());
  out.allowed = "at most " + std::to_string(*policy.cannot_judge_at_most);
  return out;
}

std::vector<Check> lost_rows(const results::Index& now, const results::Results& before) {
  Rule about_status;  // for worst_frame and rerun_command
  about_status.measure = find_measure("status");
  std::vector<Check> out;
  std::set<std::string> lost_scenes;
  const auto add = [&](const results::Run& old, const std::string& reason) -> Check& {
    Check& check = out.emplace_back(failure(kBaselineRule, reason));
    check.scene = old.scene;
    return check;
  };
  for (const results::Run& old : before.runs) {
    const results::Run* const row = now.run(old.scene, old.detector);
    if (row != nullptr) {
      if (!old.ok() || is_unisolated(now.results(), *row)) continue;
      if (row->ok()) {
        for (const std::string& lost : judged_no_more(*row, old)) {
          Check& check = add(old, lost);
          check.detector = old.detector;
          check.rerun = rerun_command(about_status, now, *row, Verdict::kFail);
        }
        continue;
      }
      Check& check = add(old, row->message);
      check.detector = old.detector;
      check.measured = std::string("status ") + name_of(row->status);
      check.allowed = "ok, that of the baseline";
      check.frame = worst_frame(about_status, now, *row);
      check.rerun = rerun_command(about_status, now, *row, Verdict::kFail);
    } else if (now.scene(old.scene) != nullptr || !now.runs_of(old.scene).empty()) {
      add(old, "the baseline has this detector in this scene, the results do not").detector =
          old.detector;
    } else if (lost_scenes.insert(old.scene).second) {
      add(old, "the baseline has this scene, the results do not");
    }
  }
  return out;
}

GateResult run_gate(const Policy& policy, const results::Results& results,
                    const results::Results* baseline) {
  for (const Rule& rule : policy.rules)
    if (baseline == nullptr && needs_baseline(rule))
      throw InputError("policy \"" + policy.id + "\": rule \"" + rule.name +
                       "\" compares with an earlier run, and none is given; --baseline FILE names "
                       "one");
  const results::Index now(results);
  std::optional<results::Index> before;
  if (baseline != nullptr) before.emplace(*baseline);
  GateResult out;
  out.policy = policy.id;
  out.title = policy.title;
  out.results_command = results.command;
  out.rules = policy.rules.size();
  for (const Rule& rule : policy.rules) {
    const std::size_t first = out.checks.size();
    apply_rule(rule, now, before ? &*before : nullptr, out.checks);
    if (policy.advisory_times && is_timing(*rule.measure))
      for (std::size_t i = first; i < out.checks.size(); ++i) out.checks[i].red = false;
  }
  if (baseline != nullptr)
    for (Check& lost : lost_rows(now, *baseline)) out.checks.push_back(std::move(lost));
  if (!policy.advisory_times)
    if (std::optional<Check> open = too_many_open(policy, out)) out.checks.push_back(*open);
  return out;
}

}  // namespace contactcheck::gate
