// The direction is the point nearest to 0 of the hull of all p - q, found by the iteration of
// Gilbert, Johnson and Keerthi, "A Fast Procedure for Computing the Distance Between Complex
// Objects in Three-Dimensional Space" (1988). It ends long before the nearest point is exact: any
// direction with a positive smallest difference serves.
#include "reference/oracle/likely_direction.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace contactcheck::oracle::certify {
namespace {

struct Difference {
  Vec3 x;
  double along = std::numeric_limits<double>::infinity();
};

/// The p - q that lies least far along n.
Difference least_along(const Vec3& n, const std::array<Clouds, 2>& times) {
  Difference least;
  for (const Clouds& clouds : times) {
    const auto along = [&](const Vec3& u, const Vec3& v) { return n.dot(u) < n.dot(v); };
    const Vec3& p = *std::min_element(clouds.p.begin(), clouds.p.end(), along);
    const Vec3& q = *std::max_element(clouds.q.begin(), clouds.q.end(), along);
    if (const double d = n.dot(p - q); d < least.along) least = {p - q, d};
  }
  return least;
}

/// Up to four points, the last of which was added last.
class Simplex {
 public:
  void add(const Vec3& x) { points_[count_++] = x; }

  /// Keeps those points on whose hull that nearest to 0 is, at most three, and returns it: a face
  /// with the last point. @pre a point was added
  Vec3 reduce() {
    const Vec3 last = points_[count_ - 1];
    Nearest best{last, {last}, 1};
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      offer_edge(last, points_[i], best);
      for (std::size_t j = 0; j < i; ++j) offer_face(last, points_[i], points_[j], best);
    }
    points_ = best.points;
    count_ = best.count;
    return best.at;
  }

 private:
  struct Nearest {
    Vec3 at;
    std::array<Vec3, 4> points;
    std::size_t count;
  };

  static void offer(const Nearest& found, Nearest& best) {
    if (found.at.squaredNorm() < best.at.squaredNorm()) best = found;
  }

  static void offer_edge(const Vec3& a, const Vec3& b, Nearest& best) {
    const Vec3 edge = b - a;
    const double length = edge.squaredNorm(), reached = -a.dot(edge);
    if (reached > 0 && reached < length) offer({a + reached / length * edge, {a, b}, 2}, best);
  }

  static void offer_face(const Vec3& a, const Vec3& b, const Vec3& c, Nearest& best) {
    const Vec3 normal = (b - a).cross(c - a);
    const double squared = normal.squaredNorm();
    if (squared > 0 && normal.dot(b.cross(c)) > 0 && normal.dot(c.cross(a)) > 0 &&
        normal.dot(a.cross(b)) > 0)
      offer({a.dot(normal) / squared * normal, {a, b, c}, 3}, best);
  }

  std::array<Vec3, 4> points_;
  std::size_t count_ = 0;
};

}  // namespace

std::optional<Vec3> likely_direction(const std::array<Clouds, 2>& times) {
  constexpr int kMostSteps = 40;
  constexpr double kGoodShare = 0.5;  // of the largest smallest difference: leaves room to round
  std::optional<Vec3> best;
  double most = 0;
  Simplex simplex;
  Vec3 n = times[0].p.front() - times[0].q.front();
  double length = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostSteps; ++step) {
    const double norm = n.norm();
    if (!(norm > 0 && norm < length)) break;  // 0 is within the hull, or rounding ends it
    if (step > 0) length = norm;
    const Difference least = least_along(n, times);
    if (least.along > most * norm) {
      most = least.along / norm;
      best = n / norm;
    }
    if (step > 0 && most > kGoodShare * norm) break;
    simplex.add(least.x);
    n = simplex.reduce();
  }
  return best;
}

}  // namespace contactcheck::oracle::certify
