#include "reference/report/formats/markdown.h"

#include <fmt/format.h>

#include <set>
#include <utility>
#include <variant>

#include "reference/report/pictures/report_pictures.h"
#include "reference/report/tables/origin.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scene_choice.h"
#include "reference/report/tables/scene_tables.h"
#include "reference/report/tables/section.h"

namespace contactcheck::report {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string line_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + escaped(cell) + " |";
  return line + "\n";
}

}  // namespace

std::string markdown_of(TitledTable table) {
  if (table.rows.empty()) return "";
  leave_out_untimed(table);
  std::vector<std::string> titles;
  std::string rule = "|";
  for (const Column& c : table.columns) {
    titles.emplace_back(c.title);
    rule += c.left ? "---|" : "--:|";
  }
  std::string out = table.title.empty() ? "" : "### " + table.title + "\n\n";
  if (!table.text.empty()) out += table.text + "\n\n";
  out += line_of(titles) + rule + "\n";
  for (const std::vector<std::string>& row : table.rows) out += line_of(row);
  return out + "\n";
}

namespace {

std::string origin_section(const results::Results& results) {
  std::string out;
  for (const std::string& line : machine_lines(results)) out += "- " + line + "\n";
  out += "\n";
  for (const std::string& sentence : part_sentences(results)) out += sentence + "\n\n";
  return out;
}

// What is said above it, its title as a sentence, and the table; nothing without rows.
std::string below_title(TitledTable table) {
  if (!table.text.empty()) table.text += "\n\n";
  table.text += table.title + ":";
  table.title.clear();
  return markdown_of(std::move(table));
}

std::string untitled(TitledTable table) {
  table.title.clear();
  return markdown_of(std::move(table));
}

std::string markdown_of(const Paragraph& paragraph) { return paragraph.text + "\n\n"; }
std::string markdown_of(const Heading& heading) { return "### " + heading.text + "\n\n"; }
std::string markdown_of(const Picture& picture) {
  return fmt::format("![{}]({})\n\n", picture.what, picture.file);
}
std::string markdown_of(const Items& items) {
  std::string out;
  for (const std::string& text : items.texts) out += "- " + text + "\n";
  return out + "\n";
}

std::string meanings_of(const std::vector<Column>& columns) {
  std::string out;
  for (const Column& c : columns)
    if (!c.meaning.empty()) out += fmt::format("- **{}**: {}\n", c.title, c.meaning);
  return out;
}

/// What columns mean, by the titles of their tables; of equal titles the first alone.
class Legend {
 public:
  void add(const TitledTable& table, const std::string& title) {
    const std::string meanings = meanings_of(table.columns);
    if (!table.rows.empty() && !meanings.empty() && seen_.insert(title).second)
      text_ += title + ":\n\n" + meanings + "\n";
  }
  std::string text() const {
    return text_.empty() ? "" : "## How to read the other tables\n\n" + text_;
  }

 private:
  std::set<std::string> seen_;
  std::string text_;
};

std::string section_of(const Section& section, const results::Index& index, Legend& legend) {
  std::string out;
  for (const Block& block : section.build(index)) {
    if (const auto* const table = std::get_if<TitledTable>(&block))
      legend.add(*table, table->title.empty() ? section.title : table->title);
    out += std::visit([](const auto& one) { return markdown_of(one); }, block);
  }
  return out.empty() ? "" : fmt::format("## {}\n\n{}", section.title, out);
}

std::string scene_section(const results::Index& index, const results::Scene& scene,
                          Legend& legend) {
  const SceneReport report = scene_report(index, scene);
  std::string out = fmt::format("## {}\n\n{}. {}\n\n", scene.id, scene.title, report.sentence) +
                    untitled(report.bodies) + report.truth + "\n\n" + below_title(report.fits) +
                    below_title(report.pairs) + untitled(report.result);
  for (const TitledTable& table : report.details) {
    legend.add(table, table.title);
    out += below_title(table);
  }
  if (!report.notes.empty()) {
    out += "Notes:\n\n";
    for (const std::string& note : report.notes) out += "- " + note + "\n";
    out += "\n";
  }
  if (!report.disagreements.empty()) {
    out += "Disagreements with the truth (first of each kind):\n\n";
    for (const results::Disagreement* d : report.disagreements)
      out += fmt::format("- {}: first {} at level {} in frame {}: `{}`\n", d->detector, d->kind,
                         d->level, d->frame, d->case_file);
    out += "\n";
  }
  return out;
}

}  // namespace

std::string markdown_report(const results::Index& index) {
  std::string out = "# contactcheck report\n\n" + origin_section(index.results());
  Legend legend;
  for (const Section* section : sections()) {
    if (section->build != nullptr) {
      out += section_of(*section, index, legend);
      continue;
    }
    // Families show only wrong detectors, and many drawn scenes only sums; tables of every detector
    // would bury them.
    for (const results::Scene* scene : shown_scenes(index.results()))
      if (!scene->family) out += scene_section(index, *scene, legend);
  }
  return out + legend.text() + "## How to read the result table\n\n" +
         meanings_of(result_columns(index.results()));
}

std::map<std::string, std::string> report_files(const results::Results& results) {
  const results::Index index(results);
  std::map<std::string, std::string> files = report_pictures(index);
  files["report.md"] = markdown_report(index);
  return files;
}

}  // namespace contactcheck::report
