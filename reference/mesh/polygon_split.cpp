#include "reference/mesh/polygon_split.h"

#include <algorithm>
#include <utility>

#include "core/narrow/predicates.h"

namespace contactcheck::mesh {
namespace {

using Corners = std::span<const std::uint32_t>;

struct OutlineView {
  int axis = 0;         // along which one looks
  int orientation = 1;  // of the polygon, seen so; rounded, so it may be wrong for slivers
};

// Differences from the first corner, a quarter and then at most 1 large: nothing overflows.
std::vector<Vec3> shape_of(const std::vector<Vec3>& points, Corners corners) {
  const Vec3 origin = 0.25 * points[corners[0]];
  std::vector<Vec3> out;
  double largest = 0.0;
  for (const std::uint32_t corner : corners) {
    out.emplace_back(0.25 * points[corner] - origin);
    largest = std::max(largest, out.back().cwiseAbs().maxCoeff());
  }
  if (largest > 0.0)
    for (Vec3& v : out) v /= largest;
  return out;
}

// Where both lobes of an eight cancel, the axis along which most of them is seen.
OutlineView view_of(const std::vector<Vec3>& points, Corners corners) {
  const std::vector<Vec3> shape = shape_of(points, corners);
  Vec3 normal = Vec3::Zero(), seen = Vec3::Zero();
  for (std::size_t k = 2; k < shape.size(); ++k) {
    const Vec3 twice_area = shape[k - 1].cross(shape[k]);
    normal += twice_area;
    seen += twice_area.cwiseAbs();
  }
  OutlineView out;
  (normal == Vec3::Zero() ? seen : Vec3(normal.cwiseAbs())).maxCoeff(&out.axis);
  out.orientation = normal[out.axis] < 0.0 ? -1 : 1;
  return out;
}

std::vector<Triangle> fan_of(Corners corners) {
  std::vector<Triangle> out;
  for (std::size_t k = 2; k < corners.size(); ++k)
    out.push_back({corners[0], corners[k - 1], corners[k]});
  return out;
}

class Outline {
 public:
  Outline(const std::vector<Vec3>& points, Corners ring, const OutlineView& view)
      : points_(points), ring_(ring.begin(), ring.end()), view_(view) {}

  // Two edges have a point in common that ends neither. Others may touch: a bridge to a hole does.
  bool crosses_itself() const {
    for (std::size_t i = 0; i < ring_.size(); ++i)
      for (std::size_t j = i + 2; j < ring_.size(); ++j)
        if (cross(ring_[i], ring_[next(i)], ring_[j], ring_[next(j)])) return true;
    return false;
  }

  std::optional<std::vector<Triangle>> clipped() {
    std::vector<Triangle> out;
    std::size_t at = 0;
    for (std::size_t in_vain = 0; ring_.size() > 2; at = next(at)) {
      if (!is_ear(at)) {
        if (++in_vain == ring_.size()) return std::nullopt;
        continue;
      }
      out.push_back({ring_[before(at)], ring_[at], ring_[next(at)]});
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(at));
      at = at < ring_.size() ? at : 0;
      in_vain = 0;
    }
    return out;
  }

 private:
  std::size_t next(std::size_t i) const { return i + 1 < ring_.size() ? i + 1 : 0; }
  std::size_t before(std::size_t i) const { return (i > 0 ? i : ring_.size()) - 1; }

  int side(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return view_.orientation * orient2d(points_[a], points_[b], points_[c], view_.axis);
  }
  bool same_place(std::uint32_t a, std::uint32_t b) const {
    const int first = (view_.axis + 1) % 3, second = (view_.axis + 2) % 3;
    return points_[a][first] == points_[b][first] && points_[a][second] == points_[b][second];
  }
  bool cross(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
  }

  // A triangle of the polygon's own turn that no part of the outline enters. Corners at the place
  // of one of its own do not count; what leaves them into the triangle ends there or crosses
  // (a, c).
  bool is_ear(std::size_t at) const {
    const std::uint32_t a = ring_[before(at)], b = ring_[at], c = ring_[next(at)];
    if (same_place(a, b) || same_place(b, c)) return true;  // a corner twice: as in a fan, a line
    if (side(a, b, c) <= 0) return false;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const std::uint32_t p = ring_[i];
      const bool own = same_place(p, a) || same_place(p, b) || same_place(p, c);
      if (!own && side(a, b, p) >= 0 && side(b, c, p) >= 0 && side(c, a, p) >= 0) return false;
      if (cross(a, c, p, ring_[next(i)])) return false;
    }
    return true;
  }

  const std::vector<Vec3>& points_;
  std::vector<std::uint32_t> ring_;
  OutlineView view_;
};

bool fan_fits(const std::vector<Vec3>& points, Corners corners, int axis) {
  bool left = false, right = false;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const int sign = orient2d(points[corners[0]], points[corners[k - 1]], points[corners[k]], axis);
    left |= sign > 0;
    right |= sign < 0;
  }
  return !(left && right);
}

}  // namespace

std::optional<SplitPolygon> split_polygon(const std::vector<Vec3>& points, Corners corners) {
  if (corners.size() == 3) return SplitPolygon{fan_of(corners), false};
  OutlineView view = view_of(points, corners);
  const bool fits = fan_fits(points, corners, view.axis),
             many = corners.size() > kMostConcaveCorners;
  // A fan that winds round its corner more than once is turned one way, too; not that of a quad.
  const bool crosses =
      !many && (!fits || corners.size() > 4) && Outline(points, corners, view).crosses_itself();
  if (fits && !crosses) return SplitPolygon{fan_of(corners), false};
  if (many || crosses) return std::nullopt;
  // All ears have one turn, the polygon's own: with the other one they cannot use it up.
  for (int attempt = 0; attempt < 2; ++attempt, view.orientation = -view.orientation)
    if (auto ears = Outline(points, corners, view).clipped())
      return SplitPolygon{std::move(*ears), true};
  return std::nullopt;
}

}  // namespace contactcheck::mesh
