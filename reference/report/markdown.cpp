#include "reference/report/markdown.h"

#include <fmt/format.h>

#include <set>

#include "reference/report/claims.h"
#include "reference/report/format.h"
#include "reference/report/goals_table.h"
#include "reference/report/hard_cases.h"
#include "reference/report/known_defects.h"
#include "reference/report/lattice_fits.h"
#include "reference/report/loss_charts.h"
#include "reference/report/markdown_table.h"
#include "reference/report/random_pairs.h"
#include "reference/report/run_row.h"
#include "reference/report/scene_tables.h"
#include "reference/report/separation_table.h"
#include "reference/report/speed_error_section.h"
#include "reference/report/summary.h"

namespace contactcheck {
namespace {
using results::Run;

std::string machine_section(const results::Results& results) {
  const results::Machine& m = results.machine;
  std::string libraries;
  for (const auto& [name, version] : results.libraries)
    libraries += (libraries.empty() ? "" : ", ") + name + " " + version;
  return fmt::format(
      "- command: `{}`\n- machine: {}, {} cores, {}, {}\n- built with {}, {}\n- libraries: {}\n"
      "- contactcheck {}, schema {}\n\n",
      results.command, m.cpu, m.cores, m.isa, m.os, m.compiler, m.build, libraries, results.version,
      results::kSchema);
}

// Their times are of another process than the others'.
std::string resumed_line(const results::Results& results) {
  std::string scenes;
  for (const std::string& scene : results.resumed.value_or(std::vector<std::string>{}))
    scenes += (scenes.empty() ? "" : ", ") + scene;
  if (scenes.empty()) return "";
  return fmt::format(
      "Taken over from an earlier run that was interrupted (`--resume`), with the times measured "
      "then: {}.\n\n",
      scenes);
}

// Whoever reads a part must not take it for the whole.
std::string parts_line(const results::Results& results) {
  if (results.shard)
    return fmt::format(
        "Shard {} of {}: {} of the {} scenes of `{}`; `contactcheck merge` puts the shards "
        "together.\n\n",
        results.shard->index, results.shard->of, results.scenes.size(),
        results.shard->scenes.size(), results.shard->command);
  if (results.merged.empty()) return "";
  return fmt::format("Put together from {} shards (`contactcheck merge`).\n\n",
                     results.merged.size());
}

std::string bodies_table(const results::Scene& scene) {
  std::string out =
      "| body | mesh | vertices | triangles | cells | solid | notes |\n"
      "|---|---|--:|--:|--:|---|---|\n";
  for (const results::SceneBody& b : scene.bodies)
    out += table_line({b.name, b.source, format_count(b.vertices), format_count(b.triangles),
                       format_count(b.cells), b.solid ? "yes" : "no", b.notes});
  return out + "\n";
}

// "body 12, triangle 334, vertex not judged: open"
std::string truth_line(const results::Scene& scene) {
  std::string out;
  for (const auto& [level, truth] : scene.truth) {
    const auto* count = std::get_if<std::uint64_t>(&truth);
    out += (out.empty() ? "" : ", ") + std::string(name_of(level)) + " " +
           (count != nullptr ? format_count(*count) : std::get<std::string>(truth));
  }
  return "True contacts, summed over frames: " + out + ".\n\n";
}

std::string result_table(const RunList& runs) {
  std::string out = table_head(result_columns());
  for (const Run* run : runs) out += table_line(result_cells(*run));
  return out + "\n";
}

std::string summary_section(const results::Results& results) {
  std::string out =
      "## Summary\n\nSums over scenes; speed-ups are the smallest and the largest of any "
      "scene.\n\n" +
      table_head(summary_columns());
  for (const auto& cells : summary_lines(results)) out += table_line(cells);
  return out + "\n";
}

std::string goals_section(const results::Results& results) {
  std::string rows;
  for (const auto& cells : goal_lines(results)) rows += table_line(cells);
  if (rows.empty()) return "";
  return "## Goals of the suite\n\nTimes are medians; a ratio over a detector is its time over "
         "that "
         "of the detector named, with a 95 % interval.\n\n" +
         table_head(goal_columns()) + rows + "\n";
}

std::string disagreements_list(const results::Results& results, const std::string& scene) {
  std::string out;
  for (const results::Disagreement& d : results.disagreements)
    if (d.scene == scene)
      out += fmt::format("- {}: first {} at level {} in frame {}: `{}`\n", d.detector, d.kind,
                         d.level, d.frame, d.case_file);
  return out.empty() ? "" : "Disagreements with the truth (first of each kind):\n\n" + out + "\n";
}

// What a reader must know about single runs and no table shows.
std::string notes_list(const RunList& runs) {
  std::string out;
  for (const Run* run : runs) {
    for (const auto* notes : {&run->float_environment, &run->notes})
      for (const std::string& note : *notes) out += fmt::format("- {}: {}\n", run->detector, note);
    for (const auto& [level, why] : run->not_judged)
      out += fmt::format("- {}: level {} {}\n", run->detector, name_of(level), why);
  }
  return out.empty() ? "" : "Notes:\n\n" + out + "\n";
}

std::string scene_section(const results::Results& results, const results::Scene& scene) {
  const RunList runs = runs_of_scene(results, scene.id);
  return fmt::format("## {}\n\n{}. {} frames, {} with contact, size {} m.\n\n", scene.id,
                     scene.title, scene.frames, scene.contact_frames, format_number(scene.size)) +
         bodies_table(scene) + truth_line(scene) + fits_markdown(scene) + pairs_markdown(scene) +
         result_table(runs) + separation_tables(scene, runs) + levels_table(runs) +
         graded_table(runs) + stages_table(runs) + times_table(runs) + counters_table(runs) +
         speedups_table(runs) + notes_list(runs) + disagreements_list(results, scene.id);
}

// What each detector claims, from its first run that is `ok`.
std::string semantics_section(const results::Results& results) {
  std::set<std::string> seen;
  std::string rows;
  for (const Run& run : results.runs)
    if (run.ok() && !run.semantics.levels.empty() && seen.insert(run.detector).second)
      rows += table_line({run.detector, options_text(run.options), semantics_text(run.semantics)});
  if (rows.empty()) return "";
  return "## What each detector claims\n\nA level that is not claimed is not judged.\n\n" +
         table_head({{"detector", true, ""}, {"options", true, ""}, {"claims", true, ""}}) + rows +
         "\n";
}

std::string legend() {
  std::string out = "## How to read the result table\n\n";
  for (const Column& c : result_columns()) out += fmt::format("- **{}**: {}\n", c.title, c.meaning);
  return out;
}

}  // namespace

std::string markdown_report(const results::Results& results) {
  std::string out = "# contactcheck report\n\n" + machine_section(results) + parts_line(results) +
                    resumed_line(results) + summary_section(results) +
                    speed_error_markdown(results) + loss_markdown(results) +
                    goals_section(results) + hard_cases_markdown(results) +
                    known_defects_markdown(results);
  const std::string claims = claims_markdown(results);
  if (!claims.empty()) out += "## What the results say\n\n" + claims;
  // Families are told by who goes wrong in them; tables of every detector would bury that.
  for (const results::Scene& scene : results.scenes)
    if (!scene.family) out += scene_section(results, scene);
  return out + semantics_section(results) + legend();
}

}  // namespace contactcheck
