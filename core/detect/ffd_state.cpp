#include "core/detect/ffd_state.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/deform/ffd_aabb.h"
#include "core/deform/mapping.h"

namespace contactcheck {
namespace {

double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0.0;
  for (const Vec3& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

void map_pieces(const FfdModel& model, std::span<const Vec3> nodes, std::vector<Corners>& out) {
  out.resize(model.pieces.size());
  const Lattice& lattice = *model.shape->lattice;
  for (std::size_t p = 0; p < model.pieces.size(); ++p)
    out[p] = mapped_box(lattice, model.pieces[p].home, model.pieces[p].local, nodes);
}

Aabb scaled(const Aabb& box, double share) {
  if (share == 1.0) return box;
  const Vec3 c = box.center();
  return {c + (box.lo - c) * share, c + (box.hi - c) * share};
}

// Derivation: header of ffd_model.h. The final addition and subtraction round once more: 1 ulp of
// the coordinate, covered by the third error unit.
void bound_cells(const FfdModel& model, const FfdConfig& config, double error, FfdState& state) {
  state.cell_box.assign(model.piece_begin.size() - 1, Aabb{});
  for (std::uint32_t cell : model.cells) {
    Aabb box;
    for (std::uint32_t p = model.piece_begin[cell]; p < model.piece_begin[cell + 1]; ++p)
      for (const Vec3& corner : state.corners[p]) box.extend(corner);
    box.lo.array() -= 3.0 * error;
    box.hi.array() += 3.0 * error;
    state.cell_box[cell] = scaled(box, config.faults.cell_box);
  }
}

Vec3 box_center(const std::vector<Corners>& corners) {
  Aabb box;
  for (const Corners& c : corners)
    for (const Vec3& p : c) box.extend(p);
  return box.center();
}

double safe_radius(const FfdModel& model, const FfdState& state, const SphereNode& sphere,
                   const Vec3& center, double slack) {
  double radius = 0.0;
  for (std::uint32_t cell : sphere.cells)
    for (std::uint32_t p = model.piece_begin[cell]; p < model.piece_begin[cell + 1]; ++p)
      radius = std::max(radius, covering_radius(center, state.corners[p], slack));
  return radius;
}

void place_spheres(const FfdModel& model, const FfdConfig& config, double error, FfdState& state) {
  const double slack = 2.0 * std::sqrt(3.0) * error;
  state.spheres.resize(model.spheres.levels.size());
  for (std::size_t level = 0; level < state.spheres.size(); ++level) {
    const std::vector<SphereNode>& rest = model.spheres.levels[level];
    state.spheres[level].resize(rest.size());
    for (std::size_t s = 0; s < rest.size(); ++s) {
      Sphere& sphere = state.spheres[level][s];
      sphere.center = level == 0 ? box_center(state.corners) : state.nodes[rest[s].center_node];
      sphere.radius = config.bounds == BoundsReading::kPaper
                          ? model.rest_radius[level][s]
                          : safe_radius(model, state, rest[s], sphere.center, slack);
      sphere.radius *= config.faults.sphere_radius;
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
  map_pieces(model, body.nodes, state.corners);
  const double error = mapping_error_bound(largest_coordinate(body.nodes));
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
