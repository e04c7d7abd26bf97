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
  io("levels", s.levels);
  io("informative", s.informative);
  io("questions", s.questions);
  std::string body = s.solid ? "solid" : "surface", touching = s.closed ? "closed" : "open";
  io("body", body);
  io("touching", touching);
  if constexpr (Io::kReads) {
    s.solid = body == "solid";
    s.closed = touching == "closed";
  }
  io("exact", s.exact);
  io("margin", s.margin);
  io("precision", s.precision);
  io("scale", s.scale);
  io("depth_kind", s.depth);
  io("means", s.means);
  io.unless_empty("local_origin", s.local_origin);
  io.unless_empty("no_early_end", s.no_early_end);
}

namespace results {

using Json = nlohmann::ordered_json;

constexpr std::array<Status, 4> values_of(Status) {
  return {Status::kOk, Status::kError, Status::kAbsent, Status::kRefused};
}

template <typename Io>
void fields(Io& io, Machine& m) {
  io("cpu", m.cpu);
  io("cores", m.cores);
  io("isa", m.isa);
  io("os", m.os);
  io("compiler", m.compiler);
  io("build", m.build);
}

template <typename Io>
void fields(Io& io, LevelCounts& c) {
  io("truth", c.truth);
  io("reported", c.reported);
  io("hit", c.hit);
  io("missed", c.missed);
  io("spurious", c.spurious);
  io("recall", c.recall);
  io("spurious_rate", c.spurious_rate);
  io.unless_empty("margin", c.margin);
  io.unless_empty("informative", c.informative);
}

template <typename Io>
void fields(Io& io, PerFrame& f) {
  // No level is an empty text in the file.
  std::string level = f.level ? name_of(*f.level) : "";
  io("level", level);
  if constexpr (Io::kReads) f.level = level_from_name(level);
  io("truth", f.truth);
  io("missed", f.missed);
  io("spurious", f.spurious);
  io("covered_length_fraction", f.covered_length_fraction);
  io.unless_empty("frame_ms", f.frame_ms);
}

template <typename Io>
void fields(Io& io, HistogramBin& b) {
  io("from", b.from);
  io("below", b.below);
  io("count", b.count);
}

template <typename Io>
void fields(Io& io, Episode& e) {
  io("bodies", e.bodies);
  io("first_true", e.first_true);
  io("first_reported", e.first_reported);
  io("hover_gap", e.hover_gap);
  io("late_frames", e.late_frames);
}

template <typename Io>
void fields(Io& io, Geometry& g) {
  io("missed_length", g.missed_length);
  io("covered_length_fraction", g.covered_length_fraction);
  io("spurious_distance_max", g.spurious_distance_max);
  io("spurious_distance_histogram", g.spurious_distance_histogram);
  io("depth_kind", g.depth_kind);
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
  io("hover_gap_max", g.hover_gap_max);
  io("late_frames", g.late_frames);
  io("episodes", g.episodes);
}

template <typename Io>
void fields(Io& io, Stage& s) {
  io("name", s.name);
  io("unit", s.unit);
  io("in", s.in);
  io("out", s.out);
  io("missed", s.missed);
  io.unless_empty("visited", s.visited);
  io.unless_empty("visited_unit", s.visited_unit);
}

template <typename Io>
void fields(Io& io, PhaseTimes& t) {
  io("map", t.map);
  io("update", t.update);
  io("query", t.query);
  io("frame", t.frame);
  io("contact_frame", t.contact_frame);
  io.unless_empty("first_frame", t.first_frame);
  io.unless_empty("self_reported", t.self_reported);
  io("cpu", t.cpu);
  io.unless_empty("taken", t.taken);
}

template <typename Io>
void fields(Io& io, QuestionTimes& t) {
  io("question", t.question);
  io("timed_frames", t.timed_frames);
  io("timed_contact_frames", t.timed_contact_frames);
  io("passes", t.passes);
  io("playback", t.playback);
  io.unless_empty("pass_ms", t.pass_ms);
  io.unless_empty("cold", t.cold);
}

template <typename Io>
void fields(Io& io, Ratio& r) {
  io("ratio", r.value);
  io("low", r.low);
  io("high", r.high);
}

template <typename Io>
void fields(Io& io, Speedup& s) {
  io("playback", s.playback);
  io("cold", s.cold);
  io("contact_frames", s.contact_frames);
  io("without_map", s.without_map);
  io("passes", s.passes);
  std::string interval = interval_name(s.passes);
  io("interval", interval);
  io("reference_options", s.reference_options);
}

template <typename Io>
void fields(Io& io, Timing& t) {
  io("processes", t.processes);
  io("one_pass_beyond", t.one_pass_beyond);
  io("seed", t.seed);
  io("sweep_bytes", t.sweep_bytes);
}

template <typename Io>
void fields(Io& io, ClosedLoop& c) {
  io("error", c.error);
  if (!c.error.empty()) return;
  io("steps", c.steps);
  io("levels", c.levels);
  io("hover_at_rest_max", c.hover_at_rest_max);
  io("hover_at_rest_mean", c.hover_at_rest_mean);
  io("deepest_penetration", c.deepest_penetration);
  io("energy_gain", c.energy_gain);
  io("last_speed", c.last_speed);
  io("tunnelling_events", c.tunnelling_events);
}

template <typename Io>
void fields(Io& io, StepTimes& t) {
  io("steps", t.steps);
  io("repeats", t.repeats);
  io("mss", t.mss);
  io("cell", t.cell);
  io("test", t.test);
  io("response", t.response);
  io("total", t.total);
  io("test_by_repeat", t.test_by_repeat);
  io("total_by_repeat", t.total_by_repeat);
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
  io("scene", run.scene);
  io("detector", run.detector);
  io("status", run.status);
  io("message", run.message);
  io("frames", run.frames);
  io("contact_frames", run.contact_frames);
  io("semantics", run.semantics);
  io("options", run.options);
  io("recording", run.recording);
  io.unless_empty("failed_frame", run.failed_frame);
  if (!run.ok()) return;
  io("per_frame", run.per_frame);
  io("levels", run.levels);
  io.unless_empty("levels_rounded", run.levels_rounded);
  io("not_judged", run.not_judged);
  io("geometry", run.geometry);
  io("stages", run.stages);
  io.unless_empty("counters", run.counters);
  if constexpr (Io::kReads) {
    read_times(io.json(), run);
  } else {
    io("time_ms", times_json(run, 0));
  }
  io("memory_bytes", run.memory_bytes);
  io("prepared_bytes", run.prepared_bytes);
  io("contact_hash", run.contact_hash);
  io("float_environment", run.float_environment);
  io("notes", run.notes);
  io.unless_empty("closed_loop", run.closed_loop);
  io.unless_empty("step_ms", run.step_ms);
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
  io("name", b.name);
  io("source", b.source);
  io("notes", b.notes);
  io("vertices", b.vertices);
  io("triangles", b.triangles);
  io("cells", b.cells);
  io("solid", b.solid);
}

template <typename Io>
void fields(Io& io, Family& f) {
  io("parameter", f.parameter);
  io("values", f.values);
  io("origin", f.origin);
  io("stresses", f.stresses);
  io("true_pairs", f.true_pairs);
  io.unless_empty("range", f.range);
}

template <typename Io>
void fields(Io& io, Sweep& s) {
  io("separations", s.separations);
  io("orientations", s.orientations);
  io("seed", s.seed);
  io("tolerance", s.tolerance);
}

template <typename Io>
void fields(Io& io, LatticeFit& f) {
  io("body", f.body);
  io("rms", f.rms);
  io("max", f.max);
}

template <typename Io>
void fields(Io& io, PairKindTally& t) {
  io("pairs", t.pairs);
  io("touching", t.touching);
}

struct CheckedPairs {
  std::uint64_t &checked, &oracle_wrong;
};

template <typename Io>
void fields(Io& io, CheckedPairs& p) {
  io("checked", p.checked);
  io("oracle_wrong", p.oracle_wrong);
}

template <typename Io>
void fields(Io& io, RandomPairs& p) {
  io("count", p.count);
  io("seed", p.seed);
  io("touching", p.touching);
  io("per_kind", p.per_kind);
  CheckedPairs rational = {p.checked, p.oracle_wrong};
  io("rational", rational);
}

template <typename Io>
void fields(Io& io, Drawn& d) {
  io("seed", d.seed);
  io("number", d.number);
  io("redrawn", d.redrawn);
  io("happens", d.happens);
  io("parameters", d.parameters);
}

template <typename Io>
void fields(Io& io, Simulation& s) {
  io("driver", s.driver);
  io("step", s.step);
  io("every", s.every);
}

template <typename Io>
void fields(Io& io, SceneScale& s) {
  io("shortest_edge", s.shortest_edge);
  io("longest_edge", s.longest_edge);
  io("reach", s.reach);
}

template <typename Io>
void fields(Io& io, Scene& s) {
  io("id", s.id);
  io("title", s.title);
  io("frames", s.frames);
  io("time_step", s.time_step);
  io("size", s.size);
  io.unless_empty("scale", s.scale);
  io("contact_frames", s.contact_frames);
  io("truth", s.truth);
  io("truth_hash", s.truth_hash);
  io("bodies", s.bodies);
  io.unless_empty("separation", s.separation);
  io.unless_empty("cold_frames", s.cold_frames);
  io.unless_empty("family", s.family);
  io.unless_empty("sweep", s.sweep);
  io.unless_empty("fits", s.fits);
  io.unless_empty("pairs", s.pairs);
  io.unless_empty("drawn", s.drawn);
  io.unless_empty("simulation", s.simulation);
  io.unless_empty("unjudged", s.unjudged);
  io.unless_empty("contacts", s.contacts);
}

template <typename Io>
void fields(Io& io, Disagreement& d) {
  io("scene", d.scene);
  io("frame", d.frame);
  io("detector", d.detector);
  io("level", d.level);
  io("kind", d.kind);
  io("case", d.case_file);
}

template <typename Io>
void fields(Io& io, Goal& g) {
  io("goal", g.goal);
  io("scene", g.scene);
  io("detector", g.detector);
  io("part", g.part);
  io.unless_empty("over", g.over);
  io.unless_empty("over_scene", g.over_scene);
  io.unless_empty("per", g.per);
  io.unless_empty("at_least", g.at_least);
  io.unless_empty("at_most", g.at_most);
}

template <typename Io>
void fields(Io& io, MeasuredGoal& g) {
  fields(io, static_cast<Goal&>(g));
  io("measured", g.measured);
  io.unless_empty("low", g.low);
  io.unless_empty("high", g.high);
  io.unless_empty("unit", g.unit);
  io.unless_empty("why", g.why);
  io("met", g.met);
}

template <typename Io>
void fields(Io& io, Plugin& p) {
  io("detector", p.detector);
  io("kind", p.kind);
  io("source", p.source);
  io("content", p.content);
  io("version", p.version);
  io.unless_empty("unisolated", p.unisolated);
  io.unless_empty("transient", p.transient);
}

template <typename Io>
void fields(Io& io, DefectCount& d) {
  io("library", d.library);
  io("version", d.version);
  io("where", d.where);
  io.unless_empty("upstream", d.upstream);
  io("kind", d.kind);
  io("sentence", d.sentence);
  io("detectors", d.detectors);
  io("scenes", d.scenes);
  io("listed", d.listed);
  io("shown", d.shown);
  io("changed", d.changed);
  io("other_version", d.other_version);
}

template <typename Io>
void fields(Io& io, Sightings& s) {
  io("detector", s.detector);
  io("scene", s.scene);
  io("kind", s.kind);
  io("values", s.values);
  io.unless_empty("was", s.was);
  io.unless_empty("is", s.is);
}

template <typename Io>
void fields(Io& io, DefectCounts& k) {
  io("defects", k.defects);
  io("readings", k.readings);
  io("changed", k.changed);
  io("not_shown", k.not_shown);
  io("unlisted", k.unlisted);
}

template <typename Io>
void fields(Io& io, ScaleRange& r) {
  io("detector", r.detector);
  io("by", r.by);
  io("library", r.library);
  io("version", r.version);
  io("level", r.level);
  io.unless_empty("from", r.from);
  io.unless_empty("to", r.to);
  io("least", r.least);
  io("most", r.most);
  io("right", r.right);
  io("cases", r.cases);
  io.unless_empty("wrong_below", r.wrong_below);
  io.unless_empty("wrong_above", r.wrong_above);
}

template <typename Io>
void fields(Io& io, ShardScene& s) {
  io("id", s.id);
  io("detectors", s.detectors);
  io("references", s.references);
  io("content", s.content);
}

template <typename Io>
void fields(Io& io, Shard& s) {
  io("index", s.index);
  io("of", s.of);
  io("command", s.command);
  io("program", s.program);
  Json settings = Json::object();
  for (const auto& [name, value] : s.settings) settings[name] = Json::parse(value);
  io("settings", settings);
  if constexpr (Io::kReads)
    for (const auto& [name, value] : settings.items()) s.settings.emplace_back(name, value.dump());
  io("goals", s.goals);
  io("scenes", s.scenes);
  io("files", s.files);
}

template <typename Io>
void fields(Io& io, Finding& f) {
  io("title", f.title);
  io("first", f.first);
}

template <typename Io>
void fields(Io& io, Results& r) {
  io("version", r.version);
  io("command", r.command);
  io("machine", r.machine);
  io("libraries", r.libraries);
  io.unless_empty("plugins", r.plugins);
  io.unless_empty("timing", r.timing);
  io("scenes", r.scenes);
  io("runs", r.runs);
  io("disagreements", r.disagreements);
  io.unless_empty("known_defects", r.known_defects);
  io.unless_empty("known_ranges", r.known_ranges);
  io.unless_empty("goals", r.goals);
  io.unless_empty("resumed", r.resumed);
  io.unless_empty("shard", r.shard);
  io.unless_empty("merged", r.merged);
  io.unless_empty("finding", r.finding);
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
