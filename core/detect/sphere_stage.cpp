#include "core/detect/sphere_stage.h"

namespace contactcheck {
namespace {

struct SpherePair {
  BodyPair bodies;
  std::uint32_t a, b;
};

bool collide(const Sphere& a, const Sphere& b, BoundsReading bounds) {
  return bounds == BoundsReading::kPaper ? collide_strict(a, b) : collide_safe(a, b);
}

std::vector<SpherePair> test_top(const std::vector<FfdState>& states, BoundsReading bounds,
                                 bool spheres, SphereSurvivors& out) {
  std::vector<SpherePair> hits;
  out.tested = 0;
  for (std::uint32_t a = 0; a < states.size(); ++a)
    for (std::uint32_t b = a + 1; b < states.size(); ++b) {
      ++out.tested;
      if (!spheres || collide(states[a].spheres[0][0], states[b].spheres[0][0], bounds))
        hits.push_back({{a, b}, 0, 0});
    }
  return hits;
}

// The children of a sphere stand together in the next level.
std::vector<std::pair<std::uint32_t, std::uint32_t>> child_ranges(
    const std::vector<SphereNode>& children, std::size_t parents) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges(parents, {0, 0});
  for (std::uint32_t c = 0; c < children.size(); ++c) {
    auto& range = ranges[children[c].parent];
    if (range.first == range.second) range.first = c;
    range.second = c + 1;
  }
  return ranges;
}

std::vector<SpherePair> test_children(const std::vector<FfdModel>& models,
                                      const std::vector<FfdState>& states, BoundsReading bounds,
                                      int level, const std::vector<SpherePair>& parents,
                                      SphereSurvivors& out) {
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> ranges;
  for (const FfdModel& m : models)
    ranges.push_back(child_ranges(m.spheres.levels[level], m.spheres.levels[level - 1].size()));
  std::vector<SpherePair> hits;
  out.tested = 0;
  for (const SpherePair& p : parents) {
    const auto [a0, a1] = ranges[p.bodies.a][p.a];
    const auto [b0, b1] = ranges[p.bodies.b][p.b];
    for (std::uint32_t a = a0; a < a1; ++a)
      for (std::uint32_t b = b0; b < b1; ++b) {
        ++out.tested;
        if (collide(states[p.bodies.a].spheres[level][a], states[p.bodies.b].spheres[level][b],
                    bounds))
          hits.push_back({p.bodies, a, b});
      }
  }
  return hits;
}

void mark_active(const std::vector<FfdModel>& models, int level,
                 const std::vector<SpherePair>& hits, SphereSurvivors& out) {
  out.sphere_active.resize(models.size());
  for (std::size_t m = 0; m < models.size(); ++m)
    out.sphere_active[m].assign(
        models[m].spheres.levels.empty() ? 1 : models[m].spheres.levels[level].size(), 0);
  out.pair_active.assign(out.bodies * out.bodies, 0);
  out.body_pairs.clear();
  for (const SpherePair& p : hits) {
    char& forward = out.pair_active[p.bodies.a * out.bodies + p.bodies.b];
    if (!forward) out.body_pairs.push_back(p.bodies);
    forward = out.pair_active[p.bodies.b * out.bodies + p.bodies.a] = 1;
    out.sphere_active[p.bodies.a][p.a] = out.sphere_active[p.bodies.b][p.b] = 1;
  }
}

}  // namespace

void run_spheres(const std::vector<FfdModel>& models, const std::vector<FfdState>& states,
                 BoundsReading bounds, int levels, SphereSurvivors& out) {
  out.bodies = models.size();
  std::vector<SpherePair> hits = test_top(states, bounds, levels > 0, out);
  for (int level = 1; level < levels; ++level)
    hits = test_children(models, states, bounds, level, hits, out);
  out.colliding = hits.size();
  mark_active(models, levels > 1 ? levels - 1 : 0, hits, out);
}

}  // namespace contactcheck
