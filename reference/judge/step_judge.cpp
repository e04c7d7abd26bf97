#include "reference/judge/step_judge.h"

#include <algorithm>
#include <limits>

namespace contactcheck::judge {
namespace {

// Pairs of bodies whose surfaces meet within a step, and at neither end.
std::vector<BodyPair> passing_pairs(const JudgedScene& judged, std::size_t step) {
  std::vector<BodyPair> out;
  for (const oracle::FirstImpact& first : judged.steps[step].first)
    if (!holds(judged.truth[step].surface.bodies, first.bodies) &&
        !holds(judged.truth[step + 1].surface.bodies, first.bodies))
      out.push_back(first.bodies);
  return out;
}

// Pairs of triangles that meet within a step and do not touch at its start.
std::vector<ElementPair> new_triangles(const JudgedScene& judged, std::size_t step) {
  std::vector<ElementPair> out;
  const std::vector<ElementPair>& all = judged.steps[step].contacts.impact_triangles;
  const std::vector<ElementPair>& before = judged.truth[step].surface.triangles;
  std::set_difference(all.begin(), all.end(), before.begin(), before.end(),
                      std::back_inserter(out));
  return out;
}

}  // namespace

LevelComparison compare_step_at(Level level, const ContactSet& truth, const ContactSet& reported) {
  switch (level) {
    case Level::kImpactVf:
      return compare_lists(truth.impact_vertices, reported.impact_vertices);
    case Level::kImpactEe:
      return compare_lists(truth.impact_edges, reported.impact_edges);
    case Level::kImpactTriangle:
      return compare_lists(truth.impact_triangles, reported.impact_triangles);
    case Level::kImpactSelfVf:
      return compare_lists(truth.self_impact_vertices, reported.self_impact_vertices);
    case Level::kImpactSelfEe:
      return compare_lists(truth.self_impact_edges, reported.self_impact_edges);
    default:
      return compare_lists(truth.impacts, reported.impacts);
  }
}

results::SceneImpacts scene_impacts(const JudgedScene& judged) {
  results::SceneImpacts out;
  std::vector<double> edges;
  for (const Body& body : judged.scene->bodies) edges.push_back(mean_edge(*body.shape));
  for (std::size_t k = 0; k < judged.steps.size(); ++k) {
    const Step step = judged.step(k);
    double& motion = out.motion.emplace_back(0.0);
    for (std::size_t b = 0; b < edges.size(); ++b)
      for (std::size_t v = 0; v < step.start.bodies[b].vertices.size() && edges[b] > 0.0; ++v)
        motion = std::max(
            motion,
            (step.end.bodies[b].vertices[v] - step.start.bodies[b].vertices[v]).stableNorm() /
                edges[b]);
    // The difference of two coordinates, or its share of a small edge, may be no double.
    motion = std::min(motion, std::numeric_limits<double>::max());
    std::uint64_t &starting = out.starting.emplace_back(0), &meeting = out.meeting.emplace_back(0);
    for (const oracle::FirstImpact& first : judged.steps[k].first)
      ++(first.starts_in_contact ? starting : meeting);
    out.passing.push_back(passing_pairs(judged, k).size());
    for (const ElementPair& pair : new_triangles(judged, k)) {
      ++out.new_triangles;
      if (!holds(judged.truth[k + 1].surface.triangles, pair)) ++out.passing_triangles;
    }
  }
  return out;
}

StepSums::StepSums(const JudgedScene& judged, const Semantics& semantics)
    : judged_(judged),
      of_steps_(semantics.claims(Level::kImpact)),
      of_triangles_(semantics.claims(Level::kImpactTriangle)),
      tolerance_(semantics.tolerance) {
  if (of_triangles_) sums.new_triangles = sums.new_missed = 0;
  if (tolerance_.absolute > 0.0 || tolerance_.of_start > 0.0)
    distances_.emplace(judged.scene->bodies);
}

void StepSums::begin(std::size_t step, const ContactSet& answer) {
  step_ = step;
  if (distances_) distances_->set_step(judged_.step(step));
  if (of_steps_) add_times(judged_.steps[step], answer);
}

LevelComparison StepSums::compare(Level level, const ContactSet& answer) {
  LevelComparison out = compare_step_at(level, judged_.steps[step_].contacts, answer);
  if (!distances_) return out;
  results::NearReports& within = out.counts.within.emplace();
  std::erase_if(out.spurious, [&](const ElementPair& pair) {
    const oracle::StepNearness found = distances_->nearness(level, pair, tolerance_);
    if (found.verdict == oracle::NearVerdict::kSpurious) return false;
    if (found.verdict == oracle::NearVerdict::kUndecided) {
      ++within.undecided;
      return true;
    }
    ++within.near;
    within.near_max = std::max(within.near_max, found.distance);
    within.near_of_start_max = std::max(within.near_of_start_max, found.of_start);
    return true;
  });
  out.counts.spurious = out.spurious.size();
  return out;
}

void StepSums::add(std::size_t step, const std::vector<BodyPair>& at_start,
                   const std::vector<BodyPair>& at_end, const ContactSet& answer) {
  std::vector<BodyPair> within;
  for (const BodyImpact& impact : answer.impacts) within.push_back(impact.bodies);
  std::uint64_t& tunnelled = sums.tunnelled.emplace_back(0);
  for (const BodyPair& pair : passing_pairs(judged_, step)) {
    const bool seen =
        of_steps_ ? holds(within, pair) : holds(at_start, pair) || holds(at_end, pair);
    tunnelled += seen ? 0 : 1;
  }
  if (!of_triangles_) return;
  for (const ElementPair& pair : new_triangles(judged_, step)) {
    ++*sums.new_triangles;
    if (!holds(answer.impact_triangles, pair)) ++*sums.new_missed;
  }
}

// Only pairs that truly meet have a time to be judged by.
void StepSums::add_times(const oracle::StepTruth& truth, const ContactSet& answer) {
  auto reported = answer.impacts.begin();
  for (const oracle::FirstImpact& first : truth.first) {
    while (reported != answer.impacts.end() && reported->bodies < first.bodies) ++reported;
    if (reported == answer.impacts.end() || reported->bodies != first.bodies || !reported->time)
      continue;
    const double time = *reported->time;
    if (time == 0.0 && !first.starts_in_contact && tolerance_.absolute > 0.0 &&
        distances_->near_at_start(first.bodies, tolerance_.absolute) ==
            oracle::NearVerdict::kNear) {
      ++sums.near_at_start;
      continue;
    }
    ++sums.timed;
    sums.early_max = std::max(sums.early_max.value_or(0.0), first.earliest - time);
    sums.late_max = std::max(sums.late_max.value_or(0.0), time - first.latest);
  }
}

}  // namespace contactcheck::judge
