#include "reference/report/markdown.h"

#include <fmt/format.h>

#include <utility>

#include "reference/report/claims.h"
#include "reference/report/drawn_scenes.h"
#include "reference/report/goals_table.h"
#include "reference/report/hard_cases.h"
#include "reference/report/known_defects.h"
#include "reference/report/loss_charts.h"
#include "reference/report/origin.h"
#include "reference/report/run_row.h"
#include "reference/report/scene_choice.h"
#include "reference/report/scene_tables.h"
#include "reference/report/speed_error.h"
#include "reference/report/speed_error_plot.h"
#include "reference/report/stability_plot.h"
#include "reference/report/summary.h"

namespace contactcheck::report {
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
  return markdown_of(table);
}

std::string untitled(TitledTable table) {
  table.title.clear();
  return markdown_of(table);
}

// Under a heading of the second order.
std::string section_of(const TitledTable& table) {
  return table.rows.empty() ? "" : "## " + table.title + "\n\n" + untitled(table);
}

std::string scene_section(const results::Index& index, const results::Scene& scene) {
  const SceneReport report = scene_report(index, scene);
  std::string out = fmt::format("## {}\n\n{}. {}\n\n", scene.id, scene.title, report.sentence) +
                    untitled(report.bodies) + report.truth + "\n\n" + below_title(report.fits) +
                    below_title(report.pairs) + untitled(report.result);
  for (const TitledTable& table : report.details) out += below_title(table);
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

std::string legend() {
  std::string out = "## How to read the result table\n\n";
  for (const Column& c : result_columns()) out += fmt::format("- **{}**: {}\n", c.title, c.meaning);
  return out;
}

}  // namespace

std::string markdown_report(const results::Results& results) {
  std::string out = "# contactcheck report\n\n" + origin_section(results) +
                    section_of(summary_table(results)) + drawn_markdown(results) +
                    speed_error_markdown(results) + loss_markdown(results) +
                    section_of(goals_table(results)) + hard_cases_markdown(results) +
                    known_defects_markdown(results);
  const std::string claims = claims_markdown(results);
  if (!claims.empty()) out += "## What the results say\n\n" + claims;
  const results::Index index(results);
  // Of families only wrong detectors are shown, and of many drawn scenes sums; tables of every
  // detector would bury them.
  for (const results::Scene* scene : shown_scenes(results))
    if (!scene->family) out += scene_section(index, *scene);
  return out + section_of(semantics_table(results)) + legend();
}

std::map<std::string, std::string> report_files(const results::Results& results) {
  std::map<std::string, std::string> files = {{"report.md", markdown_report(results)}};
  const auto add_picture = [&](const std::string& file, std::string picture) {
    if (!picture.empty()) files[file] = std::move(picture);
  };
  add_picture(kSpeedErrorFile, speed_error_picture(results));
  add_picture(kErrorsFile, errors_picture(results));
  add_picture(kStagesFile, stages_picture(results));
  const std::vector<FamilyResult> families = family_results(results);
  for (const results::Scene& scene : results.scenes)
    if (scene.family) add_picture(stability_plot_file(scene), stability_plot(scene, families));
  return files;
}

}  // namespace contactcheck::report
