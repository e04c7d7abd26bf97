#include "reference/report/markdown.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
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
using Json = nlohmann::ordered_json;

std::string machine_section(const Json& results) {
  const Json& m = results.at("machine");
  std::string libraries;
  for (const auto& [name, version] : results.at("libraries").items())
    libraries += (libraries.empty() ? "" : ", ") + name + " " + version.get<std::string>();
  return fmt::format(
      "- command: `{}`\n- machine: {}, {} cores, {}, {}\n- built with {}, {}\n- libraries: {}\n"
      "- contactcheck {}, schema {}\n\n",
      results.at("command").get<std::string>(), m.at("cpu").get<std::string>(),
      whole_number(m.at("cores")), m.at("isa").get<std::string>(), m.at("os").get<std::string>(),
      m.at("compiler").get<std::string>(), m.at("build").get<std::string>(), libraries,
      results.at("version").get<std::string>(), results.at("schema").get<std::string>());
}

// Their times are of another process than the others'.
std::string resumed_line(const Json& results) {
  std::string scenes;
  for (const Json& scene : results.value("resumed", Json::array()))
    scenes += (scenes.empty() ? "" : ", ") + scene.get<std::string>();
  if (scenes.empty()) return "";
  return fmt::format(
      "Taken over from an earlier run that was interrupted (`--resume`), with the times measured "
      "then: {}.\n\n",
      scenes);
}

// Whoever reads a part must not take it for the whole.
std::string parts_line(const Json& results) {
  if (results.contains("shard")) {
    const Json& shard = results.at("shard");
    return fmt::format(
        "Shard {} of {}: {} of the {} scenes of `{}`; `contactcheck merge` puts the shards "
        "together.\n\n",
        whole_number(shard.at("index")), whole_number(shard.at("of")), results.at("scenes").size(),
        shard.at("scenes").size(), shard.at("command").get<std::string>());
  }
  if (!results.contains("merged")) return "";
  return fmt::format("Put together from {} shards (`contactcheck merge`).\n\n",
                     results.at("merged").size());
}

std::string bodies_table(const Json& scene) {
  std::string out =
      "| body | mesh | vertices | triangles | cells | solid | notes |\n"
      "|---|---|--:|--:|--:|---|---|\n";
  for (const Json& b : scene.at("bodies"))
    out += table_line({b.at("name").get<std::string>(), b.at("source").get<std::string>(),
                       format_count(b.at("vertices")), format_count(b.at("triangles")),
                       format_count(b.at("cells")), b.at("solid").get<bool>() ? "yes" : "no",
                       b.at("notes").get<std::string>()});
  return out + "\n";
}

// "body 12, triangle 334, vertex not judged: open"
std::string truth_line(const Json& scene) {
  std::string out;
  for (const auto& [level, count] : scene.at("truth").items())
    out += (out.empty() ? "" : ", ") + level + " " +
           (count.is_string() ? count.get<std::string>() : format_count(count));
  return "True contacts, summed over frames: " + out + ".\n\n";
}

std::string result_table(const std::vector<Json>& runs) {
  std::string out = table_head(result_columns());
  for (const Json& run : runs) out += table_line(result_cells(run));
  return out + "\n";
}

std::string summary_section(const Json& results) {
  std::string out =
      "## Summary\n\nSums over scenes; speed-ups are the smallest and the largest of any "
      "scene.\n\n" +
      table_head(summary_columns());
  for (const auto& cells : summary_lines(results)) out += table_line(cells);
  return out + "\n";
}

std::string goals_section(const Json& results) {
  std::string rows;
  for (const auto& cells : goal_lines(results)) rows += table_line(cells);
  if (rows.empty()) return "";
  return "## Goals of the suite\n\nTimes are medians; a ratio over a detector is its time over "
         "that "
         "of the detector named, with a 95 % interval.\n\n" +
         table_head(goal_columns()) + rows + "\n";
}

std::string disagreements_list(const Json& results, const std::string& scene) {
  std::string out;
  for (const Json& d : results.at("disagreements")) {
    if (d.at("scene") != scene) continue;
    out += fmt::format("- {}: first {} at level {} in frame {}: `{}`\n",
                       d.at("detector").get<std::string>(), d.at("kind").get<std::string>(),
                       d.at("level").get<std::string>(), whole_number(d.at("frame")),
                       d.at("case").get<std::string>());
  }
  return out.empty() ? "" : "Disagreements with the truth (first of each kind):\n\n" + out + "\n";
}

// What a reader must know about single runs and no table shows.
std::string notes_list(const std::vector<Json>& runs) {
  std::string out;
  for (const Json& run : runs) {
    if (run.at("status") != "ok") continue;
    const auto detector = run.at("detector").get<std::string>();
    for (const char* kind : {"float_environment", "notes"})
      for (const Json& note : run.value(kind, Json::array()))
        out += fmt::format("- {}: {}\n", detector, note.get<std::string>());
    const Json not_judged = run.value("not_judged", Json::object());
    for (const auto& [level, why] : not_judged.items())
      out += fmt::format("- {}: level {} {}\n", detector, level, why.get<std::string>());
  }
  return out.empty() ? "" : "Notes:\n\n" + out + "\n";
}

std::string scene_section(const Json& results, const Json& scene) {
  const auto id = scene.at("id").get<std::string>();
  const std::vector<Json> runs = runs_of_scene(results, id);
  return fmt::format("## {}\n\n{}. {} frames, {} with contact, size {} m.\n\n", id,
                     scene.at("title").get<std::string>(), whole_number(scene.at("frames")),
                     whole_number(scene.at("contact_frames")), format_number(scene.at("size"))) +
         bodies_table(scene) + truth_line(scene) + fits_markdown(scene) + pairs_markdown(scene) +
         result_table(runs) + separation_tables(scene, runs) + levels_table(runs) +
         graded_table(runs) + stages_table(runs) + times_table(runs) + counters_table(runs) +
         speedups_table(runs) + notes_list(runs) + disagreements_list(results, id);
}

// What each detector claims, from its first run that is `ok`.
std::string semantics_section(const Json& results) {
  std::set<std::string> seen;
  std::string rows;
  for (const Json& run : results.at("runs")) {
    const auto detector = run.at("detector").get<std::string>();
    if (run.at("status") != "ok" || !run.at("semantics").contains("levels")) continue;
    if (seen.insert(detector).second)
      rows += table_line(
          {detector, options_text(run.at("options")), semantics_text(run.at("semantics"))});
  }
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

std::string markdown_report(const Json& results) {
  std::string out = "# contactcheck report\n\n" + machine_section(results) + parts_line(results) +
                    resumed_line(results) + summary_section(results) +
                    speed_error_markdown(results) + loss_markdown(results) +
                    goals_section(results) + hard_cases_markdown(results) +
                    known_defects_markdown(results);
  const std::string claims = claims_markdown(results);
  if (!claims.empty()) out += "## What the results say\n\n" + claims;
  // Families are told by who goes wrong in them; tables of every detector would bury that.
  for (const Json& scene : results.at("scenes"))
    if (!scene.contains("family")) out += scene_section(results, scene);
  return out + semantics_section(results) + legend();
}

}  // namespace contactcheck
