#include "reference/oracle/surface_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/oracle/rational_geometry.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {
namespace {

using oracle::ScaledSurface;
using oracle::SurfaceTree;

struct Surfaces {
  Surfaces(const TriangleMesh& mesh_a, const TriangleMesh& mesh_b)
      : a(mesh_a), b(mesh_b), tree_a(mesh_a), tree_b(mesh_b) {}

  oracle::DistanceInterval between(const std::vector<Vec3>& va, const std::vector<Vec3>& vb) {
    ScaledSurface sa{&tree_a, va, {}}, sb{&tree_b, vb, {}};
    return oracle::surface_distance(sa, sb);
  }
  oracle::DistanceInterval at_rest() { return between(a.vertices, b.vertices); }
  mpq_class rational_squared(const std::vector<Vec3>& va, const std::vector<Vec3>& vb) const {
    mpq_class best = -1;
    for (const Triangle& s : a.triangles)
      for (const Triangle& t : b.triangles) {
        const mpq_class d = oracle::rational::squared_distance({va[s[0]], va[s[1]], va[s[2]]},
                                                               {vb[t[0]], vb[t[1]], vb[t[2]]});
        if (best < 0 || d < best) best = d;
      }
    return best;
  }

  TriangleMesh a, b;
  SurfaceTree tree_a, tree_b;
};

double largest(const std::vector<Vec3>& points) {
  double out = 0;
  for (const Vec3& p : points) out = std::max(out, p.cwiseAbs().maxCoeff());
  return out;
}

// Of any positions of the two; their exact squared distance.
mpq_class expect_contract(Surfaces& s, const std::vector<Vec3>& va, const std::vector<Vec3>& vb) {
  const oracle::DistanceInterval d = s.between(va, vb);
  const mpq_class squared = s.rational_squared(va, vb), low(d.lower), high(d.upper);
  EXPECT_LE(low * low, squared);
  EXPECT_GE(high * high, squared);
  EXPECT_LE(d.upper - d.lower, 1e-9 * std::max(largest(va), largest(vb)));
  EXPECT_EQ(d.upper == 0, squared == 0);
  const Triangle &p = s.a.triangles[d.triangles[0]], &q = s.b.triangles[d.triangles[1]];
  EXPECT_LE(oracle::rational::squared_distance({va[p[0]], va[p[1]], va[p[2]]},
                                               {vb[q[0]], vb[q[1]], vb[q[2]]}),
            high * high);
  return squared;
}

TEST(SurfaceDistance, ParallelBoxes) {
  Surfaces s(unit_box_mesh(4), box_mesh(Vec3(1.5, 0.2, 0.2), Vec3(2, 0.7, 0.7), 4));
  const oracle::DistanceInterval d = s.at_rest();
  EXPECT_LE(d.lower, 0.5);
  EXPECT_GE(d.upper, 0.5);
  EXPECT_LT(d.upper - d.lower, 1e-12);
}

TEST(SurfaceDistance, TouchingAndCrossingAreZero) {
  Surfaces touching(unit_box_mesh(3), box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 3));
  EXPECT_EQ(touching.at_rest().upper, 0.0);
  EXPECT_EQ(touching.at_rest().lower, 0.0);
  Surfaces crossing(unit_box_mesh(3), box_mesh(Vec3(0.5, 0.5, 0.5), Vec3(2, 2, 2), 3));
  EXPECT_EQ(crossing.at_rest().upper, 0.0);
}

TEST(SurfaceDistance, OneUlpGapIsNotZero) {
  const double next = std::nextafter(1.0, 2.0);
  Surfaces s(unit_box_mesh(3), box_mesh(Vec3(next, 0, 0), Vec3(2, 1, 1), 3));
  const oracle::DistanceInterval d = s.at_rest();
  EXPECT_LE(d.lower, 0x1p-52);
  EXPECT_GE(d.upper, 0x1p-52);
  EXPECT_LT(d.upper, 1e-9);
}

TEST(SurfaceDistance, HeldBodyIsMeasuredToTheSurface) {
  Surfaces s(box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 3), box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 2));
  EXPECT_NEAR(s.at_rest().lower, 1.0, 1e-9);
  EXPECT_NEAR(s.at_rest().upper, 1.0, 1e-9);
}

TEST(SurfaceDistanceAgainstRational, RotatedBoxes) {
  Surfaces s(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 1),
             box_mesh(Vec3(-0.5, -0.7, -0.9), Vec3(0.5, 0.7, 0.9), 1));
  TriangleSource source(601);
  int touching = 0;
  for (int i = 0; i < 40; ++i) {
    const auto va = moved(s.a.vertices, random_rotation(source), Vec3::Zero());
    const auto vb = moved(s.b.vertices, random_rotation(source), source.point(Vec3::Zero(), 3.0));
    touching += expect_contract(s, va, vb) == 0;
  }
  EXPECT_GT(touching, 3);
  EXPECT_LT(touching, 30);
}

