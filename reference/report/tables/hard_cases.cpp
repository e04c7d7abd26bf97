#include "reference/report/tables/hard_cases.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>

#include "reference/report/tables/family_result.h"
#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scale_ranges.h"
#include "reference/report/tables/section.h"

namespace contactcheck::report {
namespace {
using results::PerFrame;

struct DetectorSum {
  std::string level;
  std::size_t families = 0, right_families = 0, cases = 0, right = 0, failed = 0, refused = 0;
  std::uint64_t missed = 0, spurious = 0;
  double milliseconds = 0.0;  // of the families timed
  std::size_t timed = 0;
  TimedPart part;
  double slowest = -1.0;
  std::string slowest_family;

  void add(const FamilyResult& result) {
    failed += result.failed();
    refused += result.refused();
    // Without an answer no case is right: leaving them out would praise who refuses them.
    if (result.run.status == results::Status::kAbsent) return;
    ++families;
    cases += result.cases();
    if (!result.judged()) return;
    level = finest_level(result.run);
    right += result.cases() - result.wrong();
    right_families += result.wrong() == 0;
    missed += result.sum(&PerFrame::missed);
    spurious += result.sum(&PerFrame::spurious);
    if (const std::optional<double> time = result.milliseconds()) add_time(*time, result);
  }

  void add_time(double time, const FamilyResult& result) {
    milliseconds += time;
    ++timed;
    part.add(result.run, result.run.times.front());
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
            timed > 0 ? format_number(milliseconds / static_cast<double>(timed)) + part.cut_text()
                      : "-",
            format_counts(part.passes),
            timed > 0 ? format_number(slowest) + " " + slowest_family : "-"};
  }
};

// The level at which a family about one body is judged; else empty.
std::string self_level_of(const results::Scene& scene) {
  for (const auto& [level, truth] : scene.truth)
    if (is_self(level)) return name_of(level);
  return "";
}

std::size_t first_wrong(const FamilyResult& result) {
  std::size_t first = 0;
  while (!result.wrong_at(first)) ++first;
  return first;
}

// What is wrong at the first value, and how often in all.
std::vector<std::string> wrong_line(const FamilyResult& result) {
  if (result.failed()) {
    const std::optional<std::size_t> frame = result.failed_frame();
    return {
        result.detector(), frame ? result.value(*frame) : "-", result.run.message, "-", "-", "-"};
  }
  const std::size_t first = first_wrong(result);
  return {result.detector(),
          result.value(first),
          result.errors_text(first),
          fmt::format("{} of {}", result.wrong(), result.cases()),
          fmt::format("{}", result.sum(&PerFrame::missed)),
          fmt::format("{}", result.sum(&PerFrame::spurious))};
}

std::optional<ShownCase> shown_case(const FamilyResult& result) {
  if (result.failed()) {
    const std::optional<std::size_t> frame = result.failed_frame();
    return frame ? std::optional(ShownCase{result.detector(), *frame, ""}) : std::nullopt;
  }
  const std::size_t first = first_wrong(result);
  return ShownCase{result.detector(), first,
                   result.at(&PerFrame::missed, first) > 0 ? "missed" : "spurious"};
}

const std::vector<Column>& wrong_columns() {
  static const std::vector<Column> columns = {{"detector", true, ""}, {"first wrong at", true, ""},
                                              {"there", true, ""},    {"cases wrong", false, ""},
                                              {"missed", false, ""},  {"spurious", false, ""}};
  return columns;
}

HeatCell matrix_cell(const FamilyResult& result) {
  if (!result.run.ok()) return {name_of(result.run.status), {}, result.run.message, "error"};
  const std::string where = result.detector() + " in " + result.scene.id;
  if (!result.judged()) return {"-", {}, where + ": not judged", "aside"};
  const std::size_t wrong = result.wrong();
  return {wrong == 0 ? "·" : std::to_string(wrong),
          static_cast<double>(wrong) / static_cast<double>(result.cases()),
          fmt::format("{}: {} of {} cases wrong", where, wrong, result.cases())};
}

}  // namespace

