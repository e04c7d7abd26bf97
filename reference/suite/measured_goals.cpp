#include "reference/suite/measured_goals.h"

#include <optional>
#include <stdexcept>
#include <string>

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
  const Run& reference = run_of(results, goal.scene, goal.over);
  const Run& run = run_of(results, goal.scene, goal.detector);
  times_of(run);  // or it says that nothing was timed
  const Question question = *results::goal_question(run, reference);
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

}  // namespace contactcheck::suite
