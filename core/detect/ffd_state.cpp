#include "core/detect/ffd_state.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/deform/mapping.h"

namespace contactcheck {
namespace {

double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0.0;
  for (const Vec3& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

Aabb scaled(const Aabb& box, double share) {
  if (share == 1.0) return box;
  const Vec3 c = box.center();
  return {c + (box.lo - c) * share, c + (box.hi - c) * share};
}

void find_hulls(const FfdModel& model, FfdState& state) {
  state.hull.resize(model.piece_begin.size() - 1);
  for (std::size_t cell = 0; cell < state.hull.size(); ++cell) {
    Aabb hull;
    for (std::uint32_t p = model.piece_begin[cell]; p < model.piece_begin[cell + 1]; ++p)
      for (const Vec3& corner : state.corners[p]) hull.extend(corner);
    state.hull[cell] = hull;
  }
}

// Derivation: header of ffd_model.h. The final addition and subtraction round once more: 1 ulp of
// the coordinate, covered by the third error unit.
void bound_cells(const FfdModel& model, const FfdConfig& config, double error, FfdState& state) {
  state.cell_box.assign(state.hull.size(), Aabb{});
  for (std::uint32_t cell : model.cells) {
    Aabb box = state.hull[cell];
    box.lo.array() -= 3.0 * error;
    box.hi.array() += 3.0 * error;
    state.cell_box[cell] = scaled(box, config.faults.cell_box);
  }
}

Vec3 body_center(const FfdState& state) {
  Aabb box;
  for (const Aabb& hull : state.hull) box.extend(hull);
  return box.center();
}

// The largest squared distance from `center` to a corner of the sphere's cells. A cell is skipped
// when the farthest corner of its hull is no farther than what was found: rounding is monotone, so
// the distances computed for corners inside the hull are no larger, and the result is the same.
double farthest_squared(const FfdModel& model, const FfdState& state, const SphereNode& sphere,
                        const Vec3& center) {
  double largest = 0.0;
  for (std::uint32_t cell : sphere.cells) {
    const Aabb& hull = state.hull[cell];
    const Vec3 reach = (hull.lo - center).cwiseAbs().cwiseMax((hull.hi - center).cwiseAbs());
    if (reach.squaredNorm() <= largest) continue;
    for (std::uint32_t p = model.piece_begin[cell]; p < model.piece_begin[cell + 1]; ++p)
      for (const Vec3& corner : state.corners[p])
        largest = std::max(largest, (corner - center).squaredNorm());
  }
  return largest;
}

void place_spheres(const FfdModel& model, const FfdConfig& config, double error, FfdState& state) {
  const double slack = 2.0 * std::sqrt(3.0) * error;
  state.spheres.resize(model.spheres.levels.size());
  for (std::size_t level = 0; level < state.spheres.size(); ++level) {
    const std::vector<SphereNode>& rest = model.spheres.levels[level];
    state.spheres[level].resize(rest.size());
    for (std::size_t s = 0; s < rest.size(); ++s) {
      Sphere& sphere = state.spheres[level][s];
      sphere.center = level == 0 ? body_center(state) : state.nodes[rest[s].center_node];
      sphere.radius =
          config.bounds == BoundsReading::kPaper
              ? model.rest_radius[level][s]
              : covering_radius(farthest_squared(model, state, rest[s], sphere.center), slack);
      sphere.radius *= config.sphere_radius;
    }
  }
}

bool holds(const Sphere& sphere, const Vec3& p) {
  return (p - sphere.center).norm() <= sphere.radius;
}

}  // namespace

void update_state(const FfdModel& model, const FfdConfig& config, const BodyState& body,
                  FfdState& state) {
  state.nodes = body.nodes;
  state.corners.resize(model.pieces.size());
  map_boxes(*model.shape->lattice, model.piece_boxes, body.nodes, state.corners);
  const double error = mapping_error_bound(largest_coordinate(body.nodes));
  find_hulls(model, state);
  if (config.bounds == BoundsReading::kSafe) bound_cells(model, config, error, state);
  place_spheres(model, config, error, state);
}

std::string validate(const FfdModel& model, const FfdState& state, std::span<const Vec3> vertices) {
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

}  // namespace contactcheck
