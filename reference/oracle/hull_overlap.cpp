// Let S(X) be the union of the surface triangles of a hull X: its boundary when X has volume, X
// itself when it is flat (a polygon, segment or point). Claim: the hulls A and B share a point
// exactly when S(A) and S(B) do, or a point of one lies in the other, which has volume.
//
// "If" is clear. "Only if": suppose that x lies in both and S(A), S(B) are disjoint.
//  - Both flat: x lies in S(A) and S(B): impossible.
//  - A with volume, B flat: S(B) = B is connected, holds x in A and avoids the boundary of A, so B
//    lies in A: every point of B does. (B with volume, A flat: likewise.)
//  - Both with volume: the boundary of B is connected and avoids that of A, so it lies inside A or
//    outside A. Inside: the points of B lie in A. Outside: A is connected, holds x in B and avoids
//    the boundary of B, so A lies in B.
// In each case all points of one hull lie in the other, so that any single point decides.
//
// The surface is found by trying all triples of distinct points: with volume, a non-collinear
// triple with all points on one closed side spans a piece of a face, and the triples of a face's
// points cover that face (a triangulation by its corners). A flat hull that is not a segment is
// covered by its non-collinear triples; a segment by its ends.
#include "reference/oracle/hull_overlap.h"

#include <algorithm>

#include "reference/oracle/exact_tests.h"
#include "reference/oracle/floating_point.h"

namespace contactcheck::oracle {
namespace {

// Signs of orientation of all ordered quadruples i < j < k < l of up to eight points.
class QuadrupleSigns {
 public:
  explicit QuadrupleSigns(const std::vector<Vec3>& points) {
    const int n = static_cast<int>(points.size());
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j)
        for (int k = j + 1; k < n; ++k)
          for (int l = k + 1; l < n; ++l) {
            const int sign = orientation(points[i], points[j], points[k], points[l]);
            at(i, j, k, l) = static_cast<std::int8_t>(sign);
            has_volume_ |= sign != 0;
          }
  }
  bool has_volume() const { return has_volume_; }

  // Side of point l of the plane i < j < k, l being none of them: each exchange that sorts the
  // four flips the sign.
  int side(int i, int j, int k, int l) const {
    if (l > k) return at(i, j, k, l);
    if (l > j) return -at(i, j, l, k);
    if (l > i) return at(i, l, j, k);
    return -at(l, i, j, k);
  }

 private:
  std::int8_t& at(int i, int j, int k, int l) { return signs_[((i * 8 + j) * 8 + k) * 8 + l]; }
  std::int8_t at(int i, int j, int k, int l) const { return signs_[((i * 8 + j) * 8 + k) * 8 + l]; }
  std::array<std::int8_t, 4096> signs_;
  bool has_volume_ = false;
};

std::vector<Vec3> distinct_points(const Corners& corners) {
  std::vector<Vec3> points(corners.begin(), corners.end());
  std::sort(points.begin(), points.end(), lexicographically_less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

// Adds the triple as a face, outward side positive, if all points lie on one closed side of it.
// @pre the hull has volume
void add_if_supporting(const QuadrupleSigns& signs, int i, int j, int k, ConvexHull& hull) {
  bool positive = false, negative = false;
  for (int l = 0; l < static_cast<int>(hull.points.size()); ++l) {
    if (l == i || l == j || l == k) continue;
    const int side = signs.side(i, j, k, l);
    positive |= side > 0;
    negative |= side < 0;
  }
  // With volume, a plane misses some point: all sides 0 means that the triple is collinear.
  if (positive == negative) return;
  if (positive) std::swap(j, k);
  hull.surface.push_back({hull.points[i], hull.points[j], hull.points[k]});
}

template <typename Visit>
void for_triples(int n, Visit&& visit) {
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k) visit(i, j, k);
}

void make_flat_surface(ConvexHull& hull) {
  const std::vector<Vec3>& p = hull.points;
  for_triples(static_cast<int>(p.size()), [&](int i, int j, int k) {
    if (!collinear(p[i], p[j], p[k])) hull.surface.push_back({p[i], p[j], p[k]});
  });
  // The points are sorted along their line.
  if (hull.surface.empty()) hull.surface.push_back({p.front(), p.back(), p.back()});
}

int side_of(const TriangleCorners& face, const Vec3& point) {
  return orientation(face[0], face[1], face[2], point);
}

// @pre the hull has volume
bool holds(const ConvexHull& hull, const Vec3& point) {
  if (!hull.box.contains(point)) return false;
  return std::none_of(hull.surface.begin(), hull.surface.end(),
                      [&](const TriangleCorners& face) { return side_of(face, point) > 0; });
}

// True when some face plane of `hull` has all of `other` strictly outside.
bool separated_by_face(const ConvexHull& hull, const ConvexHull& other) {
  if (!hull.has_volume) return false;
  return std::any_of(hull.surface.begin(), hull.surface.end(), [&](const TriangleCorners& face) {
    return std::all_of(other.points.begin(), other.points.end(),
                       [&](const Vec3& p) { return side_of(face, p) > 0; });
  });
}

bool holds_a_point(const ConvexHull& hull, const ConvexHull& other) {
  if (!hull.has_volume) return false;
  return std::any_of(other.points.begin(), other.points.end(),
                     [&](const Vec3& p) { return holds(hull, p); });
}

bool surfaces_intersect(const ConvexHull& a, const ConvexHull& b) {
  for (const TriangleCorners& p : a.surface) {
    const Aabb box = box_of(p);
    if (!box.overlaps(b.box)) continue;
    for (const TriangleCorners& q : b.surface)
      if (box.overlaps(box_of(q)) && triangles_intersect(p, q)) return true;
  }
  return false;
}

}  // namespace

ConvexHull make_hull(const Corners& corners) {
  ConvexHull hull;
  hull.points = distinct_points(corners);
  for (const Vec3& p : hull.points) hull.box.extend(p);
  const QuadrupleSigns signs(hull.points);
  hull.has_volume = signs.has_volume();
  if (hull.has_volume) {
    for_triples(static_cast<int>(hull.points.size()),
                [&](int i, int j, int k) { add_if_supporting(signs, i, j, k, hull); });
  } else {
    make_flat_surface(hull);
  }
  return hull;
}

bool hulls_overlap(const ConvexHull& a, const ConvexHull& b) {
  if (!a.box.overlaps(b.box)) return false;
  // A face plane settles most separated pairs, a held point most overlapping ones; what is left is
  // for the surfaces.
  if (separated_by_face(a, b) || separated_by_face(b, a)) return false;
  return holds_a_point(a, b) || holds_a_point(b, a) || surfaces_intersect(a, b);
}

}  // namespace contactcheck::oracle
