#include "reference/report/summary.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "reference/report/format.h"
#include "reference/results/references.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

struct Range {
  std::optional<double> low, high;
  void add(double value) {
    low = std::min(low.value_or(value), value);
    high = std::max(high.value_or(value), value);
  }
  std::string text() const {
    if (!low) return "-";
    const std::string from = format_number(*low), to = format_number(*high);
    return (from == to ? from : from + " to " + to) + "x";
  }
};

struct Sums {
  std::string detector, level, question;
  std::size_t scenes = 0, not_ok = 0;
  long long truth = 0, hit = 0, missed = 0, spurious = 0, body_missed = 0, body_spurious = 0;
  bool has_level = false, has_body = false;
  std::optional<double> hover;
  std::array<Range, kReferences.size()> speedups;
};

void add_speed(const Json& run, const char* reference, Range& range) {
  const Json s = speedup_of(run, compared_question(run), reference);
  if (!s.is_null()) range.add(s.at("cold").at("ratio").get<double>());
}

void add_levels(const Json& run, Sums& sums) {
  const Json& levels = run.at("levels");
  if (levels.contains(sums.level)) {
    sums.has_level = true;
    const Json& c = levels.at(sums.level);
    sums.truth += whole_number(c.at("truth"));
    sums.hit += whole_number(c.at("hit"));
    sums.missed += whole_number(c.at("missed"));
    sums.spurious += whole_number(c.at("spurious"));
  }
  if (levels.contains("body")) {
    sums.has_body = true;
    sums.body_missed += whole_number(levels.at("body").at("missed"));
    sums.body_spurious += whole_number(levels.at("body").at("spurious"));
  }
}

void add_run(const Json& run, Sums& sums) {
  if (run.at("status") != "ok") {
    ++sums.not_ok;
    return;
  }
  ++sums.scenes;
  sums.question = compared_question(run);
  add_levels(run, sums);
  const Json& hover = run.at("geometry").at("hover_gap_max");
  if (!hover.is_null()) sums.hover = std::max(sums.hover.value_or(0.0), hover.get<double>());
  for (std::size_t i = 0; i < kReferences.size(); ++i)
    add_speed(run, kReferences[i], sums.speedups[i]);
}

std::vector<std::string> cells_of(const Sums& s) {
  const Json recall = s.truth == 0
                          ? Json(nullptr)
                          : Json(static_cast<double>(s.hit) / static_cast<double>(s.truth));
  // Nothing judged is no perfect score.
  const auto judged = [&](long long n) { return s.has_level ? std::to_string(n) : "-"; };
  const std::string scenes =
      std::to_string(s.scenes) + (s.not_ok ? " (" + std::to_string(s.not_ok) + " not ok)" : "");
  std::vector<std::string> cells = {
      s.detector,
      scenes,
      s.level,
      judged(s.truth),
      format_rate(recall),
      judged(s.missed),
      judged(s.spurious),
      s.has_body ? std::to_string(s.body_missed) + "/" + std::to_string(s.body_spurious) : "-",
      s.hover ? format_millimetres(*s.hover) : "-",
      s.question};
  for (const Range& range : s.speedups) cells.push_back(range.text());
  return cells;
}

// Counts of different levels do not add up: a detector has a line per level. A run that is not `ok`
// has no level and counts in the detector's first line.
Sums& line_of(const Json& run, std::vector<Sums>& all) {
  const auto name = run.at("detector").get<std::string>();
  const bool ok = run.at("status") == "ok";
  const std::string level = ok ? finest_level(run) : "";
  for (Sums& s : all) {
    if (s.detector != name || (ok && s.scenes > 0 && s.level != level)) continue;
    if (ok) s.level = level;
    return s;
  }
  Sums& added = all.emplace_back();
  added.detector = name;
  added.level = level;
  return added;
}

}  // namespace

const std::vector<Column>& summary_columns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> all = {{"detector", true, ""},  {"scenes", false, ""},
                               {"level", true, ""},     {"truth", false, ""},
                               {"recall", false, ""},   {"missed", false, ""},
                               {"spurious", false, ""}, {"body m/s", false, ""},
                               {"hover mm", false, ""}, {"question", true, ""}};
    for (const char* reference : kReferences)
      all.push_back({std::string("vs ") + reference, false, ""});
    return all;
  }();
  return columns;
}

std::vector<std::vector<std::string>> summary_lines(const Json& results) {
  std::vector<Sums> all;
  for (const Json& run : results.at("runs")) add_run(run, line_of(run, all));
  std::vector<std::vector<std::string>> lines;
  for (const Sums& s : all) lines.push_back(cells_of(s));
  return lines;
}

}  // namespace contactcheck
