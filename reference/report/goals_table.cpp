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

const std::vector<Column>& goal_columns() {
  static const std::vector<Column> columns = {{"goal", true, ""},      {"scene", true, ""},
                                              {"detector", true, ""},  {"wanted", false, ""},
                                              {"measured", false, ""}, {"met", true, ""}};
  return columns;
}

std::vector<std::vector<std::string>> goal_lines(const results::Results& results) {
  std::vector<std::vector<std::string>> lines;
  for (const MeasuredGoal& goal : results.goals)
    lines.push_back(
        {goal.goal, goal.scene, goal.detector, wanted(goal), measured(goal), met_text(goal)});
  return lines;
}

}  // namespace contactcheck
