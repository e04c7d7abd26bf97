// The affine map that follows a lattice, and the bound on its norm.

#include "core/broad/reference_map.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using test::TriangleSource;

TEST(SpectralNormBound, LiesAboveTheNormByAThirdOfAPercentAtMost) {
  TriangleSource random(11);
  for (int round = 0; round < 2000; ++round) {
    Eigen::Matrix3d m;
    for (int k = 0; k < 3; ++k) m.col(k) = random.point(Vec3::Zero(), 1.0);
    if (round % 3 == 1) m.col(2) = m.col(0) - 0.5 * m.col(1);             // rank 2
    if (round % 3 == 2) m = Vec3(m.col(0)) * Vec3(m.col(1)).transpose();  // rank 1
    const double scale = round % 5 == 0 ? 1e200 : round % 5 == 1 ? 1e-100 : 1.0;
    // Of the unscaled matrix: the decomposition squares.
    const double norm = Eigen::JacobiSVD<Eigen::Matrix3d>(m).singularValues()[0];
    const double bound = spectral_norm_bound(scale * m) / scale;
    EXPECT_GE(bound, norm * (1.0 - 1e-15));
    EXPECT_LE(bound, 1.003 * norm);
  }
}

TEST(SpectralNormBound, OfRotationsZeroAndInfinity) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vec3(2, 1, 5).normalized()).matrix();
  EXPECT_GE(spectral_norm_bound(turn), 1.0);
  EXPECT_LT(spectral_norm_bound(turn), 1.003);
  EXPECT_GT(spectral_norm_bound(Eigen::Matrix3d::Zero()), 0.0);
  EXPECT_LT(spectral_norm_bound(Eigen::Matrix3d::Zero()), 1e-100);
  EXPECT_TRUE(std::isinf(spectral_norm_bound(Eigen::Matrix3d::Constant(HUGE_VAL))));
  EXPECT_TRUE(std::isinf(spectral_norm_bound(Eigen::Matrix3d::Constant(1e308))));
}

std::vector<Vec3> box_nodes() {
  return test::rest_nodes_at(*test::make_body("", test::unit_box_mesh(2), {2, 3, 2}).shape,
                             Vec3(3, 4, 5));
}

TEST(ReferenceFit, FindsAnAffineMapAndARotation) {
  const ReferenceFit fit(box_nodes());
  Eigen::Matrix3d linear;
  linear << 1, 0.5, 0, -0.25, 2, 0.1, 0, 0, -1.5;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.0, Vec3(1, 1, 3).normalized()).matrix();
  for (const auto& [kind, matrix] :
       {std::pair(ReferenceKind::kAffine, linear), std::pair(ReferenceKind::kRigid, turn)}) {
    std::vector<Vec3> nodes = fit.rest();
    for (Vec3& n : nodes) n = matrix * n + Vec3(100, 20, -3);
    const AffineMap map = fit.fit(kind, nodes);
    EXPECT_LT((map.linear - matrix).norm(), 1e-12);
    for (std::size_t j = 0; j < nodes.size(); ++j)
      EXPECT_LT((map.linear * (fit.rest()[j] - map.origin) + map.offset - nodes[j]).norm(), 1e-11);
  }
}

TEST(ReferenceFit, ARigidMapOfAMirroredBodyIsARotation) {
  const ReferenceFit fit(box_nodes());
  std::vector<Vec3> nodes = fit.rest();
  for (Vec3& n : nodes) n.x() = -n.x();
  const Eigen::Matrix3d linear = fit.fit(ReferenceKind::kRigid, nodes).linear;
  EXPECT_NEAR(linear.determinant(), 1.0, 1e-12);
  EXPECT_LT(fit.fit(ReferenceKind::kAffine, nodes).linear.determinant(), -0.9);
}

TEST(ReferenceFit, NoneIsTheIdentityAndOverflowTheZeroMap) {
  const ReferenceFit fit(box_nodes());
  std::vector<Vec3> nodes = fit.rest();
  const AffineMap none = fit.fit(ReferenceKind::kNone, nodes);
  EXPECT_EQ(none.linear, Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_EQ(none.origin, none.offset);
  const Vec3 origin(1000, -20, 3);
  EXPECT_EQ(fit.fit(ReferenceKind::kNone, nodes, origin).offset, Vec3(none.origin - origin));
  nodes.assign(nodes.size(), Vec3::Constant(1.7e308));
  for (ReferenceKind kind : {ReferenceKind::kAffine, ReferenceKind::kRigid}) {
    const AffineMap map = fit.fit(kind, nodes);
    EXPECT_TRUE(map.linear.isZero(0.0) && map.offset.isZero(0.0));
  }
}

}  // namespace
}  // namespace contactcheck
