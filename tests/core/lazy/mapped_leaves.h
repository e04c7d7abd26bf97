// Leaves of deformed bodies, mapped in either precision on every instruction set.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/detect/triangle_pair_detector.h"
#include "tests/core/lazy/one_body.h"

namespace contactcheck::test {

/// Lattices of one cell and of many, and none; triangles in one cell and across all.
inline std::vector<ShapePtr> leaf_shapes() {
  const TriangleMesh ball = sphere_mesh(Vec3::Zero(), 1.0, 3);
  return {make_shape(ball, {1, 1, 1}), make_shape(ball, {10, 10, 10}), make_bare_shape(ball),
          make_shape(long_triangles(5, 33), {6, 6, 6}), make_shape(sheet(1), {1, 1, 1})};
}

template <typename Real>
const LeafCacheOf<Real>& mapped_leaf(const LazyKernels& kernels, OneBody& body,
                                     std::uint32_t leaf) {
  if constexpr (std::is_same_v<Real, float>) {
    return kernels.map_single_leaf(body.state(), leaf, body.arena());
  } else {
    return kernels.map_leaf(body.state(), leaf, body.arena());
  }
}

/// Calls `check(body, leaf, cache)` for every leaf of every shape, deformation, source and
/// instruction set.
template <typename Real, typename Check>
void for_each_mapped_leaf(std::uint64_t seed, std::span<const Deformation> deformations,
                          Check&& check) {
  TriangleSource random(seed);
  for (const ShapePtr& shape : leaf_shapes())
    for (bool from_vertices : {false, true}) {
      OneBody body(shape, from_vertices, kPrecision<Real>);
      for (const Deformation& how : deformations)
        for (const std::string& isa : lazy_isas()) {
          SCOPED_TRACE(isa);
          body.begin(deformed_nodes(*shape, how, random));
          for (std::uint32_t l = 0; l < body.tree().leaves.size(); ++l)
            check(body, l, mapped_leaf<Real>(lazy_kernels(isa), body, l));
        }
    }
}

/// How many coordinates of the mapped leaves have other bits than the mapping of all vertices, and
/// how many vertices there are.
struct BitTally {
  std::size_t different = 0, vertices = 0;
};

template <typename Real>
BitTally compare_bits(std::uint64_t seed, std::span<const Deformation> deformations) {
  using Bits = std::conditional_t<std::is_same_v<Real, float>, std::uint32_t, std::uint64_t>;
  const auto differ = [](Real a, Real b) {
    return std::bit_cast<Bits>(a) != std::bit_cast<Bits>(b);
  };
  BitTally out;
  for_each_mapped_leaf<Real>(
      seed, deformations,
      [&](const OneBody& body, std::uint32_t l, const LeafCacheOf<Real>& cache) {
        const TreeLeaf& leaf = body.tree().leaves[l];
        for (std::uint32_t i = 0; i < leaf.vertices; ++i, ++out.vertices) {
          const std::uint32_t v = body.tree().leaf_vertices[leaf.first_vertex + i];
          const Vec3Of<Real>& truth = body.vertices_in<Real>()[v];
          out.different += differ(cache.x[i], truth.x());
          out.different += differ(cache.y[i], truth.y());
          out.different += differ(cache.z[i], truth.z());
        }
      });
  return out;
}

}  // namespace contactcheck::test
