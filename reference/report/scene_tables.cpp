#include "reference/report/scene_tables.h"

#include <algorithm>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {
using results::Run;

std::string level_rows(const Run& run, const results::Levels& levels, const char* against) {
  std::string rows;
  for (const auto& [level, c] : levels) {
    std::string name = name_of(level);
    if (c.margin) name += " (below " + format_millimetres(c.margin) + " mm)";
    if (c.informative) name += ", informative";
    rows += table_line({run.detector, name, against, format_count(c.truth),
                        format_count(c.reported), format_count(c.missed), format_count(c.spurious),
                        format_rate(c.recall), format_error_rate(c.spurious_rate)});
  }
  return rows;
}

std::string spread_text(const results::ErrorSpread& spread,
                        std::string (*format)(std::optional<double>)) {
  return format(spread.max) + " / " + format(spread.mean) + " / " + format(spread.p95);
}

bool has_graded(const results::Geometry& g) {
  return g.covered_length_fraction || g.depth.max || g.depth_kind != DepthKind::kNone;
}

}  // namespace

std::string levels_table(const RunList& runs) {
  std::string rows;
  for (const Run* run : runs)
    rows += level_rows(*run, run->levels, "doubles") +
            level_rows(*run, run->levels_rounded, "values fed");
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
  for (const Run* run : runs) {
    const results::Geometry& g = run->geometry;
    if (!has_graded(g)) continue;
    rows += table_line(
        {run->detector, format_millimetres(g.missed_length), format_rate(g.covered_length_fraction),
         format_millimetres(g.spurious_distance_max), name_of(g.depth_kind),
         format_count(g.depth.judged), spread_text(g.depth, format_millimetres),
         format_count(g.normal_deg.judged), spread_text(g.normal_deg, format_number)});
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
  for (const Run* run : runs)
    for (const results::Stage& s : run->stages)
      rows += table_line({run->detector, s.name, s.unit, format_count(s.in), format_count(s.out),
                          s.visited ? format_count(*s.visited) + " " + s.visited_unit : "-",
                          format_count(s.missed)});
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
  for (const Run* run : runs) {
    if (run->times.empty()) continue;
    const results::QuestionTimes& t = run->times.front();
    rows += table_line({run->detector, name_of(t.question), format_number(run->prepare_ms),
                        format_number(t.cold.map), format_number(t.cold.update),
                        format_number(t.cold.query), format_number(t.cold.frame),
                        format_number(t.cold.contact_frame), format_number(t.cold.self_reported),
                        format_number(t.hot.frame), format_count(t.timed_frames),
                        format_count(t.repeats),
                        format_number(static_cast<double>(run->memory_bytes) / 1048576.0)});
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
  for (const Run* run : runs) {
    std::string counts;
    for (const auto& [name, sum] : run->counters) {
      std::string words = name;
      std::replace(words.begin(), words.end(), '_', ' ');
      const double mean = static_cast<double>(sum) / static_cast<double>(run->frames);
      counts += (counts.empty() ? "" : ", ") + format_number(mean) + " " + words;
    }
    if (!counts.empty()) rows += table_line({run->detector, counts});
  }
  return titled_table("Work per frame (means):", {{"detector", true, ""}, {"counted", true, ""}},
                      rows);
}

std::string speedups_table(const RunList& runs) {
  std::string rows;
  for (const Run* run : runs)
    for (const auto& [question, references] : run->speedup)
      for (const auto& [reference, s] : references)
        if (reference != run->detector)
          rows +=
              table_line({run->detector, options_text(run->options), name_of(question), reference,
                          options_text(s.reference_options), format_ratio(s.cold, true),
                          format_ratio(s.hot, true), format_ratio(s.contact_frames, true),
                          format_ratio(s.without_map, true)});
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
