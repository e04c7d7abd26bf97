#include "reference/results/results.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <set>

#include "core/types/check.h"
#include "reference/scene/amount.h"

namespace contactcheck::results {

namespace {

std::optional<double> rate(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> members_of(const Machine& m) {
  return {{"cpu", m.cpu}, {"cores", std::to_string(m.cores)}, {"isa", m.isa},
          {"os", m.os},   {"compiler", m.compiler},           {"build", m.build}};
}

LevelCounts& LevelCounts::operator+=(const LevelCounts& other) {
  truth += other.truth;
  reported += other.reported;
  hit += other.hit;
  missed += other.missed;
  spurious += other.spurious;
  if (other.within) {
    if (!within) within.emplace();
    within->near += other.within->near;
    within->undecided += other.within->undecided;
    within->near_max = std::max(within->near_max, other.within->near_max);
    within->near_of_start_max =
        std::max(within->near_of_start_max, other.within->near_of_start_max);
  }
  return *this;
}

void LevelCounts::set_rates() {
  recall = rate(hit, truth);
  spurious_rate = rate(spurious, reported);
}

double parameter_number(const std::string& value) {
  const std::optional<double> number = scene::parse_double(value);
  if (!number) throw InputError("the parameter's value \"" + value + "\" is no number");
  return *number;
}

std::string hex(std::uint64_t hash) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(hash));
  return text;
}

const char* name_of(Status status) {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kError:
      return "error";
    case Status::kAbsent:
      return "absent";
    case Status::kRefused:
      return "refused";
  }
  return "unknown";
}

const Plugin* Results::plugin_of(const std::string& detector) const {
  const auto found =
      std::ranges::find(plugins, detector.substr(0, detector.find(':')), &Plugin::detector);
  return found == plugins.end() ? nullptr : &*found;
}

std::optional<Question> goal_question(const Run& run, const Run& reference) {
  if (run.times.empty()) return {};
  for (const QuestionTimes& times : run.times)
    if (!reference.times.empty() && times.question == reference.times.front().question)
      return times.question;
  return run.times.front().question;
}

Index::Index(const Results& results) : results_(&results) {
  for (const Scene& scene : results.scenes) scenes_.emplace(scene.id, &scene);
  std::set<std::string> seen;
  for (const Run& run : results.runs) {
    runs_[run.scene].push_back(&run);
    run_.emplace(std::pair(run.scene, run.detector), &run);
    if (seen.insert(run.detector).second) detectors_.push_back(run.detector);
  }
}

const Scene* Index::scene(const std::string& id) const {
  const auto it = scenes_.find(id);
  return it == scenes_.end() ? nullptr : it->second;
}

const Run* Index::run(const std::string& scene, const std::string& detector) const {
  const auto it = run_.find({scene, detector});
  return it == run_.end() ? nullptr : it->second;
}

const Run* Index::ok_run(const std::string& scene, const std::string& detector) const {
  const Run* found = run(scene, detector);
  return found != nullptr && found->ok() ? found : nullptr;
}

const std::vector<const Run*>& Index::runs_of(const std::string& scene) const {
  static const std::vector<const Run*> none;
  const auto it = runs_.find(scene);
  return it == runs_.end() ? none : it->second;
}

NamedErrors errors_of(const Run& run) {
  const Geometry& g = run.geometry;
  const Impacts i = run.impacts.value_or(Impacts{});
  std::optional<double> tunnelled;
  if (run.impacts)
    tunnelled = std::accumulate(
        i.tunnelled.begin(), i.tunnelled.end(), 0.0,
        [](double sum, std::uint64_t pairs) { return sum + static_cast<double>(pairs); });
  return {{"covered_length_fraction", g.covered_length_fraction},
          {"depth_error_max", g.depth.max},
          {"depth_error_mean", g.depth.mean},
          {"depth_error_p95", g.depth.p95},
          {"early_max", i.early_max},
          {"hover_gap_max", g.hover_gap_max},
          {"late_frames", g.late_frames},
          {"late_max", i.late_max},
          {"missed_length", g.missed_length},
          {"new_missed", i.new_missed},
          {"normal_error_deg_max", g.normal_deg.max},
          {"normal_error_deg_mean", g.normal_deg.mean},
          {"normal_error_deg_p95", g.normal_deg.p95},
          {"spurious_distance_max", g.spurious_distance_max},
          {"tunnelled", tunnelled}};
}

}  // namespace contactcheck::results
