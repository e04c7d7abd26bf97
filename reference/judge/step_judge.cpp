#include "reference/judge/step_judge.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "reference/judge/step_check.h"

namespace contactcheck::judge {
namespace {

// Pairs of any level as pairs of elements, in the same order.
ElementPair as_pair(const ElementPair& p) { return p; }
ElementPair as_pair(const NearPair& p) { return {p.body, p.other, p.vertex, p.triangle}; }
ElementPair as_pair(const SelfPair& p) { return {p.body, p.body, p.a, p.b}; }
ElementPair as_pair(const BodyImpact& p) { return {p.bodies.a, p.bodies.b, 0, 0}; }

template <typename Pair>
LevelComparison compare(const std::vector<Pair>& truth, const std::vector<Pair>& reported) {
  const auto pairs_of = [](const std::vector<Pair>& list) {
    std::vector<ElementPair> out;
    out.reserve(list.size());
    for (const Pair& pair : list) out.push_back(as_pair(pair));
    return out;
  };
  const std::vector<ElementPair> true_pairs = pairs_of(truth), answered = pairs_of(reported);
  LevelComparison out;
  std::set_difference(true_pairs.begin(), true_pairs.end(), answered.begin(), answered.end(),
                      std::back_inserter(out.missed));
  std::set_difference(answered.begin(), answered.end(), true_pairs.begin(), true_pairs.end(),
                      std::back_inserter(out.spurious));
  out.counts.truth = truth.size();
  out.counts.reported = reported.size();
  out.counts.missed = out.missed.size();
  out.counts.spurious = out.spurious.size();
  out.counts.hit = out.counts.truth - out.counts.missed;
  return out;
}

template <typename Value>
bool holds(const std::vector<Value>& sorted, const Value& value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

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
      return compare(truth.impact_vertices, reported.impact_vertices);
    case Level::kImpactEe:
      return compare(truth.impact_edges, reported.impact_edges);
    case Level::kImpactTriangle:
      return compare(truth.impact_triangles, reported.impact_triangles);
    case Level::kImpactSelfVf:
      return compare(truth.self_impact_vertices, reported.self_impact_vertices);
    case Level::kImpactSelfEe:
      return compare(truth.self_impact_edges, reported.self_impact_edges);
    default:
      return compare(truth.impacts, reported.impacts);
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
    std::uint64_t& starting = out.starting.emplace_back(0);
    for (const oracle::FirstImpact& first : judged.steps[k].first)
      starting += first.starts_in_contact ? 1 : 0;
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
      of_triangles_(semantics.claims(Level::kImpactTriangle)) {
  if (of_triangles_) sums.new_triangles = sums.new_missed = 0;
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
  if (of_steps_) add_times(judged_.steps[step], answer);
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
    ++sums.timed;
    sums.early_max = std::max(sums.early_max.value_or(0.0), first.earliest - time);
    sums.late_max = std::max(sums.late_max.value_or(0.0), time - first.latest);
  }
}

}  // namespace contactcheck::judge
