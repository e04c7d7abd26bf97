// More triangles on the same surface.
#pragma once

#include <cstddef>

#include "core/types/mesh.h"

namespace contactcheck::mesh {

/// Splits every triangle into four at the midpoints of its edges, `times` over. Triangles that
/// share an edge share its midpoint; given vertices come first and keep their doubles. The surface
/// stays where it was, up to the rounding of midpoints.
TriangleMesh subdivide(TriangleMesh mesh, std::size_t times);

}  // namespace contactcheck::mesh
