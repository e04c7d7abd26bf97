#include "reference/compare/run_result_json.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "reference/compare/nullable.h"
#include "reference/compare/semantics_json.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const LevelCounts& c) {
  return {{"truth", c.truth},
          {"reported", c.reported},
          {"hit", c.hit},
          {"missed", c.missed},
          {"spurious", c.spurious},
          {"recall", nullable(c.recall())},
          {"spurious_rate", nullable(c.spurious_rate())}};
}

Json to_json(const PhaseTimes& t) {
  Json out = {{"map", nullable(t.map)},
              {"update", t.update},
              {"query", t.query},
              {"frame", t.frame},
              {"contact_frame", nullable(t.contact_frame)}};
  if (t.self_reported) out["self_reported"] = *t.self_reported;
  return out;
}

Json to_json(const QuestionTimes& t, double prepare_ms) {
  return {{"prepare", prepare_ms},          {"question", name_of(t.question)},
          {"timed_frames", t.timed_frames}, {"timed_contact_frames", t.timed_contact_frames},
          {"repeats", t.repeats},           {"cold", to_json(t.cold)},
          {"hot", to_json(t.hot)}};
}

Json to_json(const Ratio& r) { return {{"ratio", r.value}, {"low", r.low}, {"high", r.high}}; }

Json to_json(const std::optional<Ratio>& r) { return r ? to_json(*r) : Json(nullptr); }

Json to_json(const Speedup& s) {
  return {{"cold", to_json(s.cold)},
          {"hot", to_json(s.hot)},
          {"contact_frames", to_json(s.contact_frames)},
          {"without_map", to_json(s.without_map)}};
}

Json episode_json(const Episode& e) {
  return {{"bodies", {e.bodies.a, e.bodies.b}},
          {"first_true", nullable(e.first_true)},
          {"first_reported", nullable(e.first_reported)},
          {"hover_gap", nullable(e.hover_gap)},
          {"late_frames", nullable(e.late_frames)}};
}

Json histogram_json(const std::vector<HistogramBin>& bins) {
  Json out = Json::array();
  for (const HistogramBin& bin : bins)
    out.push_back({{"from", bin.from}, {"below", bin.below}, {"count", bin.count}});
  return out;
}

Json geometry_json(const RunResult& run) {
  Json episodes = Json::array();
  for (const Episode& e : run.episodes) episodes.push_back(episode_json(e));
  const GradedErrors& g = run.graded;
  return {{"missed_length", nullable(g.missed_length)},
          {"covered_length_fraction", nullable(g.covered_length_fraction)},
          {"spurious_distance_max", nullable(g.spurious_distance_max)},
          {"spurious_distance_histogram", histogram_json(g.spurious_distances)},
          {"depth_kind", name_of(run.semantics.depth)},
          {"depth_judged", g.depth.judged},
          {"depth_error_max", nullable(g.depth.max)},
          {"depth_error_mean", nullable(g.depth.mean)},
          {"depth_error_p95", nullable(g.depth.p95)},
          {"depth_error_histogram", histogram_json(g.depth.histogram)},
          {"normal_judged", g.normal_deg.judged},
          {"normal_error_deg_max", nullable(g.normal_deg.max)},
          {"normal_error_deg_mean", nullable(g.normal_deg.mean)},
          {"normal_error_deg_p95", nullable(g.normal_deg.p95)},
          {"normal_error_deg_histogram", histogram_json(g.normal_deg.histogram)},
          {"hover_gap_max", nullable(run.hover_gap_max())},
          {"late_frames", nullable(run.late_frames_worst())},
          {"episodes", episodes}};
}

Json stages_json(const RunResult& run) {
  Json out = Json::array();
  for (const StageResult& s : run.stages) {
    out.push_back(
        {{"name", s.name}, {"unit", s.unit}, {"in", s.in}, {"out", s.out}, {"missed", s.missed}});
    if (s.visited_unit.empty()) continue;
    out.back()["visited"] = s.visited;
    out.back()["visited_unit"] = s.visited_unit;
  }
  return out;
}

Json counters_json(const std::vector<Count>& counters) {
  Json out = Json::object();
  for (const Count& count : counters) out[count.name] = count.value;
  return out;
}

Json per_frame_json(const PerFrame& f) {
  Json covered = Json::array();
  for (const auto& share : f.covered_length_fraction) covered.push_back(nullable(share));
  return {{"level", f.level},
          {"truth", f.truth},
          {"missed", f.missed},
          {"spurious", f.spurious},
          {"covered_length_fraction", covered}};
}

}  // namespace

Json levels_to_json(const std::map<Level, LevelCounts>& levels, const Semantics& semantics) {
  Json out = Json::object();
  for (const auto& [level, counts] : levels) {
    Json& entry = out[name_of(level)] = to_json(counts);
    if (level == Level::kNear) entry["margin"] = semantics.margin;
    if (!semantics.claims(level)) entry["informative"] = true;
  }
  return out;
}

std::string hex(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(value));
  return text;
}

Json to_json(const Disagreement& d) {
  return {{"scene", d.scene}, {"frame", d.frame}, {"detector", d.detector},
          {"level", d.level}, {"kind", d.kind},   {"case", d.case_file}};
}

Json to_json(const RunResult& run) {
  Json out = {{"scene", run.scene},
              {"detector", run.detector},
              {"status", name_of(run.status)},
              {"message", run.message},
              {"frames", run.frames},
              {"contact_frames", run.contact_frames},
              {"semantics", to_json(run.semantics)},
              {"options", run.options},
              {"recording", run.recording}};
  if (run.failed_frame) out["failed_frame"] = *run.failed_frame;
  if (run.status != RunStatus::kOk) return out;
  out["per_frame"] = per_frame_json(run.per_frame);
  out["levels"] = levels_to_json(run.levels, run.semantics);
  if (!run.levels_rounded.empty())
    out["levels_rounded"] = levels_to_json(run.levels_rounded, run.semantics);
  Json not_judged = Json::object();
  for (const auto& [level, why] : run.not_judged) not_judged[name_of(level)] = why;
  out["not_judged"] = not_judged;
  out["geometry"] = geometry_json(run);
  out["stages"] = stages_json(run);
  if (!run.counters.empty()) out["counters"] = counters_json(run.counters);
  out["time_ms"] = {{"prepare", run.prepare_ms}};
  out["memory_bytes"] = run.memory_bytes;
  out["contact_hash"] = hex(run.contact_hash);
  out["float_environment"] = run.float_environment;
  out["notes"] = run.notes;
  return out;
}

void add_times(const RunTimes& times, Json& run) {
  if (times.questions.empty()) return;
  const Json prepare = run.at("time_ms").at("prepare");
  run["time_ms"] = to_json(times.questions.front(), prepare);
  Json others = Json::array();
  for (std::size_t i = 1; i < times.questions.size(); ++i)
    others.push_back(to_json(times.questions[i], prepare));
  run["time_ms_other_questions"] = others;
  Json frame_ms = Json::array();
  for (std::size_t f = 0; f < run.at("frames").get<std::size_t>(); ++f) {
    const auto it = times.cold_frame_ms.find(f);
    frame_ms.push_back(it == times.cold_frame_ms.end() ? Json(nullptr) : Json(it->second));
  }
  run["per_frame"]["frame_ms"] = frame_ms;
  Json speedup = Json::object();
  for (const auto& [question, references] : times.speedups)
    for (const auto& [reference, s] : references)
      speedup[name_of(question)][reference] = to_json(s);
  run["speedup"] = speedup;
}

}  // namespace contactcheck
