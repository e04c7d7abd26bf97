#include "core/lazy/triangle_rest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/broad/aabb_tree.h"
#include "core/broad/adjacent_pairs.h"
#include "core/lazy/lazy_state.h"
#include "core/narrow/adjacent_triangles.h"
#include "core/narrow/triangle_triangle.h"

namespace contactcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Error of a measured distance, relative to the longest edge: between nearly parallel edges the
// distance of two of their points is taken, which is too large by up to this.
constexpr double kRounding = 1e-5;
// Measured for one triangle. With more about it, as in a bundle of needles, nothing is claimed.
constexpr int kMostMeasured = 200;
// Least longest edge, in the scale of the body: products of four lengths of such a triangle, with
// the least altitude allowed, are still normal doubles. For smaller triangles nothing is claimed.
constexpr double kLeastEdge = 0x1p-200;

// 1 / sin(angle / 2) of the angle with this cosine.
double inverse_half_sine(double cosine) {
  const double square = 0.5 * (1.0 - std::min(1.0, cosine + 1e-12));
  return square > 0.0 ? 1.0 / std::sqrt(square) : kInfinity;
}

TriangleRest lone_triangle(const TrianglePoints& p) {
  TriangleRest out;
  double smallest_cosine = 1.0, edges[3];
  for (int i = 0; i < 3; ++i) {
    const Vec3 u = p[(i + 1) % 3] - p[i], v = p[(i + 2) % 3] - p[i];
    edges[i] = u.norm();
    smallest_cosine = std::min(smallest_cosine, u.dot(v) / (u.norm() * v.norm()));
    out.edge = std::max(out.edge, edges[i]);
  }
  const double twice_area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
  out.altitude = twice_area / out.edge;
  const double square = 0.5 * (1.0 + smallest_cosine - 1e-12);  // cosine of half the angle, squared
  out.stretch =
      square > 1e-6 && out.altitude > 1e-6 * out.edge ? 1.0 / std::sqrt(square) : kInfinity;
  out.gap = out.edge >= kLeastEdge ? out.edge : 0.0;
  return out;
}

// The largest cosine between directions of two wedges at one corner, each spanned by two edges. It
// is attained at an edge of one of them: between inner directions there is a saddle.
double largest_cosine(const std::array<Vec3, 2>& p, const std::array<Vec3, 2>& q) {
  double out = -1.0;
  for (const Vec3& a : p)
    for (const Vec3& b : q) out = std::max(out, a.dot(b));
  const auto against_inside = [&out](const Vec3& ray, const std::array<Vec3, 2>& wedge) {
    const Vec3 normal = wedge[0].cross(wedge[1]);
    const double area = normal.squaredNorm();
    if (!(area > 0.0)) return;
    const Vec3 foot = ray - normal * (ray.dot(normal) / area);
    const double along = foot.norm();
    // A little beyond the wedge counts as inside: a larger cosine is safe.
    if (wedge[0].cross(foot).dot(normal) >= -1e-9 * area &&
        foot.cross(wedge[1]).dot(normal) >= -1e-9 * area)
      out = std::max(out, along);
  };
  for (const Vec3& a : p) against_inside(a, q);
  for (const Vec3& b : q) against_inside(b, p);
  return out;
}

double ratio_at_corner(const TrianglePoints& p, const TrianglePoints& q,
                       const SharedCorners& shared) {
  const Vec3& corner = p[shared.p[0]];
  const auto rays = [&](const TrianglePoints& t, const std::array<std::uint8_t, 3>& order) {
    return std::array<Vec3, 2>{(t[order[1]] - corner).normalized(),
                               (t[order[2]] - corner).normalized()};
  };
  return inverse_half_sine(largest_cosine(rays(p, shared.p), rays(q, shared.q)));
}

