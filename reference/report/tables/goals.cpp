#include <set>

#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/section.h"

namespace contactcheck::report {
namespace {
using results::MeasuredGoal;

std::string unit_of(const MeasuredGoal& goal) { return goal.per.empty() ? "x" : " us"; }

std::string wanted(const MeasuredGoal& goal) {
  return (goal.at_least ? ">= " + format_number(goal.at_least)
                        : "<= " + format_number(goal.at_most)) +
         unit_of(goal);
}

// The passes behind the goal's value; 0 if unknown: then its ends are no more than a range.
std::size_t passes_of(const MeasuredGoal& goal, const results::Index& index) {
  const results::Run* run = index.ok_run(goal.scene, goal.detector);
  if (run == nullptr || run->times.empty()) return 0;
  const results::Run* reference = index.ok_run(goal.scene, goal.over);
  const results::Speedup* speedup =
      reference == nullptr ? nullptr
                           : speedup_of(*run, *results::goal_question(*run, *reference), goal.over);
  return speedup == nullptr ? run->times.front().passes : speedup->passes;
}

std::string measured(const MeasuredGoal& goal, std::size_t passes) {
  if (!goal.measured) return "-";
  if (!goal.low || !goal.high) return format_number(goal.measured) + unit_of(goal);
  return format_ratio(results::Ratio{*goal.measured, *goal.low, *goal.high}, passes);
}

std::string met_text(const MeasuredGoal& goal) {
  if (!goal.met) return "not measured: " + goal.why;
  return *goal.met ? "yes" : "no";
}

TitledTable goals_table(const results::Index& index) {
  TitledTable out{
      "",
      "Times are of playback unless the goal is of cold caches; a ratio over a detector is its "
      "time over that of the detector named.",
      {{"goal", true, ""},
       {"scene", true, ""},
       {"detector", true, ""},
       {"wanted", false, ""},
       {"measured", false, ""},
       {.title = "passes", .left = false, .spare = 8},
       {.title = "met", .left = true, .role = Role::kVerdict}},
      {}};
  std::set<std::size_t> with_ends;
  for (const MeasuredGoal& goal : index.results().goals) {
    const std::size_t passes = passes_of(goal, index);
    if (goal.low && passes > 0) with_ends.insert(passes);
    out.rows.push_back({goal.goal, goal.scene, goal.detector, wanted(goal), measured(goal, passes),
                        goal.measured && passes > 0 ? std::to_string(passes) : "-",
                        met_text(goal)});
  }
  const std::string ends = ends_sentence(with_ends);
  if (!ends.empty()) out.text += " " + ends;
  return out;
}

Blocks goals_blocks(const results::Index& index) { return {goals_table(index)}; }

std::vector<TerminalPart> goals_in_terminal(const results::Index& index) {
  return {{"goals", "", "", goals_table(index)}};
}

}  // namespace

/// What a suite hoped to measure: a row per goal.
extern const Section kGoals = {"goals", "Goals of the suite", "Goals", goals_blocks,
                               goals_in_terminal};

}  // namespace contactcheck::report
