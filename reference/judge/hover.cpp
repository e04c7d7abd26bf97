#include "reference/judge/hover.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "reference/judge/answer_check.h"
#include "reference/judge/episodes.h"
#include "reference/judge/run_notes.h"

namespace contactcheck::judge {
namespace {

// Does the detector report the pair at a time between frames?
class PairProbe {
 public:
  /// `enter` is told every phase before it begins.
  PairProbe(JudgingTools& tools, Detector& detector, BodyPair pair,
            std::function<void(process::Phase)> enter)
      : scene_(*tools.judged.scene),
        detector_(detector),
        oracle_(tools.oracle),
        pair_(pair),
        enter_(std::move(enter)) {}

  bool reports(double time) {
    go_to(time);
    enter_(process::Phase::kUpdate);
    detector_.update(frame_);
    enter_(process::Phase::kQuery);
    ContactSet contacts;
    ask(detector_, detector_.semantics().questions.front(), scene_, 0, contacts);
    return std::binary_search(contacts.bodies.begin(), contacts.bodies.end(), pair_);
  }
  double distance(double time) {
    enter_(process::Phase::kTruth);
    go_to(time);
    return oracle_.distance(frame_, pair_).upper;
  }

 private:
  void go_to(double time) {
    if (time == time_) return;
    time_ = time;
    nodes_ = scene_.nodes_at(time);
    vertices_ = scene::map_bodies(scene_, nodes_);
    frame_ = make_frame(0, time, nodes_, vertices_);
  }

  const scene::Scene& scene_;
  Detector& detector_;
  oracle::Oracle& oracle_;
  BodyPair pair_;
  std::function<void(process::Phase)> enter_;
  double time_ = std::nan("");
  std::vector<std::vector<Vec3>> nodes_, vertices_;
  Frame frame_;
};

// The true first contact of a pair between two frames, found by the oracle alone and kept: it is
// the same for all detectors.
ContactMoment true_moment(JudgingTools& tools, PairProbe& probe, const results::Episode& e,
                          double tolerance) {
  const std::size_t f = *e.first_true;
  const auto [entry, is_new] = tools.true_contacts.try_emplace({e.bodies, f});
  ContactMoment& moment = entry->second;
  if (!is_new) return moment;
  moment = {tools.judged.scene->time_of(f - 1), tools.judged.scene->time_of(f)};
  constexpr int kMost = 60;  // exhausts the doubles between two frames
  double gap = probe.distance(moment.before);
  for (int i = 0; i < kMost && gap >= tolerance; ++i) {
    const double middle = 0.5 * (moment.before + moment.after);
    const double distance = probe.distance(middle);
    (distance > 0.0 ? moment.before : moment.after) = middle;
    if (distance > 0.0) gap = distance;
  }
  return moment;
}

// Silent until the surfaces are nearer than the tolerance, and not after they touch: no gap, by two
// questions in place of a search. A search would have to ask a slow detector twenty times.
bool reports_at_true_moment(JudgingTools& tools, PairProbe& probe, const results::Episode& e,
                            double tolerance) {
  if (e.first_true != e.first_reported) return false;
  const ContactMoment moment = true_moment(tools, probe, e, tolerance);
  return probe.distance(moment.before) < tolerance && !probe.reports(moment.before) &&
         probe.reports(moment.after);
}

}  // namespace

void measure_hover_gaps(JudgingTools& tools, std::uint32_t position, Detector& detector,
                        process::ProgressWriter& progress, results::Run& run) {
  const scene::Scene& scene = *tools.judged.scene;
  const double tolerance = 1e-6 * scene.size();
  const process::FloatEnvironmentGuard guard;
  for (results::Episode& e : run.geometry.episodes) {
    if (!e.first_reported) continue;
    const std::size_t f = *e.first_reported;
    const auto enter = [&progress, position, f](process::Phase phase) {
      progress.enter(
          phase == process::Phase::kTruth ? process::SharedProgress::kNoDetector : position, f,
          phase);
    };
    if (!scene.bisects_time() || f == 0) {
      enter(process::Phase::kTruth);
      const std::vector<BodyPair> in_contact =
          true_body_pairs(run.semantics.solid, tools.judged.truth[f]);
      const bool touching = std::binary_search(in_contact.begin(), in_contact.end(), e.bodies);
      e.hover_gap = touching ? 0.0 : tools.oracle.distance(tools.judged.frame(f), e.bodies).upper;
      continue;
    }
    PairProbe probe(tools, detector, e.bodies, enter);
    const bool no_gap = reports_at_true_moment(tools, probe, e, tolerance);
    note_environment(guard, "query", run);
    if (no_gap) {
      e.hover_gap = 0.0;
      continue;
    }
    e.hover_gap = bisect_hover_gap(
        scene.time_of(f - 1), scene.time_of(f), tolerance,
        [&](double t) {
          const bool reported = probe.reports(t);
          note_environment(guard, "query", run);
          return reported;
        },
        [&](double t) { return probe.distance(t); });
  }
  sum_up_episodes(run.geometry);
}

}  // namespace contactcheck::judge