// Folded at the edge, a distance shrinks to no less than sin(angle / 2) of that in the unfolded
// plane. There the straight path may pass an end of the edge; by way of that end it is longer by
// 1 / sin(half of the two angles there).
double ratio_at_edge(const TrianglePoints& p, const TrianglePoints& q,
                     const SharedCorners& shared) {
  const Vec3 &a = p[shared.p[0]], &b = p[shared.p[1]], &c = p[shared.p[2]], &d = q[shared.q[2]];
  const Vec3 along = (b - a).normalized();
  const auto across = [&](const Vec3& x) {
    const Vec3 from_a = x - a;
    return (from_a - along * from_a.dot(along)).normalized();
  };
  double out = inverse_half_sine(across(c).dot(across(d)));
  for (const bool at_a : {true, false}) {
    const Vec3& end = at_a ? a : b;
    const Vec3 direction = at_a ? along : Vec3(-along);
    const auto angle = [&](const Vec3& x) {
      const Vec3 u = (x - end).normalized();
      return std::array{u.dot(direction), u.cross(direction).norm()};  // cosine, sine
    };
    const auto [cos_c, sin_c] = angle(c);
    const auto [cos_d, sin_d] = angle(d);
    const double sine = sin_c * cos_d + cos_c * sin_d, cosine = cos_c * cos_d - sin_c * sin_d;
    if (sine <= 1e-12) out *= inverse_half_sine(cosine);
  }
  return out;
}

double segment_distance(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
  const Vec3 u = p1 - p0, v = q1 - q0, w = p0 - q0;
  const double a = u.dot(u), b = u.dot(v), c = v.dot(v), d = u.dot(w), e = v.dot(w);
  const double denominator = a * c - b * b;
  double s =
      denominator > 1e-12 * a * c ? std::clamp((b * e - c * d) / denominator, 0.0, 1.0) : 0.0;
  double t = c > 0.0 ? (b * s + e) / c : 0.0;
  if (t < 0.0 || t > 1.0) {
    t = std::clamp(t, 0.0, 1.0);
    s = a > 0.0 ? std::clamp((b * t - d) / a, 0.0, 1.0) : 0.0;
  }
  return (w + s * u - t * v).norm();
}

double point_distance(const Vec3& p, const TrianglePoints& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = normal.squaredNorm();
  if (!(area > 0.0)) return kInfinity;  // its edges are looked at
  for (int k = 0; k < 3; ++k)
    if ((t[(k + 1) % 3] - t[k]).cross(p - t[k]).dot(normal) < 0.0) return kInfinity;
  return std::abs((p - t[0]).dot(normal)) / std::sqrt(area);
}

// The distance of triangles that share no point, computed in doubles.
double triangle_distance(const TrianglePoints& p, const TrianglePoints& q) {
  double out = kInfinity;
  for (int i = 0; i < 3; ++i) {
    out = std::min({out, point_distance(p[i], q), point_distance(q[i], p)});
    for (int j = 0; j < 3; ++j)
      out = std::min(out, segment_distance(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]));
  }
  return out;
}

// A lower bound of the distance between their contents.
double box_distance(const Aabb& a, const Aabb& b) {
  const Vec3 apart = (a.lo - b.hi).cwiseMax(b.lo - a.hi).cwiseMax(Vec3::Zero());
  return apart.norm() * (1 - 1e-6);  // rounding
}

// A body with its vertices times rest_scale().
struct ScaledBody {
  const BodyShape& shape;
  std::vector<Vec3> vertices;

  explicit ScaledBody(const BodyShape& body) : shape(body), vertices(body.mesh.vertices) {
    const double scale = rest_scale(body);
    for (Vec3& v : vertices) v *= scale;
  }
  TrianglePoints points(std::uint32_t triangle) const {
    const Triangle& corners = shape.mesh.triangles[triangle];
    return {vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]};
  }
};

// The gaps of triangles that share nothing, each at most its own longest edge: branch and bound for
// every triangle, the nearer box first.
class GapSearch {
 public:
  GapSearch(const ScaledBody& body, std::vector<TriangleRest>& rest)
      : body_(body),
        rest_(rest),
        boxes_(std::make_shared<TriangleTree>(make_triangle_tree(body.shape.mesh, 4))),
        tree_(boxes_.tree()) {
    boxes_.refit(body.vertices);
    for (const TriangleRest& triangle : rest) longest_ = std::max(longest_, triangle.edge);
  }

