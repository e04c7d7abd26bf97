#include "reference/run/scene_summary.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "reference/compare/judge.h"
#include "reference/compare/run_result_json.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

// Summed over frames; levels that the scene does not ask for are absent.
Json truth_json(const JudgedScene& judged) {
  std::map<Level, std::size_t> sums;
  for (const Truth& t : judged.truth) {
    sums[Level::kBody] += t.surface.bodies.size();
    sums[Level::kContainment] += t.containment.size();
    sums[Level::kBox] += t.boxes.size();
    sums[Level::kTriangle] += t.surface.triangles.size();
    sums[Level::kVertex] += t.surface.vertices.size();
  }
  Json out = Json::object();
  for (const auto& [level, sum] : sums) {
    if (!judged.scene->judges(level)) continue;
    const std::string why = obstacle_to_judging(level, judged.scene->bodies);
    out[name_of(level)] = why.empty() ? Json(sum) : Json(why);
  }
  return out;
}

std::uint64_t truth_hash(const JudgedScene& judged) {
  std::uint64_t hash = 0;
  for (std::size_t f = 0; f < judged.truth.size(); ++f) {
    ContactSet surface = judged.truth[f].surface;
    surface.vertices.clear();  // triangle detectors report none
    hash = chain_hash(hash, f, surface);
  }
  return hash;
}

// Per value, so that a report can set answers beside it.
Json family_json(const JudgedScene& judged) {
  const CaseFamily& family = *judged.scene->family;
  Json pairs = Json::array();
  for (const Truth& t : judged.truth) pairs.push_back(t.surface.triangles.size());
  return {{"parameter", family.parameter},
          {"values", family.values},
          {"origin", family.origin},
          {"stresses", family.stresses},
          {"true_pairs", std::move(pairs)}};
}

Json pairs_json(const PairSpec& spec, const PairTally& tally) {
  Json kinds = Json::object();
  for (std::size_t k = 0; k < kPairKinds; ++k)
    kinds[name_of(static_cast<PairKind>(k))] = {{"pairs", tally.kinds[k].pairs},
                                                {"touching", tally.kinds[k].touching}};
  return {{"count", spec.count},
          {"seed", spec.seed},
          {"touching", tally.touching()},
          {"per_kind", std::move(kinds)},
          {"rational", {{"checked", tally.checked()}, {"oracle_wrong", tally.oracle_wrong}}}};
}

Json bodies_json(const Scene& scene) {
  Json bodies = Json::array();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodyShape& shape = *scene.bodies[b].shape;
    bodies.push_back({{"name", scene.bodies[b].name},
                      {"source", scene.origins[b].source},
                      {"notes", scene.origins[b].notes},
                      {"vertices", shape.mesh.vertices.size()},
                      {"triangles", shape.mesh.triangles.size()},
                      {"cells", shape.lattice ? shape.lattice->cells.size() : 0},
                      {"solid", shape.topology.solid}});
  }
  return bodies;
}

Json fits_json(const Scene& scene) {
  Json fits = Json::array();
  for (const FitError& fit : scene.fits)
    fits.push_back({{"body", scene.bodies[fit.body].name}, {"rms", fit.rms}, {"max", fit.max}});
  return fits;
}

}  // namespace

nlohmann::ordered_json scene_summary(const JudgedScene& judged,
                                     const std::vector<double>& separations) {
  const Scene& scene = *judged.scene;
  const std::vector<bool>& contact = judged.contact_frames;
  Json out = {{"id", scene.id},
              {"title", scene.title},
              {"frames", scene.frames},
              {"time_step", scene.time_step},
              {"size", scene.size()},
              {"contact_frames", std::count(contact.begin(), contact.end(), true)},
              {"truth", truth_json(judged)},
              {"truth_hash", hex(truth_hash(judged))},
              {"bodies", bodies_json(scene)}};
  if (!separations.empty()) out["separation"] = separations;
  if (scene.family) out["family"] = family_json(judged);
  if (scene.sweep)
    out["sweep"] = {{"separations", scene.sweep->separations},
                    {"orientations", scene.sweep->orientations},
                    {"seed", scene.sweep->seed},
                    {"tolerance", kSweepTolerance * scene.size()}};
  if (!scene.fits.empty()) out["fits"] = fits_json(scene);
  if (judged.pairs) out["pairs"] = pairs_json(scene.pairs->spec(), *judged.pairs);
  if (scene.simulation)
    out["simulation"] = {{"driver", scene.simulation->driver},
                         {"step", scene.simulation->settings.time_step},
                         {"every", scene.simulation->every}};
  return out;
}

}  // namespace contactcheck
