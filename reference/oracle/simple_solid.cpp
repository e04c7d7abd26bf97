// Winding numbers beside a triangle: those at a point just off its centroid, on either side. The
// centroid is a rational point; a ray from it along an axis that crosses the triangle, displaced by
// (e, e^2) in the other two coordinates as in vertex_queries.cpp, meets what lies beyond on one
// side. Without self-contact no other triangle but duplicates contains the centroid.
//
// Where an edge has two triangles, the winding numbers beside one are those beside the other: only
// one triangle of each patch that such edges connect is asked.
#include "reference/oracle/simple_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "core/types/mesh_topology.h"
#include "core/types/shared_corners.h"
#include "reference/oracle/exact_tests.h"
#include "reference/oracle/rational_geometry.h"

namespace contactcheck::oracle {
namespace {

/// The edges of triangles whose vertices are welded.
class WeldedSurface {
 public:
  WeldedSurface(const SurfaceTree& tree, std::span<const Triangle> triangles,
                const std::vector<std::uint32_t>& welded)
      : tree_(tree), triangles_(triangles.begin(), triangles.end()) {
    for (Triangle& t : triangles_)
      for (std::uint32_t& vertex : t) vertex = welded[vertex];
  }

  bool has_self_contact() const;
  std::optional<NotSimple> winding_fault() const;

 private:
  bool is_proper(std::uint32_t t) const {
    const TriangleCorners c = tree_.corners(t);
    return !collinear(c[0], c[1], c[2]);
  }
  std::vector<std::uint32_t> one_of_each_patch() const;
  std::pair<int, int> winding_beside(std::uint32_t triangle) const;

  const SurfaceTree& tree_;
  std::vector<Triangle> triangles_;
};

bool WeldedSurface::has_self_contact() const {
  try {
    refuse_many_adjacent_pairs(triangles_);
  } catch (const RefusedInput&) {
    return true;
  }
  return any_own_box_pair(tree_, [&](std::uint32_t i, std::uint32_t j) {
    return meet_beyond_shared(triangles_[i], tree_.corners(i), triangles_[j], tree_.corners(j));
  });
}

// Triangles with area that edges of just two such triangles connect.
std::vector<std::uint32_t> WeldedSurface::one_of_each_patch() const {
  struct Side {
    std::array<std::uint32_t, 2> edge;
    std::uint32_t triangle;
  };
  std::vector<std::uint32_t> patch(triangles_.size());
  std::iota(patch.begin(), patch.end(), 0u);
  std::vector<Side> sides;
  std::vector<std::uint32_t> proper;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (!is_proper(t)) continue;
    proper.push_back(t);
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles_[t][k], triangles_[t][(k + 1) % 3]);
      sides.push_back({{low, high}, t});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& x, const Side& y) { return x.edge < y.edge; });
  const auto root = [&](std::uint32_t t) {
    while (patch[t] != t) t = patch[t] = patch[patch[t]];
    return t;
  };
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
    if (end - i == 2) patch[root(sides[i].triangle)] = root(sides[i + 1].triangle);
  }
  std::erase_if(proper, [&](std::uint32_t t) { return patch[t] != t; });
  return proper;
}

int turn_along(const rational::Point& a, const rational::Point& b, const rational::Point& p,
               int axis) {
  const int y = (axis + 1) % 3, z = (axis + 2) % 3;
  const mpq_class turn = (b[y] - a[y]) * (p[z] - a[z]) - (b[z] - a[z]) * (p[y] - a[y]);
  if (const int side = sgn(turn)) return side;
  if (const int by_y = cmp(a[z], b[z])) return by_y > 0 ? 1 : -1;
  return sgn(mpq_class(b[y] - a[y]));
}

// +1 when the ray from p along the axis leaves through the triangle, -1 when it enters; the line's
// crossing anywhere with `both_ways`.
int crossing(const rational::PointTriple& t, const rational::Point& p, int axis, bool both_ways) {
  const int side = turn_along(t[0], t[1], p, axis);
  if (side == 0 || turn_along(t[1], t[2], p, axis) != side ||
      turn_along(t[2], t[0], p, axis) != side)
    return 0;
  if (both_ways) return side;
  using rational::operator-;
  const mpq_class height = rational::dot(rational::cross(t[1] - t[0], t[2] - t[0]), p - t[0]);
  return sgn(height) == -side ? side : 0;
}

// An interval of doubles round each coordinate.
Aabb box_around(const rational::Point& p) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Aabb out;
  for (int k = 0; k < 3; ++k) {
    out.lo[k] = std::nextafter(p[k].get_d(), -kInfinity);
    out.hi[k] = std::nextafter(p[k].get_d(), kInfinity);
  }
  return out;
}

// Beyond the triangle along an axis that crosses it, and before it.
std::pair<int, int> WeldedSurface::winding_beside(std::uint32_t triangle) const {
  const TriangleCorners corners = tree_.corners(triangle);
  int axis = 0;
  while (projected_orientation(corners[0], corners[1], corners[2], axis) == 0) ++axis;
  const rational::PointTriple exact = rational::to_rational(corners);
  rational::Point center;
  for (int k = 0; k < 3; ++k) center[k] = (exact[0][k] + exact[1][k] + exact[2][k]) / 3;
  Aabb ray = box_around(center);
  ray.hi[axis] = std::numeric_limits<double>::infinity();
  int beyond = 0, through = 0;
  any_triangle(
      tree_, [&](const Aabb& box) { return box.overlaps(ray); },
      [&](std::uint32_t other) {
        const rational::PointTriple t = rational::to_rational(tree_.corners(other));
        const bool same = shared_corners(triangles_[triangle], triangles_[other]).duplicates;
        (same ? through : beyond) += crossing(t, center, axis, same);
        return false;
      });
  return {beyond, beyond + through};
}

std::optional<NotSimple> WeldedSurface::winding_fault() const {
  for (const std::uint32_t t : one_of_each_patch()) {
    const auto [beyond, before] = winding_beside(t);
    if (beyond == before) return NotSimple::kNoInterior;
    if (beyond * before != 0 || std::abs(beyond + before) != 1) return NotSimple::kNested;
  }
  return std::nullopt;
}

}  // namespace

const char* name_of(NotSimple kind) {
  constexpr std::array kNames = {"open", "self-contact", "no interior", "nested"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string describe(const SolidFault& fault, const GivenVertices& given) {
  return fault.kind == NotSimple::kOpen ? open_reason(fault.edge, given) : name_of(fault.kind);
}

std::optional<SolidFault> solid_fault(const SurfaceTree& tree, std::span<const Triangle> triangles,
                                      std::span<const Vec3> vertices) {
  const SurfaceChain chain = surface_chain(triangles, vertices);
  if (chain.open) return SolidFault{NotSimple::kOpen, *chain.open};
  const WeldedSurface surface(tree, triangles, chain.welded);
  if (surface.has_self_contact()) return SolidFault{NotSimple::kSelfContact, {}};
  if (const auto kind = surface.winding_fault()) return SolidFault{*kind, {}};
  return std::nullopt;
}

}  // namespace contactcheck::oracle
