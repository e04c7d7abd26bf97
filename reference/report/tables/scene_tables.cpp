#include "reference/report/tables/scene_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include "reference/report/tables/format.h"
#include "reference/report/tables/lattice_fits.h"
#include "reference/report/tables/random_pairs.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/stage_losses.h"
#include "reference/results/statistics.h"
#include "reference/text/lists.h"

namespace contactcheck::report {
namespace {

using results::Run;

// The frames of one separation among the values of all frames; none where there are none.
template <typename Value>
std::span<const Value> values_at(const std::vector<Value>& values, std::size_t separation,
                                 std::size_t orientations) {
  if (values.size() < (separation + 1) * orientations) return {};
  return std::span(values).subspan(separation * orientations, orientations);
}

std::string median_time(std::span<const std::optional<double>> values) {
  std::vector<double> times;
  for (const std::optional<double>& value : values)
    if (value) times.push_back(*value);
  return times.empty() ? "-" : format_number(results::median(std::move(times)));
}

std::string sum_text(std::span<const std::uint64_t> values) {
  if (values.empty()) return "-";
  return format_count(std::accumulate(values.begin(), values.end(), std::uint64_t{0}));
}

template <typename Cell>
TitledTable table(const std::string& title, const results::Sweep& sweep, const RunList& runs,
                  const Cell& cell) {
  TitledTable out{title, "", {{"detector", true, ""}}, {}};
  for (const double separation : sweep.separations)
    out.columns.push_back({fmt::format("{:g} %", 100.0 * separation), false, ""});
  for (const Run* run : runs) {
    if (!run->ok()) continue;
    std::vector<std::string>& cells = out.rows.emplace_back();
    cells.push_back(run->detector);
    for (std::size_t s = 0; s < sweep.separations.size(); ++s) cells.push_back(cell(*run, s));
  }
  return out;
}

bool timed(const RunList& runs) {
  return std::any_of(runs.begin(), runs.end(),
                     [](const Run* run) { return run->per_frame.frame_ms.has_value(); });
}

}  // namespace

std::vector<TitledTable> separation_tables(const results::Scene& scene, const RunList& runs) {
  if (!scene.sweep) return {};
  const results::Sweep& sweep = *scene.sweep;
  const std::size_t orientations = sweep.orientations;
  const auto time = [&](const Run& run, std::size_t s) {
    const auto& times = run.per_frame.frame_ms;
    return times ? median_time(values_at(*times, s, orientations)) : "-";
  };
  const auto errors = [&](const Run& run, std::size_t s) {
    return sum_text(values_at(run.per_frame.missed, s, orientations)) + " / " +
           sum_text(values_at(run.per_frame.spurious, s, orientations));
  };
  std::vector<TitledTable> out;
  if (std::none_of(runs.begin(), runs.end(), [](const Run* run) { return run->ok(); })) return out;
  if (timed(runs)) {
    TitledTable& times = out.emplace_back(
        table("Time of a frame against separation (ms, playback, medians over the orientations)",
              sweep, runs, time));
    times.columns.push_back({"passes", false, ""});
    std::size_t row = 0;
    for (const Run* run : runs)
      if (run->ok())
        times.rows[row++].push_back(run->times.empty() ? "-"
                                                       : format_count(run->times.front().passes));
  }
  out.push_back(table(
      "Missed / spurious against separation (at the finest level judged, sums over orientations)",
      sweep, runs, errors));
  out.front().text = fmt::format(
      "Distance sweep: {} orientations at each separation, given in % of the size ({} m); below 0 "
      "the second body is pushed so far beyond the first touch.",
      orientations, format_number(scene.size));
  return out;
}

namespace {
using results::Run;

void add_levels(const Run& run, const results::Levels& levels, const char* against,
                TitledTable& out) {
  for (const auto& [level, c] : levels) {
    std::string name = name_of(level);
    if (c.margin) name += " (below " + format_millimetres(c.margin) + " mm)";
    if (c.informative) name += ", informative";
    out.rows.push_back({run.detector, name, against, format_count(c.truth),
                        format_count(c.reported), format_count(c.missed), format_count(c.spurious),
                        format_rate(c.recall), format_error_rate(c.spurious_rate)});
  }
}

std::string spread_text(const results::ErrorSpread& spread,
                        std::string (*format)(std::optional<double>)) {
  return format(spread.max) + " / " + format(spread.mean) + " / " + format(spread.p95);
}

bool has_graded(const results::Geometry& g) {
  return g.covered_length_fraction || g.depth.max || g.depth_kind != DepthKind::kNone;
}

TitledTable bodies_table(const results::Scene& scene) {
  TitledTable out{"Bodies",
                  "",
                  {{"body", true, ""},
                   {"mesh", true, ""},
                   {"vertices", false, ""},
                   {"triangles", false, ""},
                   {"cells", false, ""},
                   {"solid", true, ""},
                   {"notes", true, ""}},
                  {}};
  for (const results::SceneBody& b : scene.bodies)
    out.rows.push_back({b.name, b.source, format_count(b.vertices), format_count(b.triangles),
                        format_count(b.cells), b.solid ? "yes" : "no", b.notes});
  return out;
}

TitledTable result_table(const RunList& runs) {
  TitledTable out{"Result", "", result_columns(), {}};
  for (const Run* run : runs) out.rows.push_back(result_cells(*run));
  return out;
}

// Every level of every detector: against the truth of the doubles and, for single precision,
// against the truth of the rounded values.
TitledTable levels_table(const RunList& runs) {
  TitledTable out{
      "Every level judged (sums over frames)",
      "",
      {{"detector", true, ""},
       {"level", true, ""},
       {"truth for", true, "doubles, or the rounded values of a single-precision detector"},
       {"truth", false, ""},
       {"reported", false, ""},
       {"missed", false, ""},
       {"spurious", false, ""},
       {"recall", false, ""},
       {"spurious rate", false, ""}},
      {}};
  for (const Run* run : runs) {
    add_levels(*run, run->levels, "doubles", out);
    add_levels(*run, run->levels_rounded, "rounded values", out);
  }
  return out;
}

// Contour, distances, depths and normals.
TitledTable graded_table(const RunList& runs) {
  TitledTable out{"Graded errors (lengths in mm, angles in degrees; max / mean / 95th percentile)",
                  "",
                  {{"detector", true, ""},
                   {"contour missed", false, "length of the curve in which missed triangles meet"},
                   {"contour covered", false, "share of the whole curve that was reported"},
                   {"spurious up to", false, "largest true distance of a spurious pair"},
                   {"depth kind", true,
                    "what a depth is: vertex-surface, a vertex to the surface; convex-pair, two "
                    "triangles or boxes until they part"},
                   {"depths judged", false, "depths that have a certified truth"},
                   {"depth error", false, "of these: largest, mean, 95th percentile"},
                   {"normals judged", false, "normals that have a certified truth"},
                   {"normal error", false, "of these: largest, mean, 95th percentile"}},
                  {}};
  for (const Run* run : runs) {
    const results::Geometry& g = run->geometry;
    if (!has_graded(g)) continue;
    out.rows.push_back(
        {run->detector, format_millimetres(g.missed_length), format_rate(g.covered_length_fraction),
         format_millimetres(g.spurious_distance_max), name_of(g.depth_kind),
         format_count(g.depth.judged), spread_text(g.depth, format_millimetres),
         format_count(g.normal_deg.judged), spread_text(g.normal_deg, format_number)});
  }
  return out;
}

TitledTable stages_table(const RunList& runs) {
  TitledTable out =
      empty_stages_table("Which stage lost which true triangle pairs (sums over frames)");
  for (const Run* run : runs) add_stages(run->detector, run->stages, out);
  return out;
}

TitledTable times_table(const RunList& runs) {
  TitledTable out{
      "Times in milliseconds per frame (playback unless said, means over passes)",
      "",
      {{"detector", true, ""},
       {"question", true, ""},
       {"prepare", false, "once per scene, all bodies; a warm-up included"},
       {"map", false, "deforms the vertices; of detectors that need them all"},
       {"update", false, "takes the frame: refits trees, moves bounds"},
       {"query", false, "finds the contacts"},
       {"frame", false, "map + update + query"},
       {"contact frame", false, "the same, of frames with contact"},
       {"first frame", false, "of a pass; the times before leave it out"},
       {"own clock", false,
        "update + query as the detector itself measured them, without the way through "
        "a pipe"},
       {"CPU time", false, "of the whole process tree"},
       {"frame, cold", false, "only of a detector's own question"},
       {"frames", false, "that were timed"},
       {"passes", false, ""},
       {"prepared, MiB", false, "heap that prepare leaves; of a command all its processes"},
       {"memory, MiB", false, "the same, the largest over all frames"}},
      {}};
  const auto mebibytes = [](std::uint64_t bytes) {
    return format_number(static_cast<double>(bytes) / 1048576.0);
  };
  for (const Run* run : runs)
    for (const results::QuestionTimes& t : run->times) {
      TimedPart part;
      part.add(*run, t);
      out.rows.push_back(
          {run->detector, name_of(t.question), format_number(run->prepare_ms),
           format_number(t.playback.map), format_number(t.playback.update),
           format_number(t.playback.query), format_number(t.playback.frame),
           format_number(t.playback.contact_frame), format_number(t.playback.first_frame),
           format_number(t.playback.self_reported), format_number(t.playback.cpu),
           t.cold ? format_number(t.cold->frame) : "-", part.frames_text(), format_count(t.passes),
           mebibytes(run->prepared_bytes), mebibytes(run->memory_bytes)});
    }
  return out;
}

// What detectors count.
TitledTable counters_table(const RunList& runs) {
  TitledTable out{
      "Work per frame (means)", "", {{"detector", true, ""}, {"counted", true, ""}}, {}};
  for (const Run* run : runs) {
    std::string counts;
    for (const auto& [name, sum] : run->counters) {
      std::string words = name;
      std::replace(words.begin(), words.end(), '_', ' ');
      const double mean = static_cast<double>(sum) / static_cast<double>(run->frames);
      counts += (counts.empty() ? "" : ", ") + format_number(mean) + " " + words;
    }
    if (!counts.empty()) out.rows.push_back({run->detector, counts});
  }
  return out;
}

// The passes of a speed-up, and which frames they went through where it was not all of them.
std::string speedup_passes(const Run& run, Question question, const results::Speedup& speedup) {
  const results::QuestionTimes* times = times_in(run, question);
  TimedPart part;
  if (times != nullptr) part.add(run, *times);
  return std::to_string(speedup.passes) + part.cut_text();
}

// By question and reference.
TitledTable speedups_table(const RunList& runs) {
  std::set<std::size_t> passes;
  TitledTable out{
      "Speed-ups: time of the reference / time of the detector on the same question, frames and "
      "passes",
      "",
      {{"detector", true, ""},
       {"its options", true, ""},
       {"question", true, ""},
       {"reference", true, ""},
       {"its options", true, ""},
       {"playback", false, ""},
       {"cold", false, ""},
       {"contact frames, playback", false, "of frames with contact alone"},
       {"without map, playback", false, "without the mapping of both"},
       {"passes", false, ""}},
      {}};
  for (const Run* run : runs)
    for (const auto& [question, references] : run->speedup)
      for (const auto& [reference, s] : references)
        if (reference != run->detector) {
          passes.insert(s.passes);
          out.rows.push_back(
              {run->detector, options_text(run->options), name_of(question), reference,
               options_text(s.reference_options), format_ratio(s.playback, s.passes),
               format_ratio(s.cold, s.passes), format_ratio(s.contact_frames, s.passes),
               format_ratio(s.without_map, s.passes), speedup_passes(*run, question, s)});
        }
  out.text = ends_sentence(passes);
  return out;
}

// "body 12, triangle 334, vertex not judged: open"
std::string truth_text(const results::Scene& scene) {
  return text::joined(scene.truth, [](const auto& one) {
    const auto* count = std::get_if<std::uint64_t>(&one.second);
    return std::string(name_of(one.first)) + " " +
           (count != nullptr ? format_count(*count) : std::get<std::string>(one.second));
  });
}

// What a reader must know about single runs and no table shows.
std::vector<std::string> notes_of(const RunList& runs) {
  std::vector<std::string> out;
  for (const Run* run : runs) {
    for (const auto* notes : {&run->float_environment, &run->notes})
      for (const std::string& note : *notes) out.push_back(run->detector + ": " + note);
    for (const auto& [level, why] : run->not_judged)
      out.push_back(fmt::format("{}: level {} {}", run->detector, name_of(level), why));
  }
  return out;
}

}  // namespace

SceneReport scene_report(const results::Index& index, const results::Scene& scene) {
  const RunList& runs = index.runs_of(scene.id);
  SceneReport out;
  out.sentence = fmt::format("{} frames, {} with contact, size {} m.", scene.frames,
                             scene.contact_frames, format_number(scene.size));
  out.truth = "True contacts, summed over frames: " + truth_text(scene) + ".";
  out.bodies = bodies_table(scene);
  out.fits = fits_table(scene);
  out.pairs = pairs_table(scene);
  out.result = result_table(runs);
  out.details = separation_tables(scene, runs);
  for (TitledTable table : {levels_table(runs), graded_table(runs), stages_table(runs),
                            times_table(runs), counters_table(runs), speedups_table(runs)})
    if (!table.rows.empty()) out.details.push_back(std::move(table));
  out.notes = notes_of(runs);
  for (const results::Disagreement& d : index.results().disagreements)
    if (d.scene == scene.id) out.disagreements.push_back(&d);
  return out;
}

}  // namespace contactcheck::report
