// A shape in the view: its triangles, and how its vertices, FFD-AABBs and bounding spheres follow
// from the nodes of a frame.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/deform/body.h"
#include "reference/view/view_buffers.h"

namespace contactcheck {

/// The header's entry of the shape; see view_bytes.h.
nlohmann::ordered_json shape_view(const BodyShape& shape, ViewBuffers& buffers);

}  // namespace contactcheck
