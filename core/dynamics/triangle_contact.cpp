#include "core/dynamics/triangle_contact.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/dynamics/unit_vector.h"

namespace contactcheck {
namespace {

// Twice the area over the squared longest edge coordinate. Thinner triangles are treated as the
// segments that they nearly are: rounding of the corners may turn their normals by degrees.
constexpr double kLeastRelativeArea = 1e-12;
// Length of the difference of two unit normals; 1e-3: they enclose a sixteenth of a degree. Below
// it the triangles face the same way and their difference says nothing about which way is out.
constexpr double kLeastNormalDifference = 1e-3;

Vec3 centroid(const TrianglePoints& t) { return (t[0] + t[1] + t[2]) / 3.0; }

double longest_edge(const TrianglePoints& t) {
  return std::max(
      {ordered_norm(t[1] - t[0]), ordered_norm(t[2] - t[1]), ordered_norm(t[0] - t[2])});
}

// Zero for a triangle without a plane.
Vec3 unit_normal(const TrianglePoints& t) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const double largest = std::max(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff());
  if (!(largest > 0.0)) return Vec3::Zero();
  const Vec3 normal = (u / largest).cross(v / largest);
  return ordered_norm(normal) > kLeastRelativeArea ? unit_or_zero(normal) : Vec3::Zero();
}

Vec3 separating_direction(const TrianglePoints& a, const Vec3& normal_a, const TrianglePoints& b,
                          const Vec3& normal_b) {
  const Vec3 difference = normal_a - normal_b;
  if (ordered_norm(difference) > kLeastNormalDifference) return unit_or_zero(difference);
  // Two flush faces, as of boxes side by side that overlap: away is where the other is.
  return unit_or_zero(centroid(b) - centroid(a));
}

// How far the corners reach behind a plane; infinity without one: it bounds nothing.
double reach_behind(const TrianglePoints& t, const Vec3& point, const Vec3& normal) {
  if (normal.isZero(0.0)) return std::numeric_limits<double>::infinity();
  double deepest = 0.0;
  for (const Vec3& corner : t) deepest = std::max(deepest, ordered_dot(normal, point - corner));
  return deepest;
}

double separation_depth(const TrianglePoints& a, const Vec3& normal_a, const TrianglePoints& b,
                        const Vec3& normal_b) {
  if (normal_a.isZero(0.0) && normal_b.isZero(0.0)) return 0.0;
  const double depth = std::min(reach_behind(a, b[0], normal_b), reach_behind(b, a[0], normal_a));
  // Triangles that do cross keep within this by themselves; a detector may name others.
  return std::min({depth, longest_edge(a), longest_edge(b)});
}

// The part of a line that a triangle covers, by a parameter along the line.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  Vec3 at_low = Vec3::Zero(), at_high = Vec3::Zero();

  bool empty() const { return low > high; }
  void extend(double parameter, const Vec3& point) {
    if (parameter < low) low = parameter, at_low = point;
    if (parameter > high) high = parameter, at_high = point;
  }
};

// The parameter is measured from `origin`.
Span cut_by_plane(const TrianglePoints& t, const Vec3& point, const Vec3& normal, const Vec3& line,
                  const Vec3& origin) {
  std::array<double, 3> side;
  for (int i = 0; i < 3; ++i) side[i] = ordered_dot(normal, t[i] - point);
  Span span;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (side[i] == 0.0) span.extend(ordered_dot(line, t[i] - origin), t[i]);
    if ((side[i] < 0.0 && side[j] > 0.0) || (side[i] > 0.0 && side[j] < 0.0)) {
      const Vec3 cut = t[i] + (t[j] - t[i]) * (side[i] / (side[i] - side[j]));
      span.extend(ordered_dot(line, cut - origin), cut);
    }
  }
  return span;
}

// The middle of the segment in which two triangles cross; none where doubles show no crossing.
std::optional<Vec3> crossing(const TrianglePoints& a, const Vec3& normal_a, const TrianglePoints& b,
                             const Vec3& normal_b) {
  const Vec3 line = normal_a.cross(normal_b);
  if (line.isZero(0.0)) return std::nullopt;
  const Span on_a = cut_by_plane(a, b[0], normal_b, line, a[0]);
  const Span on_b = cut_by_plane(b, a[0], normal_a, line, a[0]);
  if (on_a.empty() || on_b.empty()) return std::nullopt;
  // Where rounding leaves a gap between the spans of triangles that touch, its ends are as good.
  return 0.5 * ((on_a.low > on_b.low ? on_a.at_low : on_b.at_low) +
                (on_a.high < on_b.high ? on_a.at_high : on_b.at_high));
}

Vec3 point_at(const Barycentric& w, const TrianglePoints& t) {
  return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
}

// Without a crossing (one plane, or no plane): halfway between the points that each triangle has
// nearest to the other's centroid.
Vec3 halfway(const TrianglePoints& a, const TrianglePoints& b) {
  return 0.5 * (point_at(nearest_on_triangle(centroid(b), a), a) +
                point_at(nearest_on_triangle(centroid(a), b), b));
}

// Weights of the orthogonal projection; none for a triangle without area or a projection outside.
std::optional<Barycentric> projected_inside(const Vec3& point, const TrianglePoints& t) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], from = point - t[0];
  const Vec3 normal = u.cross(v);
  const double scale = ordered_dot(normal, normal);
  if (!(scale > 0.0)) return std::nullopt;
  const double w1 = ordered_dot(from.cross(v), normal) / scale,
               w2 = ordered_dot(u.cross(from), normal) / scale;
  const double w0 = 1.0 - w1 - w2;
  if (!(w0 >= 0.0 && w1 >= 0.0 && w2 >= 0.0)) return std::nullopt;
  return Barycentric{w0, w1, w2};
}

Barycentric nearest_on_edge(const Vec3& point, const TrianglePoints& t, int from, int to) {
  const Vec3 edge = t[to] - t[from];
  const double scale = ordered_dot(edge, edge);
  const double along =
      scale > 0.0 ? std::clamp(ordered_dot(edge, point - t[from]) / scale, 0.0, 1.0) : 0.0;
  Barycentric weights = {};
  weights[from] = 1.0 - along;
  weights[to] = along;
  return weights;
}

}  // namespace

Barycentric nearest_on_triangle(const Vec3& point, const TrianglePoints& triangle) {
  if (const auto inside = projected_inside(point, triangle)) return *inside;
  Barycentric nearest = {1.0, 0.0, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Barycentric candidate = nearest_on_edge(point, triangle, i, (i + 1) % 3);
    const double distance = ordered_norm(point_at(candidate, triangle) - point);
    if (distance < least) least = distance, nearest = candidate;
  }
  return nearest;
}

TriangleContact triangle_contact(const TrianglePoints& a, const TrianglePoints& b) {
  const Vec3 normal_a = unit_normal(a), normal_b = unit_normal(b);
  TriangleContact out;
  out.normal = separating_direction(a, normal_a, b, normal_b);
  out.depth = separation_depth(a, normal_a, b, normal_b);
  const std::optional<Vec3> crossed = crossing(a, normal_a, b, normal_b);
  const Vec3 middle = crossed ? *crossed : halfway(a, b);
  out.on_a = nearest_on_triangle(middle, a);
  out.on_b = nearest_on_triangle(middle, b);
  return out;
}

}  // namespace contactcheck
