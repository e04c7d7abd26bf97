#include "reference/report/hard_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

// A detector's answers to one family.
struct FamilyResult {
  const Json& scene;
  const Json& run;

  bool judged() const { return run.at("status") == "ok" && !level().empty(); }
  bool failed() const { return run.at("status") == "error"; }
  bool refused() const { return run.at("status") == "refused"; }
  std::string level() const {
    return run.contains("per_frame") ? run.at("per_frame").value("level", "") : "";
  }
  std::size_t cases() const { return scene.at("family").at("values").size(); }
  std::string value(std::size_t frame) const {
    return scene.at("family").at("values").at(frame).get<std::string>();
  }
  std::int64_t at(const char* kind, std::size_t frame) const {
    return whole_number(run.at("per_frame").at(kind).at(frame));
  }
  std::string failed_at() const {
    if (!run.contains("failed_frame")) return "-";
    return value(static_cast<std::size_t>(whole_number(run.at("failed_frame"))));
  }
  bool wrong_at(std::size_t frame) const {
    return at("missed", frame) > 0 || at("spurious", frame) > 0;
  }
  std::int64_t sum(const char* kind) const {
    std::int64_t sum = 0;
    for (std::size_t f = 0; judged() && f < cases(); ++f) sum += at(kind, f);
    return sum;
  }
  std::size_t wrong() const {
    std::size_t wrong = 0;
    for (std::size_t f = 0; judged() && f < cases(); ++f) wrong += wrong_at(f);
    return wrong;
  }
};

std::vector<FamilyResult> family_results(const Json& results) {
  std::vector<FamilyResult> out;
  for (const Json& scene : results.at("scenes")) {
    if (!scene.contains("family")) continue;
    for (const Json& run : results.at("runs"))
      if (run.at("scene") == scene.at("id")) out.push_back({scene, run});
  }
  return out;
}

struct DetectorSum {
  std::string level;
  std::size_t families = 0, right_families = 0, cases = 0, right = 0, failed = 0, refused = 0;
  std::int64_t missed = 0, spurious = 0;
  double milliseconds = 0.0;  // cold, of the cases timed
  std::size_t timed = 0;

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
    const Json& time = result.run.at("time_ms");
    if (!time.contains("cold")) return;
    milliseconds += time.at("cold").at("frame").get<double>();
    ++timed;
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
            timed > 0 ? format_number(milliseconds / static_cast<double>(timed)) : "-"};
  }
};

// What is wrong at the first value, and how often in all.
std::vector<std::string> wrong_line(const FamilyResult& result) {
  const auto detector = result.run.at("detector").get<std::string>();
  if (result.failed())
    return {detector, result.failed_at(), result.run.at("message").get<std::string>(), "-", "-",
            "-"};
  std::size_t first = 0;
  while (!result.wrong_at(first)) ++first;
  return {detector,
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
    if (result.failed() || result.wrong() > 0) rows += table_line(wrong_line(result));
  }
  if (rows.empty()) return "";
  const Json& family = scene.at("family");
  const auto text = [&](const char* key) { return family.at(key).get<std::string>(); };
  return fmt::format("`{}`: {}. Parameter: {}, {} values from {} on. Hard for: {}. From: {}.\n\n",
                     scene.at("id").get<std::string>(), scene.at("title").get<std::string>(),
                     text("parameter"), family.at("values").size(),
                     family.at("values").at(0).get<std::string>(), text("stresses"),
                     text("origin")) +
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
                                              {"ms a case", false, ""}};
  return columns;
}

std::vector<std::vector<std::string>> hard_lines(const Json& results) {
  std::vector<std::string> order;
  std::map<std::string, DetectorSum> sums;
  for (const FamilyResult& result : family_results(results)) {
    const auto detector = result.run.at("detector").get<std::string>();
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
      "Milliseconds are means over families, mapping and update included, cold.\n\n" +
      table_head(hard_columns()) + rows + "\n### Where they go wrong\n\n";
  std::string tables;
  const std::vector<FamilyResult> all = family_results(results);
  for (const Json& scene : results.at("scenes"))
    if (scene.contains("family")) tables += family_table(scene, all);
  return out + (tables.empty() ? "Nowhere.\n\n" : tables);
}

}  // namespace contactcheck
