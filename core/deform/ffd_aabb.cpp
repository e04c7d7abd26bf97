#include "core/deform/ffd_aabb.h"

#include <algorithm>
#include <array>

#include "core/deform/mapping.h"

namespace contactcheck {
namespace {

// Clipping a triangle by six planes leaves at most nine corners. Rounding may bend the polygon so
// that a plane within an ulp crosses it more than twice; a clip never makes more than 3/2 of its
// corners: 3, 4, 6, 9, 13, 19, 28.
struct Polygon {
  std::array<Vec3, 28> points;
  int size = 0;
  void push(const Vec3& p) { points[size++] = p; }
};

// Keeps the part of `in` where sign * (p[axis] - bound) <= 0 (Sutherland & Hodgman 1974).
Polygon clip(const Polygon& in, int axis, double bound, double sign) {
  Polygon out;
  for (int i = 0; i < in.size; ++i) {
    const Vec3& a = in.points[i];
    const Vec3& b = in.points[(i + 1) % in.size];
    const double da = sign * (a[axis] - bound), db = sign * (b[axis] - bound);
    if (da <= 0) out.push(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      Vec3 cut = a + (b - a) * (da / (da - db));
      cut[axis] = bound;
      out.push(cut);
    }
  }
  return out;
}

Vec3 to_local(const Vec3& p, const Aabb& cell) {
  return (p - cell.lo).cwiseQuotient(cell.hi - cell.lo);
}

Aabb clamp_to_unit(const Aabb& box) {
  Aabb out;
  out.lo = box.lo.cwiseMax(0.0).cwiseMin(1.0);
  out.hi = box.hi.cwiseMax(0.0).cwiseMin(1.0);
  return out;
}

bool lexicographically_less(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

Aabb clipped_bounds(std::array<Vec3, 3> local) {
  // In one order whatever the triangle's winding and first corner: a cut rounds.
  std::sort(local.begin(), local.end(), lexicographically_less);
  Polygon polygon;
  Aabb whole;
  for (const Vec3& p : local) {
    polygon.push(p);
    whole.extend(p);
  }
  // A cut rounds by 2^-52 of the triangle. Of one that is huge beside the cell, as beside a
  // recorded cell that is thin, the place of a cut would be anything, or no number.
  constexpr double kLargest = 0x1p20;
  if (!(whole.lo.cwiseAbs().maxCoeff() <= kLargest && whole.hi.cwiseAbs().maxCoeff() <= kLargest))
    return clamp_to_unit(whole);
  for (int axis = 0; axis < 3 && polygon.size > 0; ++axis) {
    polygon = clip(polygon, axis, 0.0, -1.0);
    if (polygon.size > 0) polygon = clip(polygon, axis, 1.0, 1.0);
  }
  // A triangle that only touches the cell may be rounded away: its own bounds, clamped, cover it.
  if (polygon.size == 0) return clamp_to_unit(whole);
  Aabb box;
  for (int i = 0; i < polygon.size; ++i) box.extend(polygon.points[i]);
  return clamp_to_unit(box);
}

}  // namespace

std::vector<Aabb> ffd_aabbs(const TriangleMesh& mesh, const Lattice& lattice,
                            const Embedding& embedding) {
  std::vector<Aabb> boxes(lattice.cells.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t cell : embedding.cells_of_triangle(t)) {
      const Aabb cell_box = lattice.cell_box(cell);
      std::array<Vec3, 3> local;
      for (int k = 0; k < 3; ++k)
        local[k] = to_local(mesh.vertices[mesh.triangles[t][k]], cell_box);
      boxes[cell].extend(clipped_bounds(local));
    }
  }
  // Home cells hold their vertices bit for bit, whatever clipping rounded.
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    boxes[embedding.home_cell[v]].extend(embedding.local[v]);
  return boxes;
}

Corners mapped_box(const Lattice& lattice, std::uint32_t cell, const Aabb& local,
                   std::span<const Vec3> nodes) {
  const LocalBox box{cell, local};
  Corners out;
  map_boxes(lattice, std::span(&box, 1), nodes, std::span(&out, 1));
  return out;
}

}  // namespace contactcheck
