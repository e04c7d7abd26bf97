#include "reference/judge/scene_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "reference/judge/judge.h"
#include "reference/judge/step_judge.h"
#include "reference/oracle/closed_chain.h"

namespace contactcheck::judge {
namespace {

// Summed over frames; levels that the scene does not ask for are absent.
std::map<Level, std::variant<std::uint64_t, std::string>> truth_of(const JudgedScene& judged) {
  const bool cells = judged.scene->judges(Level::kSelfCell) &&
                     obstacle_to_judging(Level::kSelfCell, judged.scene->bodies, {}).empty();
  std::map<Level, std::uint64_t> sums;
  for (const oracle::Truth& t : judged.truth) {
    sums[Level::kBody] += t.surface.bodies.size();
    sums[Level::kContainment] += t.containment.size();
    sums[Level::kBox] += t.boxes.size();
    sums[Level::kTriangle] += t.surface.triangles.size();
    sums[Level::kVertex] += t.surface.vertices.size();
    for (const Level level : kSelfClasses)
      sums[level] += self_pairs(level, judged.scene->bodies, t.surface.self).size();
    sums[Level::kSelfBody] += t.surface.self_bodies.size();
    sums[Level::kSelfCell] +=
        cells ? pairs_of_cells_apart(judged.scene->bodies, t.surface.self).size() : 0;
  }
  for (const oracle::StepTruth& t : judged.steps) {
    sums[Level::kImpactVf] += t.contacts.impact_vertices.size();
    sums[Level::kImpactEe] += t.contacts.impact_edges.size();
    sums[Level::kImpactTriangle] += t.contacts.impact_triangles.size();
    sums[Level::kImpact] += t.contacts.impacts.size();
    sums[Level::kImpactSelfVf] += t.contacts.self_impact_vertices.size();
    sums[Level::kImpactSelfEe] += t.contacts.self_impact_edges.size();
  }
  std::map<Level, std::variant<std::uint64_t, std::string>> out;
  for (const auto& [level, sum] : sums) {
    if (!judged.scene->judges(level)) continue;
    const std::string why = obstacle_to_judging(level, judged.scene->bodies, judged.open);
    if (why.empty()) {
      out[level] = sum;
    } else {
      out[level] = why;
    }
  }
  return out;
}

// stableNorm() keeps lengths whose squares are no double; a length that is none is not told.
std::optional<results::SceneScale> scale_of(const JudgedScene& judged) {
  const scene::Scene& scene = *judged.scene;
  if (scene.family() || scene.pairs()) return {};
  results::SceneScale out{std::numeric_limits<double>::infinity(), 0.0, 0.0};
  for (const Body& body : scene.bodies) {
    const std::vector<Vec3>& vertices = body.shape->mesh.vertices;
    for (const Triangle& t : body.shape->mesh.triangles) {
      double edge = 0.0;
      for (const std::size_t i : {0, 1, 2})
        edge = std::max(edge, (vertices[t[i]] - vertices[t[(i + 1) % 3]]).stableNorm());
      if (edge == 0.0) continue;
      out.shortest_edge = std::min(out.shortest_edge, edge);
      out.longest_edge = std::max(out.longest_edge, edge);
    }
  }
  if (out.longest_edge == 0.0 || !std::isfinite(out.longest_edge)) return {};
  out.reach = judged.reach;
  return out;
}

results::RandomPairs pairs_of(const scene::PairSpec& spec, const PairTally& tally) {
  results::RandomPairs out{spec.count, spec.seed,       tally.touching(),
                           {},         tally.checked(), tally.oracle_wrong};
  for (std::size_t k = 0; k < scene::kPairKinds; ++k)
    out.per_kind.emplace_back(
        scene::name_of(static_cast<scene::PairKind>(k)),
        results::PairKindTally{tally.kinds[k].pairs, tally.kinds[k].touching});
  return out;
}

}  // namespace

results::Scene scene_summary(const JudgedScene& judged, const std::vector<double>& separations) {
  const scene::Scene& scene = *judged.scene;
  const std::vector<bool>& contact = judged.contact_frames;
  results::Scene out;
  out.id = scene.id;
  out.title = scene.title;
  out.frames = scene.frames;
  out.time_step = scene.time_step;
  out.size = scene.size();
  out.scale = scale_of(judged);
  out.contact_frames = static_cast<std::size_t>(std::count(contact.begin(), contact.end(), true));
  out.truth = truth_of(judged);
  std::uint64_t hash = 0;
  for (std::size_t f = 0; f < judged.truth.size(); ++f) {
    ContactSet surface = judged.truth[f].surface;
    surface.vertices.clear();  // triangle detectors report none
    if (f < judged.steps.size())
      for_each_list(
          [](ContactList list, auto& kept, const auto& found) {
            if (is_of_step(list)) kept = found;
          },
          surface, judged.steps[f].contacts);
    hash = chain_hash(hash, f, surface);
  }
  out.truth_hash = results::hex(hash);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodyShape& shape = *scene.bodies[b].shape;
    out.bodies.push_back(
        {scene.bodies[b].name, scene.origins[b].source, scene.origins[b].notes,
         shape.mesh.vertices.size(), shape.mesh.triangles.size(),
         shape.lattice ? shape.lattice->cells.size() : 0,
         oracle::surface_chain(shape.mesh.triangles, shape.mesh.vertices).closed()});
  }
  out.separation = separations;
  if (scene.family()) {
    const scene::CaseFamily& family = *scene.family();
    out.family = {family.parameter, family.origin, family.stresses, family.values, {},
                  family.range};
    // Per value, so that a report can set answers beside it.
    for (const oracle::Truth& t : judged.truth) {
      std::size_t pairs = t.surface.triangles.size();
      for (const Level level : kSelfClasses)
        if (scene.judges(level)) pairs += self_pairs(level, scene.bodies, t.surface.self).size();
      out.family->true_pairs.push_back(pairs);
    }
  }
  if (scene.sweep())
    out.sweep = {scene.sweep()->separations, scene.sweep()->orientations, scene.sweep()->seed,
                 scene::kSweepTolerance * scene.size()};
  for (const scene::FitError& fit : scene.fits)
    out.fits.push_back({scene.bodies[fit.body].name, fit.rms, fit.max});
  if (!judged.steps.empty()) out.impacts = scene_impacts(judged);
  if (judged.pairs) out.pairs = pairs_of(scene.pairs()->spec(), *judged.pairs);
  if (scene.drawn)
    out.drawn = {scene.drawn->seed, scene.drawn->number, scene.drawn->redrawn, scene.drawn->happens,
                 scene.drawn->parameters};
  if (scene.simulation())
    out.simulation = {scene.simulation()->driver, scene.simulation()->settings.time_step,
                      scene.simulation()->every};
  return out;
}

}  // namespace contactcheck::judge