// A rotated box against its copy moved along a face normal by shrinking gaps: every pair of the
// facing triangles is equally near, and rounding makes them cross or not.
TEST(SurfaceDistanceAgainstRational, ParallelFacesAtShrinkingGaps) {
  Surfaces s(box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1), 1), box_mesh(Vec3(1, 0, 0), Vec3(2, 1, 1), 1));
  TriangleSource source(602);
  for (int i = 0; i < 30; ++i) {
    const auto rotation = random_rotation(source);
    const auto va = moved(s.a.vertices, rotation, Vec3::Zero());
    const Vec3 gap = rotation.col(0) * std::ldexp(1.0, -2 * i);
    const auto vb = moved(s.b.vertices, rotation, gap);
    expect_contract(s, va, vb);
  }
}

// A corner over a corner, gaps from 1e-4 to 1e-13: directions in double are mostly noise.
TEST(SurfaceDistanceAgainstRational, CornersAtShrinkingGaps) {
  Surfaces s(box_mesh(Vec3(-1, -1, -1), Vec3(0, 0, 0), 1),
             box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1), 1));
  TriangleSource source(603);
  for (int i = 0; i < 30; ++i) {
    const Vec3 gap = source.point(Vec3(1, 1, 1), 0.9) * std::ldexp(1.0, -14 - i);
    const auto rotation = random_rotation(source);
    const auto va = moved(s.a.vertices, rotation, Vec3::Zero());
    const auto vb = moved(s.b.vertices, rotation, rotation * gap);
    expect_contract(s, va, vb);
  }
}

TEST(SurfaceDistanceAgainstRational, SliversAndDegenerateTriangles) {
  TriangleMesh a = unit_box_mesh(1), b = box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1), 1);
  for (Vec3& v : a.vertices) v.y() *= 1e-12;
  for (Vec3& v : b.vertices) v.z() = 0;
  Surfaces s(a, b);
  TriangleSource source(604);
  for (int i = 0; i < 30; ++i) {
    const auto va = moved(s.a.vertices, random_rotation(source), Vec3::Zero());
    const auto vb = moved(s.b.vertices, random_rotation(source), source.point(Vec3::Zero(), 1.5));
    expect_contract(s, va, vb);
  }
}

TEST(SurfaceDistance, PowersOfTwoScaleTheIntervalExactly) {
  Surfaces s(torus_mesh(1.0, 0.3, 16, 8), sphere_mesh(Vec3(2, 0.1, 0.2), 0.5, 2));
  const oracle::DistanceInterval d = s.at_rest();
  EXPECT_GT(d.lower, 0.1);
  for (int exponent : {-900, -500, -3, 8, 700, 1000}) {
    const double factor = std::ldexp(1.0, exponent);
    const oracle::DistanceInterval e =
        s.between(scaled(s.a.vertices, factor), scaled(s.b.vertices, factor));
    EXPECT_EQ(e.lower, d.lower * factor) << exponent;
    EXPECT_EQ(e.upper, d.upper * factor) << exponent;
  }
}

TEST(SurfaceDistanceAgainstRational, SubnormalCoordinates) {
  Surfaces s(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 1),
             box_mesh(Vec3(2, 0, 0), Vec3(3, 1, 1), 1));
  TriangleSource source(605);
  for (double scale : {1e-160, 1e-300, 1e-320}) {
    for (int i = 0; i < 5; ++i) {
      const auto va = scaled(moved(s.a.vertices, random_rotation(source), Vec3::Zero()), scale);
      const auto vb = scaled(s.b.vertices, scale);
      const mpq_class squared = s.rational_squared(va, vb);
      const oracle::DistanceInterval d = s.between(va, vb);
      const mpq_class low(d.lower), high(d.upper);
      EXPECT_LE(low * low, squared);
      EXPECT_GE(high * high, squared);
      // No double lies between neighbouring subnormal numbers.
      EXPECT_LE(d.upper - d.lower, 1e-9 * scale * 4 + 4 * 0x1p-1074);
    }
  }
}

TEST(SurfaceDistance, SwappedBodiesAgree) {
  Surfaces s(torus_mesh(1.0, 0.3, 24, 12), sphere_mesh(Vec3(2, 0, 0.2), 0.5, 3));
  Surfaces t(s.b, s.a);
  const oracle::DistanceInterval d = s.at_rest(), e = t.at_rest();
  EXPECT_NEAR(d.lower, e.lower, 1e-9);
  EXPECT_NEAR(d.upper, e.upper, 1e-9);
  EXPECT_LE(std::max(d.lower, e.lower), std::min(d.upper, e.upper));
}

}  // namespace
}  // namespace contactcheck::test
