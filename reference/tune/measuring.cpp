#include "reference/tune/measuring.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "core/types/check.h"
#include "reference/run/out_folder.h"
#include "reference/scene/any_scene.h"
#include "reference/tune/lattice_variant.h"
#include "reference/tune/space.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kOwnLattice = 1.0;

const Json* row_of(const Json& runs, const std::string& scene, const std::string& detector) {
  for (const Json& run : runs)
    if (run.at("scene") == scene && run.at("detector") == detector) return &run;
  return nullptr;
}

// The cold time per frame within a question; none where it was not timed.
std::optional<double> time_of(const Json& run, const std::string& question) {
  const auto in = [&](const Json& times) -> std::optional<double> {
    if (!times.is_object() || times.value("question", "") != question) return std::nullopt;
    return times.at("cold").at("frame").get<double>();
  };
  if (run.contains("time_ms"))
    if (const auto own = in(run.at("time_ms"))) return own;
  for (const Json& other : run.value("time_ms_other_questions", Json::array()))
    if (const auto time = in(other)) return time;
  return std::nullopt;
}

std::optional<double> ratio_to(const Json& run, const std::string& question,
                               const std::string& anchor) {
  const Json speedups = run.value("speedup", Json::object()).value(question, Json::object());
  if (!speedups.contains(anchor)) return std::nullopt;
  return speedups.at(anchor).at("cold").at("ratio").get<double>();
}

// Errors; the cost is still missing.
Measurement errors_of(const Json& run, const std::string& level) {
  Measurement m;
  if (run.at("status") != "ok") {
    m.failure = run.at("status").get<std::string>() + ": " + run.value("message", "");
    return m;
  }
  if (!run.at("levels").contains(level)) {
    m.failure = "not judged at level " + level;
    return m;
  }
  const Json& counts = run.at("levels").at(level);
  m.missed = counts.at("missed").get<std::uint64_t>();
  m.spurious = counts.at("spurious").get<std::uint64_t>();
  const Json& geometry = run.at("geometry");
  if (!geometry.at("hover_gap_max").is_null()) m.hover = geometry.at("hover_gap_max").get<double>();
  if (!geometry.at("late_frames").is_null()) m.late_frames = geometry.at("late_frames").get<long>();
  return m;
}

}  // namespace

Measuring::Measuring(const std::vector<Candidate>& candidates, MeasuringRequest request)
    : candidates_(candidates), request_(std::move(request)), anchor_(request_.anchor) {
  const Scene scene = load_any_scene(request_.scene_file, request_.settings.frames);
  scenes_[kOwnLattice] = request_.scene_file;
  ids_[kOwnLattice] = scene.id;
  deviations_[kOwnLattice] = 0.0;
  for (const Candidate& candidate : candidates_)
    if (!scenes_.contains(candidate.lattice)) prepare_variant(candidate.lattice);
}

void Measuring::prepare_variant(double lattice) {
  const std::size_t frames = request_.settings.frames;
  const Scene scene = load_any_scene(request_.scene_file, frames);
  if (!scene.scripted())
    throw InputError("scene " + scene.id +
                     " is not scripted: its lattices cannot be of another resolution");
  const auto file = write_lattice_variant(request_.scene_file, lattice, request_.work / "scenes");
  const Scene variant = load_any_scene(file, frames);
  scenes_[lattice] = file;
  ids_[lattice] = variant.id;
  deviations_[lattice] = deviation(scene, variant);
}

std::filesystem::path Measuring::scene_of(const Candidate& candidate) const {
  return scenes_.at(candidate.lattice);
}

SceneTask Measuring::task_of(double lattice, const std::vector<std::size_t>& batch) const {
  SceneTask task;
  task.id = ids_.at(lattice);
  task.file = scenes_.at(lattice);
  std::set<std::string> names;
  const auto add = [&](const std::string& name) {
    if (names.insert(name).second) task.detectors.push_back(name);
  };
  if (!anchor_.empty()) add(anchor_);
  for (const std::size_t i : batch)
    if (candidates_[i].lattice == lattice) add(candidates_[i].detector);
  // As long as none has answered, any of them may become what costs are taken against.
  task.references = anchor_ms_ > 0.0 ? std::vector<std::string>{anchor_} : task.detectors;
  task.frames = load_any_scene(task.file, request_.settings.frames).frames;
  return task;
}

std::vector<Measurement> Measuring::operator()(const std::vector<std::size_t>& batch) {
  SuiteRequest suite;
  std::set<double> lattices = {kOwnLattice};
  for (const std::size_t i : batch) lattices.insert(candidates_[i].lattice);
  for (const double lattice : lattices) {
    SceneTask task = task_of(lattice, batch);
    if (!task.detectors.empty()) suite.tasks.push_back(std::move(task));
  }
  const ScratchFolder scratch(request_.work);
  suite.settings = request_.settings;
  suite.out = scratch.path();
  suite.executable = request_.executable;
  suite.known_defects = request_.known_defects;
  SuiteOutcome outcome;
  const Json results = run_suite(suite, request_.listener, &outcome);
  const Json& runs = results.at("runs");
  if (!(anchor_ms_ > 0.0)) choose_anchor(runs, batch);
  std::vector<Measurement> found;
  for (const std::size_t i : batch) found.push_back(read(candidates_[i], runs));
  return found;
}

void Measuring::choose_anchor(const Json& runs, const std::vector<std::size_t>& batch) {
  std::vector<std::string> names;
  if (!anchor_.empty()) names.push_back(anchor_);
  for (const std::size_t i : batch)
    if (candidates_[i].lattice == kOwnLattice) names.push_back(candidates_[i].detector);
  for (const std::string& name : names) {
    const Json* run = row_of(runs, ids_.at(kOwnLattice), name);
    const auto time = run == nullptr ? std::nullopt : time_of(*run, name_of(request_.question));
    if (!time || run->at("status") != "ok" || !(*time > 0.0)) continue;
    anchor_ = name;
    anchor_ms_ = *time;
    return;
  }
}

Measurement Measuring::read(const Candidate& candidate, const Json& runs) const {
  const std::string question = name_of(request_.question);
  const std::string& scene = ids_.at(candidate.lattice);
  const Json* run = row_of(runs, scene, candidate.detector);
  CONTACTCHECK_INVARIANT(run != nullptr, "every detector that was asked for has a row");
  Measurement m = errors_of(*run, name_of(level_of(request_.question)));
  m.deviation = deviations_.at(candidate.lattice);
  if (!m.failure.empty()) return m;
  const Json* here = row_of(runs, scene, anchor_);
  const Json* own = row_of(runs, ids_.at(kOwnLattice), anchor_);
  const std::optional<double> ratio =
      candidate.detector == anchor_ ? 1.0 : ratio_to(*run, question, anchor_);
  const auto anchor_here = here == nullptr ? std::nullopt : time_of(*here, question);
  const auto anchor_own = own == nullptr ? std::nullopt : time_of(*own, question);
  if (!ratio || !anchor_here || !anchor_own) {
    m.failure = "not timed in the question " + question;
    return m;
  }
  m.cost_ms = *anchor_here / *ratio * (anchor_ms_ / *anchor_own);
  return m;
}

}  // namespace contactcheck
