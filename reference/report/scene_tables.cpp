#include "reference/report/scene_tables.h"

#include <nlohmann/json.hpp>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

bool is_ok(const Json& run) { return run.at("status") == "ok"; }
std::string detector_of(const Json& run) { return run.at("detector").get<std::string>(); }

std::string level_rows(const Json& run, const Json& levels, const std::string& against) {
  std::string rows;
  for (const auto& [level, c] : levels.items()) {
    std::string name = level;
    if (c.contains("margin")) name += " (below " + format_millimetres(c.at("margin")) + " mm)";
    if (c.value("informative", false)) name += ", informative";
    rows += table_line({detector_of(run), name, against, format_count(c.at("truth")),
                        format_count(c.at("reported")), format_count(c.at("missed")),
                        format_count(c.at("spurious")), format_rate(c.at("recall")),
                        format_error_rate(c.at("spurious_rate"))});
  }
  return rows;
}

std::string spread_text(const Json& g, const char* stem, bool millimetres) {
  std::string text;
  for (const char* which : {"max", "mean", "p95"}) {
    const Json value = at_or_null(g, (std::string(stem) + "_" + which).c_str());
    text += (text.empty() ? "" : " / ");
    text += millimetres ? format_millimetres(value) : format_number(value);
  }
  return text;
}

bool has_graded(const Json& g) {
  return !at_or_null(g, "covered_length_fraction").is_null() ||
         !at_or_null(g, "depth_error_max").is_null() ||
         g.value("depth_kind", "none") != std::string("none");
}

}  // namespace

std::string levels_table(const RunList& runs) {
  std::string rows;
  for (const Json& run : runs) {
    if (!is_ok(run)) continue;
    rows += level_rows(run, run.at("levels"), "doubles");
    if (run.contains("levels_rounded"))
      rows += level_rows(run, run.at("levels_rounded"), "values fed");
  }
  return titled_table("Every level judged (sums over frames):",
                      {{"detector", true, ""},
                       {"level", true, ""},
                       {"truth for", true, ""},
                       {"truth", false, ""},
                       {"reported", false, ""},
                       {"missed", false, ""},
                       {"spurious", false, ""},
                       {"recall", false, ""},
                       {"spurious rate", false, ""}},
                      rows);
}

std::string graded_table(const RunList& runs) {
  std::string rows;
  for (const Json& run : runs) {
    if (!is_ok(run) || !has_graded(run.at("geometry"))) continue;
    const Json& g = run.at("geometry");
    rows += table_line(
        {detector_of(run), format_millimetres(at_or_null(g, "missed_length")),
         format_rate(at_or_null(g, "covered_length_fraction")),
         format_millimetres(at_or_null(g, "spurious_distance_max")), g.value("depth_kind", "none"),
         format_count(at_or_null(g, "depth_judged")), spread_text(g, "depth_error", true),
         format_count(at_or_null(g, "normal_judged")), spread_text(g, "normal_error_deg", false)});
  }
  return titled_table(
      "Graded errors (lengths in mm, angles in degrees; max / mean / 95th percentile):",
      {{"detector", true, ""},
       {"contour missed", false, ""},
       {"contour covered", false, ""},
       {"spurious up to", false, ""},
       {"depth kind", true, ""},
       {"depths judged", false, ""},
       {"depth error", false, ""},
       {"normals judged", false, ""},
       {"normal error", false, ""}},
      rows);
}

std::string stages_table(const RunList& runs) {
  std::string rows;
  for (const Json& run : runs) {
    if (!is_ok(run)) continue;
    for (const Json& s : run.at("stages")) {
      const std::string visited =
          s.contains("visited")
              ? format_count(s.at("visited")) + " " + s.at("visited_unit").get<std::string>()
              : "-";
      rows += table_line({detector_of(run), s.at("name").get<std::string>(),
                          s.at("unit").get<std::string>(), format_count(s.at("in")),
                          format_count(s.at("out")), visited, format_count(s.at("missed"))});
    }
  }
  return titled_table("Which stage lost which true triangle pairs (sums over frames):",
                      {{"detector", true, ""},
                       {"stage", true, ""},
                       {"unit", true, ""},
                       {"in", false, ""},
                       {"out", false, ""},
                       {"visited", false, ""},
                       {"missed", false, ""}},
                      rows);
}

std::string times_table(const RunList& runs) {
  std::string rows;
  for (const Json& run : runs) {
    if (!is_ok(run) || !run.at("time_ms").contains("cold")) continue;
    const Json& t = run.at("time_ms");
    rows += table_line(
        {detector_of(run), t.at("question").get<std::string>(), format_number(t.at("prepare")),
         format_number(t.at("cold").at("map")), format_number(t.at("cold").at("update")),
         format_number(t.at("cold").at("query")), format_number(t.at("cold").at("frame")),
         format_number(t.at("cold").at("contact_frame")),
         format_number(at_or_null(t.at("cold"), "self_reported")),
         format_number(t.at("hot").at("frame")), format_count(t.at("timed_frames")),
         format_count(t.at("repeats")),
         format_number(run.at("memory_bytes").get<double>() / 1048576.0)});
  }
  return titled_table("Times in milliseconds per frame (medians over repeats; cold unless said):",
                      {{"detector", true, ""},
                       {"question", true, ""},
                       {"prepare", false, ""},
                       {"map", false, ""},
                       {"update", false, ""},
                       {"query", false, ""},
                       {"frame", false, ""},
                       {"contact frame", false, ""},
                       {"own clock", false, ""},
                       {"frame, hot", false, ""},
                       {"timed frames", false, ""},
                       {"repeats", false, ""},
                       {"memory, MiB", false, ""}},
                      rows);
}

std::string counters_table(const RunList& runs) {
  std::string rows;
  for (const Json& run : runs) {
    if (!is_ok(run) || !run.contains("counters")) continue;
    std::string counts;
    for (const auto& [name, sum] : run.at("counters").items()) {
      std::string words = name;
      std::replace(words.begin(), words.end(), '_', ' ');
      counts += (counts.empty() ? "" : ", ") +
                format_number(sum.get<double>() / run.at("frames").get<double>()) + " " + words;
    }
    rows += table_line({detector_of(run), counts});
  }
  return titled_table("Work per frame (means):", {{"detector", true, ""}, {"counted", true, ""}},
                      rows);
}

std::string speedups_table(const RunList& runs) {
  std::string rows;
  for (const Json& run : runs) {
    if (!is_ok(run)) continue;
    const Json speedups = at_or_null(run, "speedup");
    for (const auto& [question, references] : speedups.items())
      for (const auto& [reference, s] : references.items()) {
        if (reference == detector_of(run)) continue;
        rows +=
            table_line({detector_of(run), options_text(at_or_null(run, "options")), question,
                        reference, options_text(at_or_null(s, "reference_options")),
                        format_ratio(s.at("cold"), true), format_ratio(at_or_null(s, "hot"), true),
                        format_ratio(at_or_null(s, "contact_frames"), true),
                        format_ratio(at_or_null(s, "without_map"), true)});
      }
  }
  return titled_table(
      "Speed-ups: time of the reference / time of the detector on the same question, frames and "
      "repeats, with 95 % intervals:",
      {{"detector", true, ""},
       {"its options", true, ""},
       {"question", true, ""},
       {"reference", true, ""},
       {"its options", true, ""},
       {"cold", false, ""},
       {"hot", false, ""},
       {"contact frames, cold", false, ""},
       {"without map, cold", false, ""}},
      rows);
}

}  // namespace contactcheck
