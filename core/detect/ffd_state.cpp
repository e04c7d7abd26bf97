#include "core/detect/ffd_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/deform/mapping.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

template <typename T>
T largest_coordinate(std::span<const Vec3Of<T>> points) {
  T largest = 0;
  for (const Vec3Of<T>& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

// A blend of nodes in the last binade may round to infinity, and the next one to no number.
template <typename T>
void require_finite(const FfdStateOf<T>& state) {
  for (const CornersOf<T>& box : state.corners)
    for (const Vec3Of<T>& corner : box)
      if (!corner.allFinite())
        throw RefusedInput(
            "a node's coordinate is so near the largest double that a box overflows");
}

template <typename T>
void find_hulls(const FfdModelOf<T>& model, FfdStateOf<T>& state) {
  state.hull.resize(model.piece_begin.size() - 1);
  for (std::size_t cell = 0; cell < state.hull.size(); ++cell) {
    AabbOf<T> hull;
    for (std::uint32_t p = model.piece_begin[cell]; p < model.piece_begin[cell + 1]; ++p)
      for (const Vec3Of<T>& corner : state.corners[p]) hull.extend(corner);
    state.hull[cell] = hull;
  }
}

// Derivation: header of ffd_model.h. The final addition and subtraction round once more: 1 ulp of
// the coordinate, covered by the third error unit.
template <typename T>
void bound_cells(const FfdModelOf<T>& model, T error, FfdStateOf<T>& state) {
  state.cell_box.assign(state.hull.size(), AabbOf<T>{});
  for (std::uint32_t cell : model.cells) {
    AabbOf<T>& box = state.cell_box[cell];
    box = state.hull[cell];
    box.lo.array() -= 3 * error;
    box.hi.array() += 3 * error;
  }
}

template <typename T>
Vec3Of<T> body_center(const FfdStateOf<T>& state) {
  AabbOf<T> box;
  for (const AabbOf<T>& hull : state.hull) box.extend(hull);
  return box.center();
}

// The largest squared distance from `center` to a corner of the sphere's cells. A cell is skipped
// when the farthest corner of its hull is no farther than what was found: rounding is monotone, so
// the distances computed for corners inside the hull are no larger, and the result is the same.
template <typename T>
T farthest_squared(const FfdModelOf<T>& model, const FfdStateOf<T>& state, const SphereNode& sphere,
                   const Vec3Of<T>& center) {
  T largest = 0;
  for (std::uint32_t cell : sphere.cells) {
    const AabbOf<T>& hull = state.hull[cell];
    const Vec3Of<T> reach = (hull.lo - center).cwiseAbs().cwiseMax((hull.hi - center).cwiseAbs());
    if (ordered_dot<T>(reach, reach) <= largest) continue;
    for (std::uint32_t p = model.piece_begin[cell]; p < model.piece_begin[cell + 1]; ++p)
      for (const Vec3Of<T>& corner : state.corners[p])
        largest = std::max(largest, squared_distance<T>(corner, center));
  }
  return largest;
}

template <typename T>
void place_spheres(const FfdModelOf<T>& model, const FfdConfig& config, T error,
                   FfdStateOf<T>& state) {
  const T slack = static_cast<T>(2.0 * std::sqrt(3.0)) * error;
  state.spheres.resize(model.spheres.levels.size());
  for (std::size_t level = 0; level < state.spheres.size(); ++level) {
    const std::vector<SphereNode>& rest = model.spheres.levels[level];
    state.spheres[level].resize(rest.size());
    for (std::size_t s = 0; s < rest.size(); ++s) {
      SphereOf<T>& sphere = state.spheres[level][s];
      sphere.center = level == 0 ? body_center(state) : state.nodes[rest[s].center_node];
      sphere.radius =
          config.bounds == BoundsReading::kPaper
              ? model.rest_radius[level][s]
              : covering_radius(farthest_squared(model, state, rest[s], sphere.center), slack);
      sphere.radius *= static_cast<T>(config.sphere_radius);
    }
  }
}

template <typename T>
bool holds(const SphereOf<T>& sphere, const Vec3Of<T>& p) {
  return std::sqrt(squared_distance<T>(p, sphere.center)) <= sphere.radius;
}

}  // namespace

template <typename T>
void update_state(const FfdModelOf<T>& model, const FfdConfig& config,
                  std::span<const Vec3Of<T>> nodes, FfdStateOf<T>& state) {
  state.nodes = nodes;
  state.corners.resize(model.pieces.size());
  map_boxes(*model.shape->lattice, std::span(model.piece_boxes), nodes, std::span(state.corners));
  const T largest = largest_coordinate(nodes), error = mapping_error_bound(largest);
  if (!(largest <= std::numeric_limits<T>::max() / 2)) require_finite(state);
  find_hulls(model, state);
  if (config.bounds == BoundsReading::kSafe) bound_cells(model, error, state);
  place_spheres(model, config, error, state);
}

template <typename T>
std::string validate(const FfdModelOf<T>& model, const FfdStateOf<T>& state,
                     std::type_identity_t<std::span<const Vec3Of<T>>> vertices) {
  const std::vector<Triangle>& triangles = model.shape->mesh.triangles;
  const auto name = [](std::uint32_t t, const std::string& bound) {
    return "triangle " + std::to_string(t) + " leaves its " + bound;
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t v : triangles[t])
      if (!state.cell_box[model.owner[t]].contains(vertices[v])) return name(t, "owner's box");
  for (std::size_t level = 0; level < state.spheres.size(); ++level)
    for (std::size_t s = 0; s < state.spheres[level].size(); ++s)
      for (std::uint32_t cell : model.spheres.levels[level][s].cells)
        for (std::uint32_t t : model.triangles.row(cell))
          for (std::uint32_t v : triangles[t])
            if (!holds(state.spheres[level][s], vertices[v]))
              return name(t, "sphere of level " + std::to_string(level + 1));
  return "";
}

template void update_state(const FfdModelOf<double>&, const FfdConfig&,
                           std::span<const Vec3Of<double>>, FfdStateOf<double>&);
template void update_state(const FfdModelOf<float>&, const FfdConfig&,
                           std::span<const Vec3Of<float>>, FfdStateOf<float>&);
template std::string validate(const FfdModelOf<double>&, const FfdStateOf<double>&,
                              std::span<const Vec3Of<double>>);
template std::string validate(const FfdModelOf<float>&, const FfdStateOf<float>&,
                              std::span<const Vec3Of<float>>);

}  // namespace contactcheck
