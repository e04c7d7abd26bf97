// Bullet's continuous test of a vertex and a face, as its deformable bodies call it.
//
//   bullet-bernstein  bernsteinCCD(): a cull by the coefficients of the coplanarity cubic, then 13
//                     directions that may separate, then the cubic's roots with a proximity test
//                     at each. Vertex-face alone, single precision, no time of contact.
//
// It is given the place at t = 0 and the difference to that at t = 1 as a velocity over a step of
// 1, in floats: what it answers is that query. The tolerance is the one that Bullet passes,
// SAFE_EPSILON.
//
// Seen in Bullet 3.24 (Debian 12, single precision), November 2026:
// - bernsteinVFTest() returns true after its first cull; the inside test behind it is never run.
// - hasSeparatingPlane() asks whether all corners are on another side of the vertex than its
//   motion, and takes no motion along a direction for a side of its own: a vertex that does not
//   move along one of the 13 directions is separated.
// - Roots at t <= 0 are passed over: contact at the start of a step is not found.
#include <BulletSoftBody/btSoftBodyInternals.h>

#include <cmath>

#include "core/types/check.h"
#include "reference/adapters/adapters.h"

namespace contactcheck::adapters {
namespace {

btVector3 to_bullet(const Vec3& p) {
  return {static_cast<btScalar>(p.x()), static_cast<btScalar>(p.y()), static_cast<btScalar>(p.z())};
}

class BulletBernstein final : public ImpactDetector {
 public:
  BulletBernstein() {
    for (std::size_t corner = 0; corner < 3; ++corner) face_.m_n[corner] = &nodes_[corner + 1];
  }

  ReportedImpact query(const ImpactQuery& query) override {
    for (std::size_t i = 0; i < 4; ++i) {
      nodes_[i].m_x = to_bullet(query.start[i]);
      nodes_[i].m_v = to_bullet(query.end[i]) - nodes_[i].m_x;
      for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(nodes_[i].m_x[axis]) || !std::isfinite(nodes_[i].m_v[axis]))
          throw RefusedInput("a place or motion is larger than any float");
    }
    btVector3 barycentric;
    return {bernsteinCCD(&face_, &nodes_[0], 1, SAFE_EPSILON, barycentric), std::nullopt};
  }

  ImpactQuery fed(const ImpactQuery& query) const override {
    ImpactQuery result{query.kind, {}, {}};
    for (std::size_t i = 0; i < 4; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const auto start = static_cast<btScalar>(query.start[i][axis]);
        const btScalar velocity = static_cast<btScalar>(query.end[i][axis]) - start;
        result.start[i][axis] = static_cast<double>(start);
        // The sum of two floats is a double, unless their exponents are far apart.
        result.end[i][axis] = static_cast<double>(start) + static_cast<double>(velocity);
      }
    return result;
  }

 private:
  std::array<btSoftBody::Node, 4> nodes_{};
  btSoftBody::Face face_{};
};

}  // namespace

ImpactDetectorInfo bullet_impact_detector() {
  ImpactDetectorInfo info;
  info.id = "bullet-bernstein";
  info.summary = "Bullet's bernsteinCCD of deformable bodies, vertex-face alone";
  info.precision = Precision::kSingle;
  info.kinds = {ImpactKind::vertex_triangle};
  info.make = [](const Options&) { return std::make_unique<BulletBernstein>(); };
  return info;
}

}  // namespace contactcheck::adapters