TitledTable hard_sums(const results::Index& index) {
  TitledTable out{
      "",
      "Every case is judged exactly, at the finest level that a detector claims. Milliseconds are "
      "means over families in playback, mapping and update included, without the first case; "
      "the last column names the family that costs most.",
      {{"detector", true, ""},
       {"level", true, ""},
       {"families right", false, "families without a wrong case, of those run"},
       {"cases right", false,
        "cases answered as claimed; with an error or refused: none of its family"},
       {.title = "missed", .left = false, .role = Role::kErrors},
       {.title = "spurious", .left = false, .role = Role::kErrors},
       {"families with error", false, "families that ended in status error"},
       {"families refused", false, "families refused as input that it must not answer"},
       {"ms a case", false, "map + update + query in playback, mean over the families timed"},
       {.title = "passes", .left = false, .spare = 8},
       {.title = "slowest family",
        .left = true,
        .meaning = "ms a case of the family that costs most, and its name",
        .spare = 9}},
      {}};
  // Classes of contacts of a body with itself are not added up, nor with those of two bodies.
  std::map<std::string, std::map<std::string, DetectorSum>> sums;
  std::vector<std::pair<std::string, std::string>> order;
  for (const FamilyResult& result : family_results(index)) {
    // A family about levels that a detector does not claim is not about it.
    if (result.run.ok() && !result.judged()) continue;
    const std::string kind = self_level_of(result.scene), detector = result.detector();
    if (sums[kind].count(detector) == 0) order.emplace_back(kind, detector);
    sums[kind][detector].add(result);
  }
  for (const auto& [kind, detector] : order)
    out.rows.push_back(sums[kind][detector].line(detector));
  return out;
}

HeatTable hard_matrix(const results::Index& index) {
  std::set<std::string> wrong_detectors;
  std::set<const results::Scene*> wrong_scenes;
  for (const FamilyResult& result : family_results(index)) {
    if (!result.goes_wrong()) continue;
    wrong_detectors.insert(result.detector());
    wrong_scenes.insert(&result.scene);
  }
  HeatTable out{{"family", "cases"}, {}};
  for (const std::string& detector : index.detectors())
    if (wrong_detectors.contains(detector)) out.columns.push_back(detector);
  for (const results::Scene& scene : index.results().scenes) {
    if (!wrong_scenes.contains(&scene)) continue;
    std::vector<HeatCell>& row = out.rows.emplace_back();
    row = {{scene.id, {}, ""}, {std::to_string(scene.family->values.size()), {}, ""}};
    for (std::size_t c = row.size(); c < out.columns.size(); ++c) {
      const results::Run* run = index.run(scene.id, out.columns[c]);
      row.push_back(run == nullptr ? HeatCell{} : matrix_cell({scene, *run}));
    }
  }
  return out;
}

std::vector<WrongFamily> wrong_families(const results::Index& index) {
  std::vector<WrongFamily> out;
  for (const FamilyResult& result : family_results(index)) {
    if (!result.goes_wrong()) continue;
    const results::Family& family = *result.scene.family;
    if (out.empty() || &out.back().scene != &result.scene)
      out.push_back({result.scene,
                     "",
                     fmt::format("Parameter: {}, {} values from {} on. Hard for: {}. From: {}.",
                                 family.parameter, family.values.size(), result.value(0),
                                 family.stresses, family.origin),
                     {"", "", wrong_columns(), {}},
                     {}});
    WrongFamily& own = out.back();
    own.table.rows.push_back(wrong_line(result));
    own.shown.push_back(shown_case(result));
    const std::size_t n = own.table.rows.size();
    own.aside = plural(n, "detector") + (n == 1 ? " goes wrong" : " go wrong");
  }
  return out;
}

namespace {

Blocks hard_blocks(const results::Index& index) {
  TitledTable sums = hard_sums(index);
  if (sums.rows.empty()) return {};
  Blocks out = {std::move(sums)};
  for (TitledTable& table : range_tables(scale_ranges(index))) out.emplace_back(std::move(table));
  out.emplace_back(Heading{"Where they go wrong"});
  std::vector<WrongFamily> families = wrong_families(index);
  if (families.empty()) out.emplace_back(Paragraph{"Nowhere."});
  for (WrongFamily& family : families) {
    out.emplace_back(Paragraph{
        fmt::format("`{}`: {}. {}", family.scene.id, family.scene.title, family.sentence)});
    out.emplace_back(
        Picture{stability_plot_file(family.scene), "Missed and spurious, case by case"});
    out.emplace_back(std::move(family.table));
  }
  return out;
}

std::vector<TerminalPart> hard_in_terminal(const results::Index& index) {
  std::vector<TerminalPart> out = {
      {"hard cases", "errors by family: report.md, \"Where they go wrong\"", "", hard_sums(index)}};
  for (TitledTable& table : range_tables(scale_ranges(index))) {
    const std::string title = table.title, lines = "  " + table.text + "\n";
    out.push_back({title, "", lines, std::move(table)});
  }
  return out;
}

}  // namespace

extern const Section kHardCases = {"hard",      "Hard cases",     "Hard cases",
                                   hard_blocks, hard_in_terminal, true};

}  // namespace contactcheck::report
