#include "reference/results/results_json.h"

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "reference/text/described_json.h"

namespace contactcheck {

template <typename Io>
void fields(Io& io, Semantics& s) {
  CONTACTCHECK_FIELDS(io, s, levels, informative, questions);
  std::string body = s.solid ? "solid" : "surface", touching = s.closed ? "closed" : "open";
  io("body", body);
  io("touching", touching);
  if constexpr (Io::kReads) {
    s.solid = body == "solid";
    s.closed = touching == "closed";
  }
  CONTACTCHECK_FIELDS(io, s, exact, margin, precision, scale);
  io("depth_kind", s.depth);
  io("means", s.means);
  CONTACTCHECK_FIELDS(io.unless_empty, s, local_origin, no_early_end);
  io.unless_empty("tolerance", s.tolerance.absolute);
  io.unless_empty("tolerance_of_start", s.tolerance.of_start);
}

namespace results {

using Json = nlohmann::ordered_json;

constexpr std::array<Status, 4> values_of(Status) {
  return {Status::kOk, Status::kError, Status::kAbsent, Status::kRefused};
}

template <typename Io>
void fields(Io& io, Machine& m) {
  CONTACTCHECK_FIELDS(io, m, cpu, cores, isa, os, compiler, build);
}

template <typename Io>
void fields(Io& io, NearReports& n) {
  CONTACTCHECK_FIELDS(io, n, near, near_max, near_of_start_max, undecided);
}

template <typename Io>
void fields(Io& io, LevelCounts& c) {
  CONTACTCHECK_FIELDS(io, c, truth, reported, hit, missed, spurious, recall, spurious_rate);
  CONTACTCHECK_FIELDS(io.unless_empty, c, margin, informative, within);
}

template <typename Io>
void fields(Io& io, PerFrame& f) {
  // No level is an empty text in the file.
  std::string level = f.level ? name_of(*f.level) : "";
  io("level", level);
  if constexpr (Io::kReads) f.level = level_from_name(level);
  CONTACTCHECK_FIELDS(io, f, truth, missed, spurious, covered_length_fraction);
  io.unless_empty("frame_ms", f.frame_ms);
}

template <typename Io>
void fields(Io& io, HistogramBin& b) {
  CONTACTCHECK_FIELDS(io, b, from, below, count);
}

template <typename Io>
void fields(Io& io, Episode& e) {
  CONTACTCHECK_FIELDS(io, e, bodies, first_true, first_reported, hover_gap, late_frames);
}

template <typename Io>
void fields(Io& io, Geometry& g) {
  CONTACTCHECK_FIELDS(io, g, missed_length, covered_length_fraction, spurious_distance_max,
                      spurious_distance_histogram, depth_kind);
  io("depth_judged", g.depth.judged);
  io("depth_error_max", g.depth.max);
  io("depth_error_mean", g.depth.mean);
  io("depth_error_p95", g.depth.p95);
  io("depth_error_histogram", g.depth.histogram);
  io("normal_judged", g.normal_deg.judged);
  io("normal_error_deg_max", g.normal_deg.max);
  io("normal_error_deg_mean", g.normal_deg.mean);
  io("normal_error_deg_p95", g.normal_deg.p95);
  io("normal_error_deg_histogram", g.normal_deg.histogram);
  CONTACTCHECK_FIELDS(io, g, hover_gap_max, late_frames, episodes);
}

template <typename Io>
void fields(Io& io, Stage& s) {
  CONTACTCHECK_FIELDS(io, s, name, unit, in, out, missed);
  CONTACTCHECK_FIELDS(io.unless_empty, s, visited, visited_unit);
}

template <typename Io>
void fields(Io& io, PhaseTimes& t) {
  CONTACTCHECK_FIELDS(io, t, map, update, query, frame, contact_frame);
  CONTACTCHECK_FIELDS(io.unless_empty, t, first_frame, self_reported);
  io("cpu", t.cpu);
  io.unless_empty("taken", t.taken);
}

template <typename Io>
void fields(Io& io, QuestionTimes& t) {
  CONTACTCHECK_FIELDS(io, t, question, timed_frames, timed_contact_frames, passes, playback);
  CONTACTCHECK_FIELDS(io.unless_empty, t, pass_ms, cold);
}

template <typename Io>
void fields(Io& io, Ratio& r) {
  io("ratio", r.value);
  CONTACTCHECK_FIELDS(io, r, low, high);
}

template <typename Io>
void fields(Io& io, Speedup& s) {
  CONTACTCHECK_FIELDS(io, s, playback, cold, contact_frames, without_map, passes);
  std::string interval = interval_name(s.passes);
  io("interval", interval);
  io("reference_options", s.reference_options);
}

template <typename Io>
void fields(Io& io, Timing& t) {
  CONTACTCHECK_FIELDS(io, t, processes, one_pass_beyond, seed, sweep_bytes);
}

template <typename Io>
void fields(Io& io, ClosedLoop& c) {
  io("error", c.error);
  if (!c.error.empty()) return;
  CONTACTCHECK_FIELDS(io, c, steps, levels, hover_at_rest_max, hover_at_rest_mean,
                      deepest_penetration, energy_gain, last_speed, tunnelling_events);
}

template <typename Io>
void fields(Io& io, Impacts& i) {
  CONTACTCHECK_FIELDS(io, i, tunnelled, timed, early_max, late_max);
  CONTACTCHECK_FIELDS(io.unless_empty, i, new_triangles, new_missed, near_at_start);
}

template <typename Io>
void fields(Io& io, SceneImpacts& i) {
  CONTACTCHECK_FIELDS(io, i, motion, starting, meeting, passing, new_triangles, passing_triangles);
}

template <typename Io>
void fields(Io& io, StepTimes& t) {
  CONTACTCHECK_FIELDS(io, t, steps, repeats, mss, cell, test, response, total, test_by_repeat,
                      total_by_repeat);
}

// `prepare` is repeated in the times of every question, and is there without timing, too.
static Json times_json(const Run& run, std::size_t question) {
  Json out = {{"prepare", run.prepare_ms}};
  if (question < run.times.size()) out.update(text::described(run.times[question]));
  return out;
}

static void read_times(const Json& json, Run& run) {
  const auto own = json.find("time_ms");
  if (own == json.end()) return;
  if (own->contains("prepare")) own->at("prepare").get_to(run.prepare_ms);
  if (!own->contains("question")) return;
  text::read_described(*own, run.times.emplace_back());
  for (const Json& other : json.value("time_ms_other_questions", Json::array()))
    text::read_described(other, run.times.emplace_back());
}

template <typename Io>
void fields(Io& io, Run& run) {
  CONTACTCHECK_FIELDS(io, run, scene, detector, status, message, frames, contact_frames, semantics,
                      options, recording);
  io.unless_empty("failed_frame", run.failed_frame);
  if (!run.ok()) return;
  CONTACTCHECK_FIELDS(io, run, per_frame, levels);
  io.unless_empty("levels_rounded", run.levels_rounded);
  CONTACTCHECK_FIELDS(io, run, not_judged, geometry, stages);
  io.unless_empty("counters", run.counters);
  if constexpr (Io::kReads) {
    read_times(io.json(), run);
  } else {
    io("time_ms", times_json(run, 0));
  }
  CONTACTCHECK_FIELDS(io, run, memory_bytes, prepared_bytes, contact_hash, float_environment,
                      notes);
  CONTACTCHECK_FIELDS(io.unless_empty, run, impacts, closed_loop, step_ms);
  if constexpr (!Io::kReads) {
    if (run.times.empty()) return;
    Json others = Json::array();
    for (std::size_t i = 1; i < run.times.size(); ++i) others.push_back(times_json(run, i));
    io("time_ms_other_questions", others);
  }
  io("speedup", run.speedup);
}

template <typename Io>
void fields(Io& io, SceneBody& b) {
  CONTACTCHECK_FIELDS(io, b, name, source, notes, vertices, triangles, cells, solid);
}

template <typename Io>
void fields(Io& io, Family& f) {
  CONTACTCHECK_FIELDS(io, f, parameter, values, origin, stresses, true_pairs);
  io.unless_empty("range", f.range);
}

template <typename Io>
void fields(Io& io, Sweep& s) {
  CONTACTCHECK_FIELDS(io, s, separations, orientations, seed, tolerance);
}

template <typename Io>
void fields(Io& io, LatticeFit& f) {
  CONTACTCHECK_FIELDS(io, f, body, rms, max);
}

template <typename Io>
void fields(Io& io, PairKindTally& t) {
  CONTACTCHECK_FIELDS(io, t, pairs, touching);
}

struct CheckedPairs {
  std::uint64_t &checked, &oracle_wrong;
};

template <typename Io>
void fields(Io& io, CheckedPairs& p) {
  CONTACTCHECK_FIELDS(io, p, checked, oracle_wrong);
}

template <typename Io>
void fields(Io& io, RandomPairs& p) {
  CONTACTCHECK_FIELDS(io, p, count, seed, touching, per_kind);
  CheckedPairs rational = {p.checked, p.oracle_wrong};
  io("rational", rational);
}

template <typename Io>
void fields(Io& io, Drawn& d) {
  CONTACTCHECK_FIELDS(io, d, seed, number, redrawn, happens, parameters);
}

template <typename Io>
void fields(Io& io, Simulation& s) {
  CONTACTCHECK_FIELDS(io, s, driver, step, every);
}

template <typename Io>
void fields(Io& io, SceneScale& s) {
  CONTACTCHECK_FIELDS(io, s, shortest_edge, longest_edge, reach);
}

template <typename Io>
void fields(Io& io, Scene& s) {
  CONTACTCHECK_FIELDS(io, s, id, title, frames, time_step, size);
  io.unless_empty("scale", s.scale);
  CONTACTCHECK_FIELDS(io, s, contact_frames, truth, truth_hash, bodies);
  CONTACTCHECK_FIELDS(io.unless_empty, s, separation, cold_frames, family, sweep, fits, pairs,
                      drawn, simulation, impacts, unjudged, contacts);
}

template <typename Io>
void fields(Io& io, Disagreement& d) {
  CONTACTCHECK_FIELDS(io, d, scene, frame, detector, level, kind);
  io("case", d.case_file);
}

template <typename Io>
void fields(Io& io, Goal& g) {
  CONTACTCHECK_FIELDS(io, g, goal, scene, detector, part);
  CONTACTCHECK_FIELDS(io.unless_empty, g, over, over_scene, per, at_least, at_most);
}

template <typename Io>
void fields(Io& io, MeasuredGoal& g) {
  fields(io, static_cast<Goal&>(g));
  io("measured", g.measured);
  CONTACTCHECK_FIELDS(io.unless_empty, g, low, high, unit, why);
  io("met", g.met);
}

template <typename Io>
void fields(Io& io, Plugin& p) {
  CONTACTCHECK_FIELDS(io, p, detector, kind, source, content, version);
  CONTACTCHECK_FIELDS(io.unless_empty, p, unisolated, transient);
}

template <typename Io>
void fields(Io& io, DefectCount& d) {
  CONTACTCHECK_FIELDS(io, d, library, version, where);
  io.unless_empty("upstream", d.upstream);
  CONTACTCHECK_FIELDS(io, d, kind, sentence, detectors, scenes, listed, shown, changed,
                      other_version);
}

template <typename Io>
void fields(Io& io, Sightings& s) {
  CONTACTCHECK_FIELDS(io, s, detector, scene, kind, values);
  CONTACTCHECK_FIELDS(io.unless_empty, s, was, is);
}

template <typename Io>
void fields(Io& io, DefectCounts& k) {
  CONTACTCHECK_FIELDS(io, k, defects, readings, changed, not_shown, unlisted);
}

template <typename Io>
void fields(Io& io, ScaleRange& r) {
  CONTACTCHECK_FIELDS(io, r, detector, by, library, version, level);
  CONTACTCHECK_FIELDS(io.unless_empty, r, from, to);
  CONTACTCHECK_FIELDS(io, r, least, most, right, cases);
  CONTACTCHECK_FIELDS(io.unless_empty, r, wrong_below, wrong_above);
}

template <typename Io>
void fields(Io& io, ShardScene& s) {
  CONTACTCHECK_FIELDS(io, s, id, detectors, references, content);
}

template <typename Io>
void fields(Io& io, Shard& s) {
  CONTACTCHECK_FIELDS(io, s, index, of, command, program);
  Json settings = Json::object();
  for (const auto& [name, value] : s.settings) settings[name] = Json::parse(value);
  io("settings", settings);
  if constexpr (Io::kReads)
    for (const auto& [name, value] : settings.items()) s.settings.emplace_back(name, value.dump());
  CONTACTCHECK_FIELDS(io, s, goals, scenes, files);
}

template <typename Io>
void fields(Io& io, Results& r) {
  CONTACTCHECK_FIELDS(io, r, version, command, machine, libraries);
  CONTACTCHECK_FIELDS(io.unless_empty, r, plugins, timing);
  CONTACTCHECK_FIELDS(io, r, scenes, runs, disagreements);
  CONTACTCHECK_FIELDS(io.unless_empty, r, known_defects, known_ranges, goals, resumed, identities,
                      shard, merged);
}

Results from_json(const nlohmann::ordered_json& json) {
  Results results;
  text::read_described(json, results);
  return results;
}

nlohmann::ordered_json to_json(const Semantics& semantics) { return text::described(semantics); }
nlohmann::ordered_json to_json(const Machine& machine) { return text::described(machine); }
nlohmann::ordered_json to_json(const Scene& scene) { return text::described(scene); }
nlohmann::ordered_json to_json(const ClosedLoop& loop) { return text::described(loop); }
nlohmann::ordered_json to_json(const ScaleRange& range) { return text::described(range); }

nlohmann::ordered_json to_json(const Results& results) {
  Json out = {{"schema", kSchema}};
  out.update(text::described(results));
  return out;
}

}  // namespace results
}  // namespace contactcheck
