// FCL's continuous tests of single elements, as its continuous mesh collision calls them.
//
//   fcl-intersect  Intersect::intersect_VF and intersect_EE: the roots of the coplanarity cubic in
//                  doubles, and tests of inside and distance with absolute tolerances
//
// Seen in FCL 0.7.0 (Debian 12), November 2026:
// - A query whose cubic's coefficients are all below 1e-7, an absolute number, is answered with no:
//   plain crossings of elements of a few centimetres are missed.
// - The time is set only when there is a contact.
#include <fcl/config.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include "reference/adapters/adapters.h"

namespace contactcheck::adapters {
namespace {

class FclIntersect final : public ImpactDetector {
 public:
  ReportedImpact query(const ImpactQuery& query) override {
    using Tests = fcl::detail::Intersect<double>;
    const auto& [p, q, r, s] = query.start;
    const auto& [p1, q1, r1, s1] = query.end;
    double time = 0;
    Vec3 point;
    const bool contact = query.kind == ImpactKind::vertex_triangle
                             ? Tests::intersect_VF(q, r, s, p, q1, r1, s1, p1, &time, &point)
                             : Tests::intersect_EE(p, q, r, s, p1, q1, r1, s1, &time, &point);
    if (!contact) return {};
    return {true, time};
  }
};

}  // namespace

ImpactDetectorInfo fcl_impact_detector() {
  ImpactDetectorInfo info;
  info.id = "fcl-intersect";
  info.summary = "FCL's Intersect::intersect_VF and intersect_EE";
  info.make = [](const Options&) { return std::make_unique<FclIntersect>(); };
  return info;
}

}  // namespace contactcheck::adapters
