#include "reference/oracle/cell_hulls.h"

#include <algorithm>

#include "core/deform/ffd_aabb.h"

namespace contactcheck::oracle {
namespace {

// The cells whose bounds meet `region`, by the lower end along x.
std::vector<std::uint32_t> cells_in(const CellHulls& body, const Aabb& region) {
  std::vector<std::uint32_t> cells;
  for (std::uint32_t cell = 0; cell < body.size(); ++cell)
    if (body.box(cell).overlaps(region)) cells.push_back(cell);
  std::sort(cells.begin(), cells.end(), [&](std::uint32_t i, std::uint32_t j) {
    return body.box(i).lo.x() < body.box(j).lo.x();
  });
  return cells;
}

// Visits each pair of boxes that overlap along x once, at the one of the two that begins later.
template <typename Visit>
void sweep(const CellHulls& a, const CellHulls& b, Visit&& visit) {
  const std::vector<std::uint32_t> in_a = cells_in(a, b.bounds());
  const std::vector<std::uint32_t> in_b = cells_in(b, a.bounds());
  std::size_t begin_a = 0, begin_b = 0;
  while (begin_a < in_a.size() && begin_b < in_b.size()) {
    const Aabb& box_a = a.box(in_a[begin_a]);
    const Aabb& box_b = b.box(in_b[begin_b]);
    if (box_a.lo.x() <= box_b.lo.x()) {
      for (std::size_t j = begin_b; j < in_b.size() && b.box(in_b[j]).lo.x() <= box_a.hi.x(); ++j)
        visit(in_a[begin_a], in_b[j]);
      ++begin_a;
    } else {
      for (std::size_t i = begin_a; i < in_a.size() && a.box(in_a[i]).lo.x() <= box_b.hi.x(); ++i)
        visit(in_a[i], in_b[begin_b]);
      ++begin_b;
    }
  }
}

}  // namespace

CellHulls::CellHulls(std::shared_ptr<const BodyShape> shape) : shape_(std::move(shape)) {
  const std::optional<Lattice>& lattice = shape_->lattice;
  if (!lattice) return;
  local_ = ffd_aabbs(shape_->mesh, *lattice, shape_->embedding);
  corners_.resize(local_.size());
  boxes_.resize(local_.size());
  hulls_.resize(local_.size());
}

void CellHulls::update(std::span<const Vec3> nodes) {
  bounds_ = Aabb();
  const std::optional<Lattice>& lattice = shape_->lattice;
  if (!lattice) return;
  for (std::uint32_t cell = 0; cell < local_.size(); ++cell) {
    corners_[cell] = mapped_box(*lattice, cell, local_[cell], nodes);
    boxes_[cell] = Aabb();
    for (const Vec3& p : corners_[cell]) boxes_[cell].extend(p);
    bounds_.extend(boxes_[cell]);
    hulls_[cell].reset();
  }
}

const ConvexHull& CellHulls::hull(std::uint32_t cell) {
  std::optional<ConvexHull>& made = hulls_[cell];
  if (!made) made = make_hull(corners_[cell]);
  return *made;
}

void overlapping_cells(CellHulls& a, CellHulls& b, std::vector<CellPair>& out) {
  if (!a.bounds().overlaps(b.bounds())) return;
  sweep(a, b, [&](std::uint32_t i, std::uint32_t j) {
    if (a.box(i).overlaps(b.box(j)) && hulls_overlap(a.hull(i), b.hull(j))) out.push_back({i, j});
  });
}

}  // namespace contactcheck::oracle
