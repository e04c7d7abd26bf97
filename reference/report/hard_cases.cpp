#include "reference/report/hard_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "reference/report/family_result.h"
#include "reference/report/format.h"
#include "reference/report/markdown_table.h"
#include "reference/report/stability_plot.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

struct DetectorSum {
  std::string level;
  std::size_t families = 0, right_families = 0, cases = 0, right = 0, failed = 0, refused = 0;
  std::int64_t missed = 0, spurious = 0;
  double milliseconds = 0.0;  // of the families timed
  std::size_t timed = 0;
  double slowest = -1.0;
  std::string slowest_family;

  void add(const FamilyResult& result) {
    if (result.run.at("status") == "absent") return;
    ++families;
    failed += result.failed();
    refused += result.refused();
    if (!result.judged()) return;
    level = result.level();
    cases += result.cases();
    right += result.cases() - result.wrong();
    right_families += result.wrong() == 0;
    missed += result.sum("missed");
    spurious += result.sum("spurious");
    if (const std::optional<double> time = result.milliseconds()) add_time(*time, result);
  }

  void add_time(double time, const FamilyResult& result) {
    milliseconds += time;
    ++timed;
    if (time <= slowest) return;
    slowest = time;
    slowest_family = result.scene.at("id").get<std::string>();
  }

  std::vector<std::string> line(const std::string& detector) const {
    return {detector,
            level.empty() ? "-" : level,
            fmt::format("{} of {}", right_families, families),
            fmt::format("{} of {}", right, cases),
            fmt::format("{}", missed),
            fmt::format("{}", spurious),
            fmt::format("{}", failed),
            fmt::format("{}", refused),
            timed > 0 ? format_number(milliseconds / static_cast<double>(timed)) : "-",
            timed > 0 ? format_number(slowest) + " " + slowest_family : "-"};
  }
};

// What is wrong at the first value, and how often in all.
std::vector<std::string> wrong_line(const FamilyResult& result) {
  if (result.failed()) {
    const std::optional<std::size_t> frame = result.failed_frame();
    return {result.detector(),
            frame ? result.value(*frame) : "-",
            result.run.at("message").get<std::string>(),
            "-",
            "-",
            "-"};
  }
  std::size_t first = 0;
  while (!result.wrong_at(first)) ++first;
  return {result.detector(),
          result.value(first),
          fmt::format("{} missed, {} spurious of {} true", result.at("missed", first),
                      result.at("spurious", first), result.at("truth", first)),
          fmt::format("{} of {}", result.wrong(), result.cases()),
          fmt::format("{}", result.sum("missed")),
          fmt::format("{}", result.sum("spurious"))};
}

const std::vector<Column>& wrong_columns() {
  static const std::vector<Column> columns = {{"detector", true, ""}, {"first wrong at", true, ""},
                                              {"there", true, ""},    {"cases wrong", false, ""},
                                              {"missed", false, ""},  {"spurious", false, ""}};
  return columns;
}

std::string family_table(const Json& scene, const std::vector<FamilyResult>& all) {
  std::string rows;
  for (const FamilyResult& result : all) {
    if (&result.scene != &scene) continue;
    if (result.goes_wrong()) rows += table_line(wrong_line(result));
  }
  if (rows.empty()) return "";
  const Json& family = scene.at("family");
  const auto text = [&](const char* key) { return family.at(key).get<std::string>(); };
  return fmt::format("`{}`: {}. Parameter: {}, {} values from {} on. Hard for: {}. From: {}.\n\n",
                     scene.at("id").get<std::string>(), scene.at("title").get<std::string>(),
                     text("parameter"), family.at("values").size(),
                     family.at("values").at(0).get<std::string>(), text("stresses"),
                     text("origin")) +
         fmt::format("![Missed and spurious, case by case]({})\n\n", stability_plot_file(scene)) +
         table_head(wrong_columns()) + rows + "\n";
}

}  // namespace

const std::vector<Column>& hard_columns() {
  static const std::vector<Column> columns = {{"detector", true, ""},
                                              {"level", true, ""},
                                              {"families right", false, ""},
                                              {"cases right", false, ""},
                                              {"missed", false, ""},
                                              {"spurious", false, ""},
                                              {"families with error", false, ""},
                                              {"refused", false, ""},
                                              {"ms a case", false, ""},
                                              {"slowest family", true, ""}};
  return columns;
}

std::vector<std::vector<std::string>> hard_lines(const Json& results) {
  std::vector<std::string> order;
  std::map<std::string, DetectorSum> sums;
  for (const FamilyResult& result : family_results(results)) {
    const std::string detector = result.detector();
    if (sums.count(detector) == 0) order.push_back(detector);
    sums[detector].add(result);
  }
  std::vector<std::vector<std::string>> lines;
  for (const std::string& detector : order) lines.push_back(sums[detector].line(detector));
  return lines;
}

std::string hard_cases_markdown(const Json& results) {
  std::string rows;
  for (const auto& cells : hard_lines(results)) rows += table_line(cells);
  if (rows.empty()) return "";
  std::string out =
      "## Hard cases\n\nEvery case is judged exactly, at the finest level that a detector claims. "
      "Milliseconds are means over families, mapping and update included, cold; beside them the "
      "family that costs most.\n\n" +
      table_head(hard_columns()) + rows + "\n### Where they go wrong\n\n";
  std::string tables;
  const std::vector<FamilyResult> all = family_results(results);
  for (const Json& scene : results.at("scenes"))
    if (scene.contains("family")) tables += family_table(scene, all);
  return out + (tables.empty() ? "Nowhere.\n\n" : tables);
}

}  // namespace contactcheck
