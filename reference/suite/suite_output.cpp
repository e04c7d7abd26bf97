#include "reference/suite/suite_output.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "core/deform/atomic_file.h"
#include "reference/judge/contacts_json.h"
#include "reference/results/defect_comparison.h"
#include "reference/results/results_json.h"
#include "reference/results/scale_ranges.h"
#include "reference/suite/out_folder.h"
#include "reference/suite/shard_record.h"
#include "reference/timing/speedup.h"

namespace contactcheck::suite {
namespace {

using results::Index, results::MeasuredGoal, results::Run;

/// Why a goal could not be measured, for the report.
class NotMeasured : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

const Run& run_of(const Index& results, const std::string& scene, const std::string& detector) {
  const Run* run = results.run(scene, detector);
  if (run == nullptr) throw NotMeasured(detector + " did not run in " + scene);
  if (!run->ok()) throw NotMeasured(detector + ": " + run->message);
  return *run;
}

const results::QuestionTimes& times_of(const Run& run) {
  if (run.times.empty()) throw NotMeasured("nothing was timed");
  return run.times.front();
}

template <typename T>
const T& timed_with_contact(const std::optional<T>& time) {
  if (!time) throw NotMeasured("no frame with contact was timed");
  return *time;
}

template <typename T>
const T& timed_cold(const std::optional<T>& time) {
  if (!time) throw NotMeasured("it was not timed cold");
  return *time;
}

const results::PhaseTimes& phases_of(const Run& run, const std::string& part) {
  const results::QuestionTimes& times = times_of(run);
  return part == "cold" ? timed_cold(times.cold) : times.playback;
}

double frame_ms(const Run& run, const std::string& part) {
  const results::PhaseTimes& phases = phases_of(run, part);
  return part == "contact_frames" ? timed_with_contact(phases.contact_frame) : phases.frame;
}

void measure_over(const Index& results, MeasuredGoal& goal) {
  run_of(results, goal.scene, goal.over);  // who did not run is named
  const Run& run = run_of(results, goal.scene, goal.detector);
  const Question question = times_of(run).question;
  const auto by_reference = run.speedup.find(question);
  if (by_reference == run.speedup.end() || !by_reference->second.contains(goal.over))
    throw NotMeasured(goal.over + " does not answer the question " + name_of(question));
  const results::Speedup& speedup = by_reference->second.at(goal.over);
  const results::Ratio ratio = goal.part == "contact_frames"
                                   ? timed_with_contact(speedup.contact_frames)
                               : goal.part == "cold" ? timed_cold(speedup.cold)
                                                     : speedup.playback;
  goal.measured = ratio.value;
  goal.low = ratio.low;
  goal.high = ratio.high;
  goal.unit = "x";
}

void measure_over_scene(const Index& results, MeasuredGoal& goal) {
  const double here = frame_ms(run_of(results, goal.scene, goal.detector), goal.part);
  const double there = frame_ms(run_of(results, goal.over_scene, goal.detector), goal.part);
  goal.measured = here / there;
  goal.unit = "x";
}

// The frames that the times of this part are of.
std::vector<std::size_t> frames_of(const Index& results, const Run& run, const std::string& part) {
  const results::Scene* const scene = results.scene(run.scene);
  if (part == "cold") return scene == nullptr ? std::vector<std::size_t>{} : scene->cold_frames;
  return timing::played_frames(run.per_frame.truth.size());
}

// Time and pairs are means over the same frames with contact.
void measure_per_pair(const Index& results, MeasuredGoal& goal) {
  const Run& run = run_of(results, goal.scene, goal.detector);
  const double ms = timed_with_contact(phases_of(run, goal.part).contact_frame);
  if (run.per_frame.level != Level::kTriangle)
    throw NotMeasured("its contacts were not judged as pairs of triangles");
  double pairs = 0.0, contact_frames = 0.0;
  for (const std::size_t frame : frames_of(results, run, goal.part)) {
    const std::uint64_t truth = run.per_frame.truth.at(frame);
    pairs += static_cast<double>(truth);
    contact_frames += truth > 0;
  }
  if (pairs == 0.0) throw NotMeasured("no frame with contact was timed");
  goal.measured = 1e3 * ms * contact_frames / pairs;
  goal.unit = "us";
}

void measure(const Index& results, MeasuredGoal& goal) {
  if (!goal.over.empty()) return measure_over(results, goal);
  if (!goal.over_scene.empty()) return measure_over_scene(results, goal);
  measure_per_pair(results, goal);
}

}  // namespace

std::vector<MeasuredGoal> measure_goals(const std::vector<results::Goal>& goals,
                                        const results::Results& results) {
  const Index index(results);
  std::vector<MeasuredGoal> out;
  for (const results::Goal& goal : goals) {
    MeasuredGoal& entry = out.emplace_back(MeasuredGoal{goal, {}, {}, {}, {}, {}, {}});
    try {
      if (!goal.at_least && !goal.at_most) throw NotMeasured("it has no bound");
      measure(index, entry);
      entry.met =
          goal.at_least ? *entry.measured >= *goal.at_least : *entry.measured <= *goal.at_most;
    } catch (const NotMeasured& e) {
      entry.why = e.what();
    }
  }
  return out;
}

namespace {

namespace fs = std::filesystem;
using results::Results;

// The list is about the families beside it: of others, as a minimal case, the rows say it all. An
// error of a detector from outside is its own matter, which its row tells.
void add_known_defects(const results::KnownDefects& known, Results& results,
                       SuiteOutcome* outcome) {
  const results::DefectComparison comparison = results::compare_defects(
      known, results::sightings_of(results), results::versions_in(results));
  const std::vector<results::Scene>& scenes = results.scenes;
  const bool any_unjudged =
      std::any_of(scenes.begin(), scenes.end(), [](const auto& s) { return !s.unjudged.empty(); });
  const bool any_listed = std::any_of(scenes.begin(), scenes.end(), [&](const auto& s) {
    return s.family.has_value() && known.families.contains(s.id);
  });
  const bool own_error =
      std::any_of(comparison.unlisted.begin(), comparison.unlisted.end(), [&](const auto& entry) {
        const results::Sighting& s = entry.first;
        return s.kind == results::SightingKind::kError && results.plugin_of(s.detector) == nullptr;
      });
  outcome->unlisted_error = results::any_unlisted_error(comparison) || any_unjudged;
  if (any_listed || own_error) results.known_defects = results::in_results(known, comparison);
}

template <typename T>
void append(std::vector<T> from, std::vector<T>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

}  // namespace

SuiteOutput::SuiteOutput(fs::path out, fs::path scratch)
    : out_(std::move(out)), scratch_(std::move(scratch)) {}

void SuiteOutput::add(FinishedScene scene) {
  if (!scene.contacts.empty())
    write_file_atomically(scratch_ / judge::contacts_path(scene.scene.id), scene.contacts);
  scenes_.push_back(std::move(scene.scene));
  append(std::move(scene.runs), runs_);
  append(std::move(scene.disagreements), disagreements_);
}

Results SuiteOutput::write(Results results, const std::vector<results::Goal>& goals,
                           const results::KnownDefects& known_defects, SuiteOutcome* outcome) {
  results.scenes = std::move(scenes_);
  results.runs = std::move(runs_);
  results.disagreements = std::move(disagreements_);
  outcome->oracle_wrong = 0;
  const std::vector<fs::path> cases = number_cases(results.disagreements);
  for (const results::Scene& scene : results.scenes)
    if (scene.pairs) outcome->oracle_wrong += scene.pairs->oracle_wrong;
  add_known_defects(known_defects, results, outcome);
  results.known_ranges = results::ranges_of_run(known_defects.ranges, results);
  // A shard's goals would miss the scenes of the others.
  if (!results.shard) {
    results.goals = measure_goals(goals, results);
  } else {
    NamedFiles files;
    for (const results::Scene& scene : results.scenes)
      if (!scene.contacts.empty()) files[scene.contacts] = scratch_ / scene.contacts;
    for (const results::Run& run : results.runs)
      if (!run.recording.empty()) files[run.recording] = out_ / run.recording;
    for (std::size_t i = 0; i < cases.size(); ++i)
      files[results.disagreements[i].case_file] = cases[i];
    results.shard->files = file_hashes(files);
  }
  // All is on disk before anything of an earlier run goes: from here on there are only renames.
  write_file_atomically(scratch_ / "results.json", results::to_json(results).dump(1) + "\n");
  remove_old_cases(out_);
  move_cases(out_, cases);
  move_contacts(out_, scratch_, results.scenes);
  rename_file(scratch_ / "results.json", out_ / "results.json");
  return results;
}

}  // namespace contactcheck::suite
