#include "core/dynamics/polar_rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "tests/core/dynamics/model_states.h"

namespace contactcheck {
namespace {

constexpr double kRounding = 1e-14;

Mat3 noise_matrix(test::Noise& noise) {
  Mat3 m;
  for (int k = 0; k < 3; ++k) m.col(k) = noise.vector();
  return m;
}

Mat3 noise_rotation(test::Noise& noise) {
  return Eigen::Quaterniond(noise.next(), noise.next(), noise.next(), noise.next())
      .normalized()
      .toRotationMatrix();
}

void expect_rotation(const Mat3& r) {
  EXPECT_LT((r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff(), kRounding) << r;
  EXPECT_GT(r.determinant(), 0.0) << r;
}

// R is the best of all rotations exactly when S = R^T m is symmetric and no two of its eigenvalues
// have a sum below zero.
void expect_best(const Mat3& m, double tolerance) {
  const PolarRotation answer = polar_rotation(m);
  EXPECT_TRUE(answer.converged) << m;
  expect_rotation(answer.rotation);
  const Mat3 s = answer.rotation.transpose() * m / m.cwiseAbs().maxCoeff();
  EXPECT_LT((s - s.transpose()).cwiseAbs().maxCoeff(), tolerance) << m;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(s);
  EXPECT_GT(solver.eigenvalues()[0] + solver.eigenvalues()[1], -tolerance) << m;
}

TEST(PolarRotation, OfARotatedStretchIsTheRotation) {
  test::Noise noise;
  for (int i = 0; i < 1000; ++i) {
    const Mat3 r = noise_rotation(noise), q = noise_rotation(noise);
    // Stretches between 1/5 and 9/5.
    const Vec3 stretch = Vec3::Ones() + 0.8 * noise.vector();
    const Mat3 m = r * q * stretch.asDiagonal() * q.transpose();
    EXPECT_LT((polar_rotation(m).rotation - r).cwiseAbs().maxCoeff(), kRounding);
  }
}

TEST(PolarRotation, IsTheBestOfAllForAnyMatrix) {
  test::Noise noise;
  int inverted = 0;
  constexpr int kMatrices = 2000;
  for (int i = 0; i < kMatrices; ++i) {
    const Mat3 m = noise_matrix(noise);
    inverted += m.determinant() < 0.0;
    expect_best(m, kRounding);
  }
  // Both kinds, or the test says half of what it seems to.
  EXPECT_GT(inverted, kMatrices * 3 / 10);
  EXPECT_LT(inverted, kMatrices * 7 / 10);
}

TEST(PolarRotation, OfNearlyFlatMatricesIsTheBestOnBothSidesOfZero) {
  test::Noise noise;
  for (double thickness : {1e-2, 1e-5, 1e-6, 1e-7, 1e-12, 0.0, -1e-12, -1e-7, -1e-3}) {
    for (int i = 0; i < 50; ++i) {
      const Mat3 m =
          noise_rotation(noise) * Vec3(1.0, 0.6, thickness).asDiagonal() * noise_rotation(noise);
      expect_best(m, 1e-9);  // Newton's iteration loses the digits of the condition number
    }
  }
}

TEST(PolarRotation, PassesThroughFlatWithoutAJump) {
  const Mat3 r = test::rotation_of(1, 2, -3, 4), q = test::rotation_of(2, 1, 1, -5);
  const auto at = [&](double thickness) -> Mat3 {
    return polar_rotation(r * q * Vec3(1.0, 0.6, thickness).asDiagonal() * q.transpose()).rotation;
  };
  for (double thickness : {0.5, 1e-3, 1e-6, 0.0, -1e-6, -1e-3, -0.5})
    EXPECT_LT((at(thickness) - r).cwiseAbs().maxCoeff(), 1e-9) << thickness;
}

TEST(PolarRotation, OfHalfTurnsIsTheHalfTurn) {
  // Where iterations from the identity stand on a saddle.
  for (const Vec3& diagonal : {Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}) {
    const Mat3 half_turn = diagonal.asDiagonal();
    EXPECT_EQ(polar_rotation(half_turn).rotation, half_turn);
    EXPECT_LT((polar_rotation(half_turn * Vec3(1, 2, -1e-3).asDiagonal()).rotation - half_turn)
                  .cwiseAbs()
                  .maxCoeff(),
              kRounding);
  }
}

TEST(PolarRotation, OfAmbiguousMatricesIsOneOfTheBest) {
  EXPECT_EQ(polar_rotation(Mat3::Zero()).rotation, Mat3::Identity());
  expect_best(-Mat3::Identity(), kRounding);
  expect_best(Vec3(1, 1, -1).asDiagonal(), kRounding);
  expect_best(Vec3(1, 2, 3) * Vec3(-4, 5, 6).transpose(), kRounding);
  expect_best(Vec3(0, 0, -1).asDiagonal(), kRounding);
}

TEST(PolarRotation, DoesNotDependOnScale) {
  test::Noise noise;
  for (int i = 0; i < 100; ++i) {
    const Mat3 m = noise_matrix(noise);
    for (double scale : {0x1p-900, 0x1p900})
      EXPECT_EQ(polar_rotation(scale * m).rotation, polar_rotation(m).rotation);
  }
}

TEST(PolarRotation, OfNanAndInfinityIsReported) {
  for (double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    Mat3 m = Mat3::Identity();
    m(1, 2) = bad;
    EXPECT_FALSE(polar_rotation(m).converged);
    EXPECT_EQ(polar_rotation(m).rotation, Mat3::Identity());
  }
}

}  // namespace
}  // namespace contactcheck
