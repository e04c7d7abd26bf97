// exact        core's exact test (core/narrow/impact.h)
// root-finder  what many simulators do: the roots of the coplanarity cubic in doubles, and a test
//              of inside in doubles at each, without tolerances. Parallel and planar motion it
//              cannot see. (Provot, "Collision and self-collision handling in cloth model
//              dedicated to design garments", 1997.)
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/detect/families.h"
#include "core/detect/impact_detector.h"
#include "core/narrow/impact.h"

namespace contactcheck {
namespace {

class ExactImpact final : public ImpactDetector {
 public:
  ReportedImpact query(const ImpactQuery& query) override {
    const Impact impact = find_impact(query);
    if (!impact.contact) return {};
    return {true, impact.earliest};
  }
};

class RootFinder final : public ImpactDetector {
 public:
  ReportedImpact query(const ImpactQuery& query) override {
    const auto& [p, q, r, s] = query.start;
    const Vec3 u = q - p, v = r - p, w = s - p;
    const Vec3 du = query.end[1] - query.end[0] - u, dv = query.end[2] - query.end[0] - v,
               dw = query.end[3] - query.end[0] - w;
    // det(u + t du, v + t dv, w + t dw), by power of t.
    const std::array<double, 4> f = {
        u.cross(v).dot(w), du.cross(v).dot(w) + u.cross(dv).dot(w) + u.cross(v).dot(dw),
        u.cross(dv).dot(dw) + du.cross(v).dot(dw) + du.cross(dv).dot(w), du.cross(dv).dot(dw)};
    for (const double t : roots(f))
      if (meet(query, t)) return {true, t};
    return {};
  }

 private:
  static double value(const std::array<double, 4>& f, double t) {
    return ((f[3] * t + f[2]) * t + f[1]) * t + f[0];
  }

  /// The roots in [0, 1], ascending: between the extrema the polynomial is monotone.
  static std::vector<double> roots(const std::array<double, 4>& f) {
    std::vector<double> ends = {0};
    const double a = 3 * f[3], b = 2 * f[2], c = f[1];
    const double discriminant = b * b - 4 * a * c;
    if (discriminant >= 0) {
      const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
      for (const double t : {q / a, c / q})
        if (t > 0 && t < 1) ends.push_back(t);
    }
    ends.push_back(1);
    std::sort(ends.begin(), ends.end());
    std::vector<double> found;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      double low = ends[i], high = ends[i + 1];
      const double at_low = value(f, low), at_high = value(f, high);
      if (at_low == 0) found.push_back(low);
      if (!(at_low * at_high < 0)) continue;
      for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        ((value(f, middle) < 0) == (at_low < 0) ? low : high) = middle;
      }
      found.push_back(0.5 * (low + high));
    }
    if (value(f, 1) == 0) found.push_back(1);
    return found;
  }

  static bool meet(const ImpactQuery& query, double t) {
    std::array<Vec3, 4> at;
    for (std::size_t i = 0; i < 4; ++i) at[i] = (1 - t) * query.start[i] + t * query.end[i];
    const auto& [p, q, r, s] = at;
    if (query.kind == ImpactKind::vertex_triangle) {
      const Vec3 normal = (r - q).cross(s - q);
      return normal.dot((r - q).cross(p - q)) >= 0 && normal.dot((s - r).cross(p - r)) >= 0 &&
             normal.dot((q - s).cross(p - s)) >= 0 && normal.dot(normal) > 0;
    }
    const Vec3 first = q - p, second = s - r, between = r - p, normal = first.cross(second);
    const double squared = normal.dot(normal);
    const double along_first = between.cross(second).dot(normal);
    const double along_second = between.cross(first).dot(normal);
    return squared > 0 && along_first >= 0 && along_first <= squared && along_second >= 0 &&
           along_second <= squared;
  }
};

}  // namespace

void register_impact_detectors(DetectorCatalog& catalog) {
  ImpactDetectorInfo exact;
  exact.id = "exact";
  exact.summary = "exact: filters with proven bounds, then integers";
  exact.make = [](const Options&) { return std::make_unique<ExactImpact>(); };
  catalog.add(std::move(exact));
  ImpactDetectorInfo roots;
  roots.id = "root-finder";
  roots.summary = "roots of the coplanarity cubic and inside tests in plain doubles";
  roots.make = [](const Options&) { return std::make_unique<RootFinder>(); };
  catalog.add(std::move(roots));
}

}  // namespace contactcheck
