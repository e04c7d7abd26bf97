#include "reference/report/goals_table.h"

#include "reference/report/format.h"

namespace contactcheck {
namespace {
using results::MeasuredGoal;

std::string unit_of(const MeasuredGoal& goal) { return goal.per.empty() ? "x" : " us"; }

std::string wanted(const MeasuredGoal& goal) {
  return (goal.at_least ? ">= " + format_number(goal.at_least)
                        : "<= " + format_number(goal.at_most)) +
         unit_of(goal);
}

std::string measured(const MeasuredGoal& goal) {
  if (!goal.measured) return "-";
  std::string out = format_number(goal.measured) + unit_of(goal);
  if (goal.low) out += " [" + format_number(goal.low) + ", " + format_number(goal.high) + "]";
  return out;
}

std::string met_text(const MeasuredGoal& goal) {
  if (!goal.met) return "not measured: " + goal.why;
  return *goal.met ? "yes" : "no";
}

}  // namespace

TitledTable goals_table(const results::Results& results) {
  TitledTable out{
      "Goals of the suite",
      "Times are medians; a ratio over a detector is its time over that of the detector "
      "named, with a 95 % interval.",
      {{"goal", true, ""},
       {"scene", true, ""},
       {"detector", true, ""},
       {"wanted", false, ""},
       {"measured", false, ""},
       {"met", true, ""}},
      {}};
  for (const MeasuredGoal& goal : results.goals)
    out.rows.push_back(
        {goal.goal, goal.scene, goal.detector, wanted(goal), measured(goal), met_text(goal)});
  return out;
}

}  // namespace contactcheck
