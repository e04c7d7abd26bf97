// Bodies with labels written by hand, for judging answers that were never computed.
#pragma once

#include <memory>
#include <vector>

#include "core/deform/body.h"
#include "reference/judge/judge.h"

namespace contactcheck::test {

/// Four triangles, two cells: triangle 0 belongs to cell 0, triangle 1 to both, triangles 2 and 3
/// to cell 1.
inline Body labelled_body(const char* name, bool in_lattice = true) {
  auto shape = std::make_shared<BodyShape>();
  shape->mesh.vertices.assign(3, Vec3::Zero());
  shape->mesh.triangles.assign(4, {0, 1, 2});
  if (in_lattice) shape->lattice.emplace();
  shape->embedding.label_begin = {0, 1, 3, 4, 5};
  shape->embedding.label_cells = {0, 0, 1, 1, 1};
  return {name, shape};
}

inline std::vector<Body> labelled_bodies() {
  return {labelled_body("first"), labelled_body("second"), labelled_body("third")};
}

inline oracle::Truth truth_of(std::vector<ElementPair> triangles) {
  oracle::Truth truth;
  truth.surface.triangles = std::move(triangles);
  truth.surface.canonicalize();
  return truth;
}

/// Compares the answer to one frame of labelled_bodies() at every level of `totals`.
inline void add_frame(judge::LevelTotals& totals, const Semantics& semantics, std::size_t frame,
                      const oracle::Truth& truth, const ContactSet& answer,
                      const judge::TrueNear& near = {}) {
  const std::vector<Body> bodies = labelled_bodies();
  for (const Level level : kFineToCoarse)
    if (totals.levels.count(level))
      totals.add(frame, level, judge::compare_at(level, bodies, semantics, truth, answer, near));
}

}  // namespace contactcheck::test
