#include "tests/bench/plain_gather.h"

namespace contactcheck::bench {
namespace {

std::array<double, 8> weights_of(const Vec3& local) {
  std::array<double, 8> weights;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
      weight *= (corner >> axis & 1) ? local[axis] : 1.0 - local[axis];
    weights[corner] = weight;
  }
  return weights;
}

}  // namespace

PlainGather make_plain_gather(const BodyShape& shape) {
  PlainGather out;
  for (std::size_t v = 0; v < shape.mesh.vertices.size(); ++v) {
    out.weights.push_back(weights_of(shape.embedding.local[v]));
    out.nodes.push_back(shape.lattice->cell_nodes[shape.embedding.home_cell[v]]);
  }
  return out;
}

void map_by_gather(const PlainGather& gather, std::span<const Vec3> nodes, std::span<Vec3> out) {
  for (std::size_t v = 0; v < out.size(); ++v) {
    const std::array<double, 8>& w = gather.weights[v];
    const std::array<std::uint32_t, 8>& n = gather.nodes[v];
    Vec3 sum = w[0] * nodes[n[0]];
    for (int corner = 1; corner < 8; ++corner) sum += w[corner] * nodes[n[corner]];
    out[v] = sum;
  }
}

}  // namespace contactcheck::bench
