#include "reference/report/goals_table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reference/report/format.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

std::string unit_of(const Json& goal) { return goal.contains("per") ? " us" : "x"; }

std::string wanted(const Json& goal) {
  const bool least = goal.contains("at_least");
  return (least ? ">= " : "<= ") + format_number(goal.at(least ? "at_least" : "at_most")) +
         unit_of(goal);
}

std::string measured(const Json& goal) {
  if (goal.at("measured").is_null()) return "-";
  std::string out = format_number(goal.at("measured")) + unit_of(goal);
  if (goal.contains("low"))
    out += " [" + format_number(goal.at("low")) + ", " + format_number(goal.at("high")) + "]";
  return out;
}

std::string verdict(const Json& goal) {
  if (goal.at("met").is_null()) return "not measured: " + goal.at("why").get<std::string>();
  return goal.at("met").get<bool>() ? "yes" : "no";
}

}  // namespace

const std::vector<Column>& goal_columns() {
  static const std::vector<Column> columns = {{"goal", true, ""},      {"scene", true, ""},
                                              {"detector", true, ""},  {"wanted", false, ""},
                                              {"measured", false, ""}, {"met", true, ""}};
  return columns;
}

std::vector<std::vector<std::string>> goal_lines(const Json& results) {
  std::vector<std::vector<std::string>> lines;
  for (const Json& goal : results.value("goals", Json::array()))
    lines.push_back({goal.at("goal").get<std::string>(), goal.at("scene").get<std::string>(),
                     goal.at("detector").get<std::string>(), wanted(goal), measured(goal),
                     verdict(goal)});
  return lines;
}

}  // namespace contactcheck
