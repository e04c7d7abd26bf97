// The Utah teapot, from the 32 bicubic Bezier patches that Debian's povray-examples ships.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types/mesh.h"
#include "reference/scene/data_package.h"

namespace contactcheck {

/// Points closer than this, in each coordinate, become one vertex; in the patches' own unit, of
/// which the teapot is 6.4 long. Anything from 1e-9 to 1e-4 gives the same mesh; at 0, patches that
/// meet with different rounding stay torn (3,277 vertices instead of 3,241).
inline constexpr double kTeapotWeld = 1e-6;

/// divisions x divisions squares of two triangles per patch, z up, in the patches' own unit. With
/// 10 divisions 3,241 vertices and 6,400 triangles: the paper's teapot, of which 80 triangles have
/// no area (patches that end in a point) and 160 edges lie on a boundary, so it is no solid.
/// @pre divisions >= 1
/// @throws InputError when povray-examples is missing or does not hold 32 patches
TriangleMesh make_teapot(std::size_t divisions,
                         const std::vector<std::filesystem::path>& roots = data_roots());

}  // namespace contactcheck
