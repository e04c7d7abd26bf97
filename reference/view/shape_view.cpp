#include "reference/view/shape_view.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "core/detect/ffd_model.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

template <std::size_t N>
std::vector<std::uint32_t> flat(const std::vector<std::array<std::uint32_t, N>>& rows) {
  std::vector<std::uint32_t> out;
  out.reserve(N * rows.size());
  for (const auto& row : rows) out.insert(out.end(), row.begin(), row.end());
  return out;
}

// Boxes and spheres are those of ffd-aabb-sphere and ffd-aabb-sphere2 as the paper has them; both
// have the same sphere of level 1.
FfdModel paper_model(const BodyShape& shape) {
  FfdConfig config;
  config.sphere_levels = 2;
  return make_ffd_model(shape, config);
}

// The paper's reading has one piece per kept cell, in their order.
std::vector<Vec3> local_boxes(const FfdModel& model) {
  std::vector<Vec3> out;
  for (const FfdPiece& piece : model.pieces) {
    out.push_back(piece.local.lo);
    out.push_back(piece.local.hi);
  }
  return out;
}

Json spheres_view(const FfdModel& model, ViewBuffers& buffers) {
  std::vector<std::uint32_t> centers;
  for (const SphereNode& sphere : model.spheres.levels[1]) centers.push_back(sphere.center_node);
  Json radii = Json::array();
  for (double radius : model.rest_radius[1]) radii.push_back(radius);
  return {{"radius1", model.rest_radius[0][0]},
          {"centers2", buffers.ids(centers)},
          {"radii2", std::move(radii)}};
}

Json lattice_view(const BodyShape& shape, ViewBuffers& buffers) {
  const FfdModel model = paper_model(shape);
  Json out;
  out["cell_nodes"] = buffers.ids(flat(shape.lattice->cell_nodes));
  out["home"] = buffers.ids(shape.embedding.home_cell);
  out["local"] = buffers.points(shape.embedding.local);
  out["boxes"] = buffers.points(local_boxes(model));
  out["spheres"] = spheres_view(model, buffers);
  return out;
}

}  // namespace

Json shape_view(const BodyShape& shape, ViewBuffers& buffers) {
  Json out = {{"vertices", shape.mesh.vertices.size()}, {"nodes", shape.node_count()}};
  out["triangles"] = buffers.ids(flat(shape.mesh.triangles));
  if (shape.lattice) out["lattice"] = lattice_view(shape, buffers);
  return out;
}

}  // namespace contactcheck
