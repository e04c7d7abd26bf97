#include "reference/reproduce/paper_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "reference/report/formats/markdown.h"
#include "reference/report/tables/format.h"
#include "reference/text/json_field.h"
#include "reference/text/lists.h"

namespace contactcheck::reproduce {
namespace {
using Json = nlohmann::ordered_json;

// With the title as `title` has it: every kind of report marks it in its own way.
std::string source_words(const PaperSource& source, const std::string& title) {
  return fmt::format("{}: {}, {}, {}, doi {}.", text::joined(source.authors), title, source.journal,
                     source.year, source.doi);
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

report::TitledTable figures_table(const std::vector<PaperFinding>& findings) {
  report::TitledTable table = {"Every figure",
                               "",
                               {{"check", true, "what is computed"},
                                {"table", true, "from which table"},
                                {"scene", true, "- over all scenes"},
                                {"method", true, "- over both methods"},
                                {"computed", false, "by arithmetic"},
                                {"claimed", false, "in the same unit"},
                                {"verdict", true, "- where nothing is claimed"}},
                               {}};
  const auto or_dash = [](const std::string& text) { return text.empty() ? "-" : text; };
  for (const PaperFinding& f : findings) {
    std::string computed = paper_figure(f.computed, f.unit);
    if (f.unit != "ratio" && f.unit != "count") computed += " " + f.unit;
    table.rows.push_back({f.topic, f.table, or_dash(f.scene), or_dash(f.method), computed,
                          // As the paper has it: a claim may carry more digits than our figures.
                          f.claimed ? fmt::format("{:.5g}", *f.claimed) : "-",
                          !f.agrees   ? "-"
                          : *f.agrees ? "agrees"
                                      : "does not agree"});
  }
  return table;
}

std::string text_of(const Json& value) { return value.is_null() ? "" : value.get<std::string>(); }

template <typename T>
std::optional<T> optional_of(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<T>());
}

// Back from paper_json.
std::vector<PaperFinding> findings_of(const Json& paper) {
  std::vector<PaperFinding> out;
  for (const Json& f : paper.at("findings"))
    out.push_back({.topic = f.at("topic"),
                   .table = text_of(f.at("table")),
                   .scene = text_of(f.at("scene")),
                   .method = text_of(f.at("method")),
                   .sentence = f.at("sentence"),
                   .claimed = optional_of<double>(f.at("claimed")),
                   .computed = f.at("computed").get<double>(),
                   .unit = f.at("unit"),
                   .agrees = optional_of<bool>(f.at("agrees"))});
  return out;
}

}  // namespace

std::string paper_markdown(const PaperTables& tables, const std::vector<PaperFinding>& findings) {
  return "## What the paper's own numbers say\n\n" +
         source_words(tables.source, "*" + tables.source.title + "*") +
         "\n\nComputed from the printed tables alone; nothing here was measured.\n\n" +
         sentences("What does not add up", findings, false) +
         sentences("What agrees", findings, true) + not_checkable(tables) +
         report::markdown_of(figures_table(findings));
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
  const auto text_or_null = [](const std::string& text) {
    return text.empty() ? Json() : Json(text);
  };
  for (const PaperFinding& finding : findings)
    out["findings"].push_back({{"topic", finding.topic},
                               {"table", text_or_null(finding.table)},
                               {"scene", text_or_null(finding.scene)},
                               {"method", text_or_null(finding.method)},
                               {"sentence", finding.sentence},
                               {"claimed", finding.claimed ? Json(*finding.claimed) : Json()},
                               {"computed", finding.computed},
                               {"unit", finding.unit},
                               {"agrees", finding.agrees ? Json(*finding.agrees) : Json()}});
  return out;
}

std::string own_numbers(const Json& paper) {
  const Json& source = paper.at("source");
  const std::vector<PaperFinding> findings = findings_of(paper);
  const auto contradictions = std::count_if(findings.begin(), findings.end(),
                                            [](const auto& f) { return f.agrees == false; });
  return fmt::format("{} {} by arithmetic alone; {} contradict a claim or cannot be.",
                     source_words({.authors = source.at("authors"),
                                   .title = source.at("title"),
                                   .journal = source.at("journal"),
                                   .doi = source.at("doi"),
                                   .year = source.at("year")},
                                  source.at("title")),
                     report::plural(findings.size(), "check"), contradictions);
}

report::TitledTable checks_table(const Json& paper) {
  const std::vector<PaperFinding> findings = findings_of(paper);
  report::TitledTable table = figures_table(findings);
  table.title = "Checks of the paper's own numbers";
  table.columns.push_back({"in words", true, ""});
  for (std::size_t i = 0; i < findings.size(); ++i) table.rows[i].push_back(findings[i].sentence);
  return table;
}

}  // namespace contactcheck::reproduce