  void run() {
    for (std::uint32_t slot = 0; slot < tree_.ids.size(); ++slot) search_around(slot);
  }

 private:
  bool too_far(double least, double gap) const {
    return gap == 0.0 || least >= gap + kRounding * longest_;
  }

  void search_around(std::uint32_t own) {
    double& gap = rest_[tree_.ids[own]].gap;
    const Aabb& box = boxes_.triangle_box(own);
    int measured = 0;
    stack_.assign(1, {0.0, 0});
    while (!stack_.empty()) {
      const auto [least, index] = stack_.back();
      stack_.pop_back();
      if (too_far(least, gap)) continue;
      const TriangleTree::Node& node = tree_.nodes[index];
      if (!node.leaf()) {
        std::pair far{box_distance(box, boxes_.box(node.first)), node.first};
        std::pair near{box_distance(box, boxes_.box(node.first + 1)), node.first + 1};
        if (far.first < near.first) std::swap(far, near);
        stack_.insert(stack_.end(), {far, near});
        continue;
      }
      for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)
        if (slot != own && !too_far(box_distance(box, boxes_.triangle_box(slot)), gap))
          measured += measure(own, slot) ? 1 : 0;
      if (measured > kMostMeasured) gap = 0.0;
    }
  }

  // Updates the gaps of both, which shortens the other's search. False: they share a vertex.
  bool measure(std::uint32_t own, std::uint32_t slot) {
    const std::uint32_t s = tree_.ids[own], t = tree_.ids[slot];
    const std::vector<Triangle>& linked = body_.shape.linked();
    const SharedCorners shared = shared_corners(linked[s], linked[t]);
    if (shared.count > 0 && !shared.duplicates) return false;
    const TrianglePoints p = body_.points(s), q = body_.points(t);
    const bool meet =
        boxes_.triangle_box(own).overlaps(boxes_.triangle_box(slot)) && triangles_intersect(p, q);
    const double rounding = kRounding * std::max(rest_[s].edge, rest_[t].edge);
    const double distance = meet ? 0.0 : std::max(0.0, triangle_distance(p, q) - rounding);
    for (TriangleRest* either : {&rest_[s], &rest_[t]})
      either->gap = std::isnan(distance) ? 0.0 : std::min(either->gap, distance);
    return true;
  }

  const ScaledBody& body_;
  std::vector<TriangleRest>& rest_;
  AabbTree boxes_;
  const TriangleTree& tree_;
  double longest_ = 0.0;
  std::vector<std::pair<double, std::uint32_t>> stack_;  // distance of the box, node
};

}  // namespace

double rest_scale(const BodyShape& shape) {
  double largest = 0.0;
  for (const Vec3& v : shape.mesh.vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  return scale_to_one(largest);
}

std::vector<TriangleRest> triangles_at_rest(const BodyShape& shape) {
  const ScaledBody body(shape);
  std::vector<TriangleRest> out;
  for (std::uint32_t t = 0; t < shape.mesh.triangles.size(); ++t)
    out.push_back(lone_triangle(body.points(t)));
  for (const AdjacentPair& pair : adjacent_pairs(shape.linked())) {
    const TrianglePoints p = body.points(pair.a), q = body.points(pair.b);
    const double ratio = pair.shared.count == 1 ? ratio_at_corner(p, q, pair.shared)
                                                : ratio_at_edge(p, q, pair.shared);
    const bool touching = meet_beyond_shared(pair.shared, p, q);
    for (const std::uint32_t t : {pair.a, pair.b})
      out[t].ratio = touching || std::isnan(ratio) ? kInfinity : std::max(out[t].ratio, ratio);
  }
  GapSearch(body, out).run();
  return out;
}

}  // namespace contactcheck
