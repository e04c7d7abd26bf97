#include "reference/report/summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "reference/report/format.h"

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
    return low ? format_number(*low) + " to " + format_number(*high) + "x" : "-";
  }
};

struct Sums {
  std::string detector, level, question;
  std::size_t scenes = 0, not_ok = 0;
  long long truth = 0, hit = 0, missed = 0, spurious = 0, body_missed = 0, body_spurious = 0;
  bool has_body = false;
  std::optional<double> hover;
  Range aabb, obbrss;
};

void add_speed(const Json& run, const char* reference, Range& range) {
  const Json s = speedup_of(run, compared_question(run), reference);
  if (!s.is_null()) range.add(s.at("cold").at("ratio").get<double>());
}

void add_levels(const Json& run, Sums& sums) {
  sums.level = run.at("per_frame").at("level").get<std::string>();
  const Json& levels = run.at("levels");
  if (levels.contains(sums.level)) {
    const Json& c = levels.at(sums.level);
    sums.truth += c.at("truth").get<long long>();
    sums.hit += c.at("hit").get<long long>();
    sums.missed += c.at("missed").get<long long>();
    sums.spurious += c.at("spurious").get<long long>();
  }
  if (levels.contains("body")) {
    sums.has_body = true;
    sums.body_missed += levels.at("body").at("missed").get<long long>();
    sums.body_spurious += levels.at("body").at("spurious").get<long long>();
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
  add_speed(run, "fcl-aabb", sums.aabb);
  add_speed(run, "fcl-obbrss", sums.obbrss);
}

std::vector<std::string> cells_of(const Sums& s) {
  const Json recall = s.truth == 0
                          ? Json(nullptr)
                          : Json(static_cast<double>(s.hit) / static_cast<double>(s.truth));
  const std::string scenes =
      std::to_string(s.scenes) + (s.not_ok ? " (" + std::to_string(s.not_ok) + " not ok)" : "");
  return {s.detector,
          scenes,
          s.level,
          std::to_string(s.truth),
          format_rate(recall),
          std::to_string(s.missed),
          std::to_string(s.spurious),
          s.has_body ? std::to_string(s.body_missed) + "/" + std::to_string(s.body_spurious) : "-",
          s.hover ? format_millimetres(*s.hover) : "-",
          s.question,
          s.aabb.text(),
          s.obbrss.text()};
}

}  // namespace

const std::vector<Column>& summary_columns() {
  static const std::vector<Column> columns = {
      {"detector", true, ""},  {"scenes", false, ""},      {"level", true, ""},
      {"truth", false, ""},    {"recall", false, ""},      {"missed", false, ""},
      {"spurious", false, ""}, {"body m/s", false, ""},    {"hover mm", false, ""},
      {"question", true, ""},  {"vs fcl-aabb", false, ""}, {"vs fcl-obbrss", false, ""}};
  return columns;
}

std::vector<std::vector<std::string>> summary_lines(const Json& results) {
  std::vector<Sums> all;
  for (const Json& run : results.at("runs")) {
    const auto name = run.at("detector").get<std::string>();
    auto it =
        std::find_if(all.begin(), all.end(), [&](const Sums& s) { return s.detector == name; });
    if (it == all.end()) {
      it = all.insert(it, Sums{});
      it->detector = name;
    }
    add_run(run, *it);
  }
  std::vector<std::vector<std::string>> lines;
  for (const Sums& s : all) lines.push_back(cells_of(s));
  return lines;
}

}  // namespace contactcheck
