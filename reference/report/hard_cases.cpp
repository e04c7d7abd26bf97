#include "reference/report/hard_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "reference/report/family_result.h"
#include "reference/report/format.h"
#include "reference/report/markdown_table.h"
#include "reference/report/stability_plot.h"

namespace contactcheck {
namespace {
using results::PerFrame;

struct DetectorSum {
  std::string level;
  std::size_t families = 0, right_families = 0, cases = 0, right = 0, failed = 0, refused = 0;
  std::uint64_t missed = 0, spurious = 0;
  double milliseconds = 0.0;  // of the families timed
  std::size_t timed = 0;
  double slowest = -1.0;
  std::string slowest_family;

  void add(const FamilyResult& result) {
    if (result.run.status == results::Status::kAbsent) return;
    ++families;
    failed += result.failed();
    refused += result.refused();
    if (!result.judged()) return;
    level = finest_level(result.run);
    cases += result.cases();
    right += result.cases() - result.wrong();
    right_families += result.wrong() == 0;
    missed += result.sum(&PerFrame::missed);
    spurious += result.sum(&PerFrame::spurious);
    if (const std::optional<double> time = result.milliseconds()) add_time(*time, result);
  }

  void add_time(double time, const FamilyResult& result) {
    milliseconds += time;
    ++timed;
    if (time <= slowest) return;
    slowest = time;
    slowest_family = result.scene.id;
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
    return {
        result.detector(), frame ? result.value(*frame) : "-", result.run.message, "-", "-", "-"};
  }
  std::size_t first = 0;
  while (!result.wrong_at(first)) ++first;
  return {result.detector(),
          result.value(first),
          fmt::format("{} missed, {} spurious of {} true", result.at(&PerFrame::missed, first),
                      result.at(&PerFrame::spurious, first), result.at(&PerFrame::truth, first)),
          fmt::format("{} of {}", result.wrong(), result.cases()),
          fmt::format("{}", result.sum(&PerFrame::missed)),
          fmt::format("{}", result.sum(&PerFrame::spurious))};
}

const std::vector<Column>& wrong_columns() {
  static const std::vector<Column> columns = {{"detector", true, ""}, {"first wrong at", true, ""},
                                              {"there", true, ""},    {"cases wrong", false, ""},
                                              {"missed", false, ""},  {"spurious", false, ""}};
  return columns;
}

// Of a family.
std::string family_table(const results::Scene& scene, const std::vector<FamilyResult>& all) {
  std::string rows, first;
  for (const FamilyResult& result : all) {
    if (&result.scene != &scene || !result.goes_wrong()) continue;
    rows += table_line(wrong_line(result));
    first = result.value(0);
  }
  if (rows.empty()) return "";
  const results::Family& family = *scene.family;
  return fmt::format("`{}`: {}. Parameter: {}, {} values from {} on. Hard for: {}. From: {}.\n\n",
                     scene.id, scene.title, family.parameter, family.values.size(), first,
                     family.stresses, family.origin) +
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

std::vector<std::vector<std::string>> hard_lines(const results::Results& results) {
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

std::string hard_cases_markdown(const results::Results& results) {
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
  for (const results::Scene& scene : results.scenes)
    if (scene.family) tables += family_table(scene, all);
  return out + (tables.empty() ? "Nowhere.\n\n" : tables);
}

}  // namespace contactcheck
