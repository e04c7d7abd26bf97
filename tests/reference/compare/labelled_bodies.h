// Bodies with labels written by hand, for judging answers that were never computed.
#pragma once

#include <memory>
#include <vector>

#include "core/deform/body.h"
#include "reference/compare/judge.h"

namespace contactcheck::test {

/// Four triangles, two cells: triangle 0 belongs to cell 0, triangle 1 to both, triangles 2 and 3
/// to cell 1.
inline Body labelled_body(const char* name, bool solid = true, bool in_lattice = true) {
  auto shape = std::make_shared<BodyShape>();
  shape->mesh.vertices.assign(3, Vec3::Zero());
  shape->mesh.triangles.assign(4, {0, 1, 2});
  shape->topology.solid = solid;
  if (in_lattice) shape->lattice.emplace();
  shape->embedding.label_begin = {0, 1, 3, 4, 5};
  shape->embedding.label_cells = {0, 0, 1, 1, 1};
  return {name, shape};
}

inline std::vector<Body> labelled_bodies() {
  return {labelled_body("first"), labelled_body("second"), labelled_body("third")};
}

inline Truth truth_of(std::vector<ElementPair> triangles) {
  Truth truth;
  truth.surface.triangles = std::move(triangles);
  truth.surface.canonicalize();
  return truth;
}

}  // namespace contactcheck::test
