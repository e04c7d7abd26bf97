#include "reference/reproduce/paper_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reference/report/markdown_table.h"
#include "reference/scene/json_field.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

std::string source_line(const PaperSource& source) {
  return fmt::format("{}: *{}*, {}, {}, doi {}.\n\n", joined(source.authors), source.title,
                     source.journal, source.year, source.doi);
}

std::string sentences(const std::string& heading, const std::vector<PaperFinding>& findings,
                      bool agreeing) {
  std::string list;
  for (const PaperFinding& finding : findings)
    if (finding.agrees == agreeing) list += "- " + finding.sentence + "\n";
  return list.empty() ? "" : "### " + heading + "\n\n" + list + "\n";
}

// Averages of devices for which no table has rows of the proposal.
std::string not_checkable(const PaperTables& tables) {
  std::string list;
  for (const PaperDevice& device : tables.devices)
    if (device.name != tables.table_3.device)
      list +=
          (list.empty() ? "" : ", ") + device.name + " (" + device.average_frame_rate.says + ")";
  if (list.empty()) return "";
  return fmt::format("No table has times of {} on {}, so these averages cannot be checked.\n\n",
                     tables.table_3.after, list);
}

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

std::string verdict(const PaperFinding& finding) {
  if (!finding.agrees) return "-";
  return *finding.agrees ? "agrees" : "does not agree";
}

// A figure with its unit; ratios and counts have none.
std::string with_unit(double value, const std::string& unit) {
  const std::string figure = paper_figure(value, unit);
  return unit == "ratio" || unit == "count" ? figure : figure + " " + unit;
}

std::string figure_rows(const std::vector<PaperFinding>& findings) {
  std::string rows;
  for (const PaperFinding& f : findings) {
    rows += table_line({f.topic, f.table, or_dash(f.scene), or_dash(f.method),
                        with_unit(f.computed, f.unit),
                        // As the paper has it: a claim may carry more digits than our figures.
                        f.claimed ? fmt::format("{:.5g}", *f.claimed) : "-", verdict(f)});
  }
  return rows;
}

const std::vector<Column>& figure_columns() {
  static const std::vector<Column> columns = {{"check", true, "what is computed"},
                                              {"table", true, "from which table"},
                                              {"scene", true, "- over all scenes"},
                                              {"method", true, "- over both methods"},
                                              {"computed", false, "by arithmetic"},
                                              {"claimed", false, "in the same unit"},
                                              {"verdict", true, "- where nothing is claimed"}};
  return columns;
}

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json finding_json(const PaperFinding& finding) {
  return {{"topic", finding.topic},
          {"table", text_or_null(finding.table)},
          {"scene", text_or_null(finding.scene)},
          {"method", text_or_null(finding.method)},
          {"sentence", finding.sentence},
          {"claimed", finding.claimed ? Json(*finding.claimed) : Json()},
          {"computed", finding.computed},
          {"unit", finding.unit},
          {"agrees", finding.agrees ? Json(*finding.agrees) : Json()}};
}

}  // namespace

std::string paper_markdown(const PaperTables& tables, const std::vector<PaperFinding>& findings) {
  return "## What the paper's own numbers say\n\n" + source_line(tables.source) +
         "Computed from the printed tables alone; nothing here was measured.\n\n" +
         sentences("What does not add up", findings, false) +
         sentences("What agrees", findings, true) + not_checkable(tables) +
         titled_table("### Every figure", figure_columns(), figure_rows(findings));
}

Json paper_json(const PaperTables& tables, const std::vector<PaperFinding>& findings) {
  const PaperSource& source = tables.source;
  Json out = {{"source",
               {{"authors", source.authors},
                {"title", source.title},
                {"journal", source.journal},
                {"year", source.year},
                {"doi", source.doi}}},
              {"findings", Json::array()}};
  for (const PaperFinding& finding : findings) out["findings"].push_back(finding_json(finding));
  return out;
}

}  // namespace contactcheck
