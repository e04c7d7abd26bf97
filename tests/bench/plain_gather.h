// The mapping as one would write it without thought for the machine: eight weights and eight nodes
// per vertex, made at rest, summed up in the order of the mesh. What map_vertices is measured
// against. Its results differ from the canonical ones by rounding.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/deform/body.h"

namespace contactcheck::bench {

struct PlainGather {
  std::vector<std::array<double, 8>> weights;       ///< per vertex
  std::vector<std::array<std::uint32_t, 8>> nodes;  ///< per vertex
};

/// @pre the shape has a lattice
PlainGather make_plain_gather(const BodyShape& shape);

/// One position per vertex, in the order of the mesh.
void map_by_gather(const PlainGather& gather, std::span<const Vec3> nodes, std::span<Vec3> out);

}  // namespace contactcheck::bench
