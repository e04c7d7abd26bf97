#include "core/detect/sphere_stage.h"

#include <utility>

namespace contactcheck {
namespace {

template <typename T>
bool collide(const SphereOf<T>& a, const SphereOf<T>& b, BoundsReading bounds) {
  return bounds == BoundsReading::kPaper ? collide_strict(a, b) : collide_safe(a, b);
}

template <typename T>
void test_top(const FfdStates<T>& states, BoundsReading bounds, bool spheres, bool own,
              SphereSurvivors& out) {
  out.sphere_pairs.clear();
  out.tested = 0;
  for (std::uint32_t a = 0; a < states.size(); ++a)
    for (std::uint32_t b = own ? a : a + 1; b < (own ? a + 1 : states.size()); ++b) {
      ++out.tested;
      if (!spheres || collide(states[a].spheres[0][0], states[b].spheres[0][0], bounds))
        out.sphere_pairs.push_back({{a, b}, 0, 0});
    }
}

// From the pairs of `level` - 1 to those of `level`.
template <typename T>
void test_children(const FfdModels<T>& models, const FfdStates<T>& states, BoundsReading bounds,
                   int level, SphereSurvivors& out) {
  std::swap(out.sphere_pairs, out.parent_pairs);
  out.sphere_pairs.clear();
  out.tested = 0;
  for (const SpherePair& p : out.parent_pairs) {
    const SphereNode& above_a = models[p.bodies.a].spheres.levels[level - 1][p.a];
    const SphereNode& above_b = models[p.bodies.b].spheres.levels[level - 1][p.b];
    const SphereOf<T>* const spheres_a = states[p.bodies.a].spheres[level].data();
    const SphereOf<T>* const spheres_b = states[p.bodies.b].spheres[level].data();
    for (std::uint32_t a = above_a.child_begin; a < above_a.child_end; ++a)
      // For a sphere with itself, each pair of children once.
      for (std::uint32_t b = &above_a == &above_b ? a : above_b.child_begin; b < above_b.child_end;
           ++b) {
        ++out.tested;
        if (collide(spheres_a[a], spheres_b[b], bounds))
          out.sphere_pairs.push_back({p.bodies, a, b});
      }
  }
}

template <typename T>
void mark_active(const FfdModels<T>& models, int level, SphereSurvivors& out) {
  out.sphere_active.resize(models.size());
  for (std::size_t m = 0; m < models.size(); ++m)
    out.sphere_active[m].assign(
        models[m].spheres.levels.empty() ? 1 : models[m].spheres.levels[level].size(), 0);
  out.pair_active.assign(out.bodies * out.bodies, 0);
  out.body_pairs.clear();
  for (const SpherePair& p : out.sphere_pairs) {
    char& forward = out.pair_active[p.bodies.a * out.bodies + p.bodies.b];
    if (!forward) out.body_pairs.push_back(p.bodies);
    forward = out.pair_active[p.bodies.b * out.bodies + p.bodies.a] = 1;
    out.sphere_active[p.bodies.a][p.a] = out.sphere_active[p.bodies.b][p.b] = 1;
  }
}

}  // namespace

template <typename T>
void run_spheres(const FfdModels<T>& models, const FfdStates<T>& states, BoundsReading bounds,
                 int levels, bool own, SphereSurvivors& out) {
  out.bodies = models.size();
  test_top(states, bounds, levels > 0, own, out);
  for (int level = 1; level < levels; ++level) test_children(models, states, bounds, level, out);
  mark_active(models, levels > 1 ? levels - 1 : 0, out);
}

template void run_spheres(const FfdModels<double>&, const FfdStates<double>&, BoundsReading, int,
                          bool, SphereSurvivors&);
template void run_spheres(const FfdModels<float>&, const FfdStates<float>&, BoundsReading, int,
                          bool, SphereSurvivors&);

}  // namespace contactcheck
