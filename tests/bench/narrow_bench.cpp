// The exact triangle test, by the kind of pair: generic ones stay within the floating-point filter,
// the others take exact arithmetic.

#include <benchmark/benchmark.h>

#include <string>
#include <utility>
#include <vector>

#include "core/narrow/predicates.h"
#include "core/narrow/triangle_triangle.h"
#include "tests/bench/register.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::bench {
namespace {

using Pair = std::pair<TrianglePoints, TrianglePoints>;
using MakePair = Pair (*)(test::TriangleSource&);

Pair generic_pair(test::TriangleSource& random) {
  return {random.triangle(Vec3::Zero(), 1.0), random.triangle(Vec3::Zero(), 1.0)};
}

// Neighbours of two surfaces: boxes overlap, the triangles do not reach each other's plane.
Pair separated_pair(test::TriangleSource& random) {
  const TrianglePoints p = random.triangle(Vec3::Zero(), 1.0);
  const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
  TrianglePoints q = p;
  for (Vec3& corner : q) corner += 1e-3 * normal;
  return {p, q};
}

Pair touching_pair(test::TriangleSource& random) {
  const TrianglePoints p = random.triangle(Vec3::Zero(), 1.0);
  TrianglePoints q = random.triangle(p[0], 1.0);
  q[0] = p[0];
  return {p, q};
}

Pair coplanar_pair(test::TriangleSource& random) {
  Pair pair = generic_pair(random);
  for (int corner = 0; corner < 3; ++corner) pair.first[corner].z() = pair.second[corner].z() = 0.5;
  return pair;
}

// A segment against a triangle.
Pair degenerate_pair(test::TriangleSource& random) {
  Pair pair = generic_pair(random);
  pair.first[2] = pair.first[0];
  return pair;
}

void time_pairs(benchmark::State& state, MakePair make_pair) {
  constexpr std::size_t kPairs = 1024;
  test::TriangleSource random(11);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < kPairs; ++i) pairs.push_back(make_pair(random));
  reset_exact_predicate_calls();
  std::size_t next = 0, hits = 0;
  for (auto _ : state) {
    const auto& [p, q] = pairs[next++ % kPairs];
    hits += triangles_intersect(p, q);
  }
  state.SetItemsProcessed(state.iterations());
  const auto calls = static_cast<double>(state.iterations());
  state.counters["hit_share"] = static_cast<double>(hits) / calls;
  state.counters["exact_per_call"] = static_cast<double>(exact_predicate_calls()) / calls;
}

}  // namespace

void register_narrow_benchmarks() {
  const std::pair<const char*, MakePair> kinds[] = {{"generic", &generic_pair},
                                                    {"separated", &separated_pair},
                                                    {"touching", &touching_pair},
                                                    {"coplanar", &coplanar_pair},
                                                    {"degenerate", &degenerate_pair}};
  for (const auto& [name, make_pair] : kinds)
    benchmark::RegisterBenchmark((std::string("triangles_intersect/") + name).c_str(), &time_pairs,
                                 make_pair);
}

}  // namespace contactcheck::bench
