// Extruded letters, some with holes, some concave: the bodies of the paper's alphabet scene.
#pragma once

#include <cstddef>
#include <string>

#include "core/types/mesh.h"

namespace contactcheck {

/// All letters there are: "ABCDEHILOPRTU".
const std::string& known_letters();

/// A letter in the xy plane, extruded along z to `depth` (above 0): closed, edge-manifold,
/// consistently oriented. Glyphs are 5 x 7 pixels, bent into shape, in a field of 5/7 x 1 round the
/// origin; each pixel is divisions x divisions squares of two triangles. With 4 divisions and depth
/// 0.2 an O has 3,200 triangles.
/// @pre `letter` is one of known_letters(), divisions >= 1
TriangleMesh make_letter(char letter, double depth, std::size_t divisions);

}  // namespace contactcheck
