// FFD-AABBs: per kept cell the box, in the cell's local coordinates, of the surface inside it.
// Source: Jung, Hong, Choi (the paper's [20]); Jeon et al. 2013, section "FFD-AABB".
#pragma once

#include <span>
#include <vector>

#include "core/deform/embedding.h"
#include "core/deform/lattice.h"
#include "core/types/mesh.h"

namespace contactcheck {

/// Per kept cell, at rest: bounds in (s, t, u), within [0, 1]^3, of every triangle of that label
/// clipped to the cell. Never empty: a kept cell meets surface.
/// The doubles returned here are the definition of the box (clipping rounds). A triangle that
/// reaches more than 2^20 sides of the cell beyond it counts as its own box, clipped to the cell.
std::vector<Aabb> ffd_aabbs(const TriangleMesh& mesh, const Lattice& lattice,
                            const Embedding& embedding);

/// The eight corners of a local box of `cell`, mapped by the deformed nodes.
Corners mapped_box(const Lattice& lattice, std::uint32_t cell, const Aabb& local,
                   std::span<const Vec3> nodes);

}  // namespace contactcheck
