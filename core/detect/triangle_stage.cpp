#include "core/detect/triangle_stage.h"

#include "core/detect/seen_pairs.h"
#include "core/narrow/triangle_triangle.h"

namespace contactcheck {
namespace {

TrianglePoints points_of(const FfdModel& model, std::span<const Vec3> vertices, std::uint32_t t) {
  const Triangle& tri = model.shape->mesh.triangles[t];
  return {vertices[tri[0]], vertices[tri[1]], vertices[tri[2]]};
}

}  // namespace

void TriangleStage::begin_frame(const std::vector<FfdModel>& models, const Frame& frame) {
  vertices_.clear();
  for (const BodyState& body : frame.bodies) vertices_.push_back(body.vertices);
  boxes_.resize(models.size());
  for (std::size_t body = 0; body < models.size(); ++body) {
    boxes_[body].resize(models[body].piece_begin.size() - 1);
    for (CellBoxes& cell : boxes_[body]) cell.known = false;
  }
}

const TriangleStage::CellBoxes& TriangleStage::boxes(const std::vector<FfdModel>& models,
                                                     std::uint32_t body, std::uint32_t cell) {
  CellBoxes& out = boxes_[body][cell];
  if (out.known) return out;
  const auto row = models[body].triangles.row(cell);
  out.whole = Aabb{};
  out.triangles.resize(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    Aabb box;
    for (const Vec3& p : points_of(models[body], vertices_[body], row[i])) box.extend(p);
    out.triangles[i] = box;
    out.whole.extend(box);
  }
  out.known = true;
  return out;
}

void TriangleStage::collect(const std::vector<FfdModel>& models, std::uint32_t body,
                            std::uint32_t cell, const Aabb& region,
                            std::vector<std::uint32_t>& out) {
  out.clear();
  const CellBoxes& cell_boxes = boxes(models, body, cell);
  for (std::uint32_t i = 0; i < cell_boxes.triangles.size(); ++i)
    if (cell_boxes.triangles[i].overlaps(region)) out.push_back(i);
}

bool TriangleStage::test_pair(const std::vector<FfdModel>& models, const ElementPair& cells,
                              bool first_only, std::vector<ElementPair>& out) {
  const CellBoxes& a = boxes(models, cells.body_a, cells.a);
  const CellBoxes& b = boxes(models, cells.body_b, cells.b);
  if (!a.whole.overlaps(b.whole)) return false;
  collect(models, cells.body_a, cells.a, b.whole, near_a_);
  collect(models, cells.body_b, cells.b, a.whole, near_b_);
  const auto row_a = models[cells.body_a].triangles.row(cells.a);
  const auto row_b = models[cells.body_b].triangles.row(cells.b);
  bool any = false;
  for (std::uint32_t i : near_a_) {
    const TrianglePoints p = points_of(models[cells.body_a], vertices_[cells.body_a], row_a[i]);
    for (std::uint32_t j : near_b_) {
      if (!a.triangles[i].overlaps(b.triangles[j])) continue;
      if (!triangles_intersect(p,
                               points_of(models[cells.body_b], vertices_[cells.body_b], row_b[j])))
        continue;
      out.push_back({cells.body_a, cells.body_b, row_a[i], row_b[j]});
      if (first_only) return true;
      any = true;
    }
  }
  return any;
}

void TriangleStage::run(const std::vector<FfdModel>& models,
                        const std::vector<ElementPair>& candidates, bool first_only,
                        std::vector<ElementPair>& out) {
  SeenPairs seen(models.size());
  for (const ElementPair& c : candidates) {
    if (first_only && seen.seen(c.body_a, c.body_b)) continue;
    if (test_pair(models, c, first_only, out)) seen.mark(c.body_a, c.body_b);
  }
}

}  // namespace contactcheck
