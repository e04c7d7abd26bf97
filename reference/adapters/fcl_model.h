// A mesh as a model of FCL, whose errors are return codes.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "core/types/mesh.h"

namespace contactcheck::adapters {

/// @throws std::runtime_error unless `code`, which `call` returned, is FCL's success
inline void require_ok(int code, const char* call) {
  if (code == fcl::BVH_OK) return;
  throw std::runtime_error(std::string("FCL's ") + call + " returned " + std::to_string(code));
}

/// Fills `model` with `mesh` and builds its hierarchy. @throws std::runtime_error if FCL refuses
template <typename BV>
void build_model(fcl::BVHModel<BV>& model, const TriangleMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  const int triangle_count = static_cast<int>(mesh.triangles.size());
  const int vertex_count = static_cast<int>(mesh.vertices.size());
  require_ok(model.beginModel(triangle_count, vertex_count), "beginModel");
  require_ok(model.addSubModel(mesh.vertices, triangles), "addSubModel");
  require_ok(model.endModel(), "endModel");
}

}  // namespace contactcheck::adapters
