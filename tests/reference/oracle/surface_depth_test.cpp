#include "reference/oracle/surface_depth.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "reference/oracle/floating_point.h"
#include "reference/oracle/rational_geometry.h"
#include "reference/oracle/surface_geometry.h"
#include "reference/oracle/vertex_queries.h"
#include "tests/reference/oracle/drawn_solids.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {
namespace {

using oracle::SurfaceDepth;

SurfaceDepth depth_of(const TriangleMesh& a, const TriangleMesh& b,
                      double limit = -std::numeric_limits<double>::infinity()) {
  const std::vector<Body> bodies = {bare_body("a", a), bare_body("b", b)};
  const FrameData data = make_frame(bodies, {a.vertices, b.vertices});
  oracle::SurfaceGeometry geometry(bodies);
  geometry.set_frame(data.frame());
  return geometry.surface_depth({0, 1}, limit);
}

double largest(const TriangleMesh& a, const TriangleMesh& b) {
  return std::max(oracle::largest_coordinate(a.vertices), oracle::largest_coordinate(b.vertices));
}

// What the interval promises wherever the pieces did not run out.
void expect_width(const SurfaceDepth& depth, double largest_coordinate) {
  EXPECT_FALSE(depth.unknown);
  EXPECT_LE(depth.lower, depth.upper);
  EXPECT_LE(depth.upper - depth.lower, std::max(1e-3 * depth.upper, 1e-9 * largest_coordinate));
}

void expect_depth(const TriangleMesh& a, const TriangleMesh& b, double depth) {
  const SurfaceDepth found = depth_of(a, b);
  expect_width(found, largest(a, b));
  EXPECT_LE(found.lower, depth);
  EXPECT_GE(found.upper, depth);
}

// ---- by hand

TEST(SurfaceDepth, CrossedBarsWithoutAVertexInsideAreDeep) {
  const TriangleMesh along_x = box_mesh({-4, -0.5, -0.5}, {4, 0.5, 0.5}, 1);
  expect_depth(along_x, box_mesh({-0.375, -4, -0.375}, {0.375, 4, 0.375}, 1), 0.5);
  expect_depth(along_x, box_mesh({-0.375, -4, 0.25}, {0.375, 4, 2}, 1), 0.25);
}

TEST(SurfaceDepth, OfABallThroughAThinFloor) {
  const TriangleMesh ball = sphere_mesh({0, 0, 0.125}, 1, 3);
  const TriangleMesh floor = box_mesh({-8, -8, -0.0625}, {8, 8, 0}, 1);
  // The middle of the floor's upper side is 7/8 below the ball's top and as near to its flanks.
  const SurfaceDepth depth = depth_of(ball, floor);
  expect_width(depth, 8);
  EXPECT_NEAR(depth.upper, 0.87, 0.02);
}

TEST(SurfaceDepth, OfABodyInsideAnotherIsToItsFarthestPoint) {
  const TriangleMesh outer = box_mesh({-4, -4, -4}, {4, 4, 4}, 2);
  expect_depth(outer, box_mesh({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, 3), 3.5);
}

TEST(SurfaceDepth, OfABoxOnATableIsHowFarItSank) {
  const TriangleMesh table = box_mesh({-2, -2, -1}, {2, 2, 0}, 12);
  for (const double sunk : {0.5, 0x1p-10, 0x1p-20})
    expect_depth(box_mesh({-1, -1, -sunk}, {1, 1, 1}, 7), table, sunk);
}

TEST(SurfaceDepth, OfSolidsThatTouchIsLessThanTheSmallestWidth) {
  const TriangleMesh box = unit_box_mesh(2);
  expect_depth(box, box_mesh({1, 0, 0}, {2, 1, 1}, 3), 0.0);
  expect_depth(box, box_mesh({1, 1, 1}, {2, 2, 2}, 1), 0.0);
  expect_depth(box, box_mesh({1, 1, 0.25}, {2, 2, 0.5}, 1), 0.0);
  EXPECT_LE(depth_of(box, box_mesh({1, 0, 0}, {2, 1, 1}, 3)).upper, 2e-9);
}

TEST(SurfaceDepth, OfSolidsThatAreApartIsExactlyZero) {
  const SurfaceDepth depth = depth_of(unit_box_mesh(1), box_mesh({1.5, 0.25, 0}, {2, 1, 1}, 1));
  EXPECT_EQ(depth.lower, 0.0);
  EXPECT_EQ(depth.upper, 0.0);
  // A body in another's cavity is outside.
  const TriangleMesh hollow =
      joined(box_mesh({-4, -4, -4}, {4, 4, 4}, 1), reversed(box_mesh({-2, -2, -2}, {2, 2, 2}, 1)));
  EXPECT_EQ(depth_of(hollow, unit_box_mesh(1)).upper, 0.0);
}

TEST(SurfaceDepth, IsNotChangedByOrientationOrder) {
  const TriangleMesh a = box_mesh({-4, -0.5, -0.5}, {4, 0.5, 0.5}, 1);
  const TriangleMesh b = box_mesh({-0.375, -4, 0.25}, {0.375, 4, 2}, 1);
  expect_depth(b, a, 0.25);
  expect_depth(reversed(a), b, 0.25);
  expect_depth(reversed(a), reversed(b), 0.25);
}

TEST(SurfaceDepth, LimitBelowTheLowerEndChangesNothing) {
  const TriangleMesh a = sphere_mesh({0, 0, 0}, 1, 2), b = sphere_mesh({1, 0.25, 0.125}, 1, 2);
  const SurfaceDepth free = depth_of(a, b);
  const SurfaceDepth exceeded = depth_of(a, b, free.lower / 2);
  EXPECT_EQ(exceeded.lower, free.lower);
  EXPECT_EQ(exceeded.upper, free.upper);
}

TEST(SurfaceDepth, LimitWithinTheIntervalNarrowsIt) {
  const TriangleMesh a = sphere_mesh({0, 0, 0}, 1, 2), b = sphere_mesh({1, 0.25, 0.125}, 1, 2);
  const SurfaceDepth free = depth_of(a, b);
  ASSERT_LT(free.lower, free.upper);
  const double limit = free.lower + (free.upper - free.lower) / 2;
  const SurfaceDepth narrowed = depth_of(a, b, limit);
  EXPECT_TRUE(narrowed.upper <= limit || narrowed.lower > limit);
}

TEST(SurfaceDepth, PiecesThatRunOutLeaveAWiderIntervalThatStillHolds) {
  const TriangleMesh a = box_mesh({-1, -0.5, -0.5}, {1, 0.5, 0.5}, 1);
  const TriangleMesh b = box_mesh({-0.375, -1, -0.375}, {0.375, 1, 0.375}, 1);
  oracle::SurfaceTree tree_a(a), tree_b(b);
  tree_a.refit(a.vertices);
  tree_b.refit(b.vertices);
  oracle::DepthWanted wanted;
  for (wanted.pieces = 1; wanted.pieces < 100; wanted.pieces *= 2) {
    const oracle::DistanceBounds depth = oracle::surface_depth(tree_a, tree_b, wanted);
    EXPECT_LE(depth.lower, 0.5);
    EXPECT_GE(depth.upper, 0.5);
    EXPECT_GT(depth.upper, wanted.pieces == 1 ? 0.51 : 0.5);
  }
}

// ---- crossed boxes: the depth follows from their coordinates, exactly

// Of the points of [lo, hi], the largest distance to the nearer end of [of_lo, of_hi]; below 0: all
// are outside.
mpq_class deepest_within(const mpq_class& lo, const mpq_class& hi, const mpq_class& of_lo,
                         const mpq_class& of_hi) {
  const mpq_class middle = (of_lo + of_hi) / 2;
  const mpq_class x = middle < lo ? lo : middle > hi ? hi : middle;
  return std::min<mpq_class>(x - of_lo, of_hi - x);
}

mpq_class depth_into(const Aabb& into, const Aabb& of) {
  mpq_class depth = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double at : {of.lo[axis], of.hi[axis]}) {
      mpq_class face = deepest_within(at, at, into.lo[axis], into.hi[axis]);
      for (const int k : {(axis + 1) % 3, (axis + 2) % 3})
        face = std::min(face, deepest_within(of.lo[k], of.hi[k], into.lo[k], into.hi[k]));
      depth = std::max(depth, face);
    }
  return depth;
}

// On a coarse grid, where many touch, or anywhere, where differences of coordinates are rounded.
TriangleMesh drawn_box(TriangleSource& source) {
  Aabb box;
  const bool on_grid = source.below(2) == 0;
  do {
    box = on_grid ? source.grid_box(24) : source.box(Vec3::Constant(0.3), 1.0);
  } while (!(box.extent().minCoeff() > 0));
  const double scale = on_grid ? 0.0625 : 1.0;
  return box_mesh(scale * box.lo, scale * box.hi, 1);
}

TEST(SurfaceDepth, OfTwoBoxesIsExactlyWithinTheInterval) {
  TriangleSource source(811);
  int deep = 0, zero = 0;
  for (int i = 0; i < 2000; ++i) {
    const TriangleMesh mesh_a = drawn_box(source), mesh_b = drawn_box(source);
    const Aabb a = bounding_box(mesh_a.vertices), b = bounding_box(mesh_b.vertices);
    const mpq_class depth = std::max(depth_into(a, b), depth_into(b, a));
    SCOPED_TRACE(testing::Message() << "pair " << i);
    const SurfaceDepth found = depth_of(mesh_a, mesh_b);
    expect_width(found, largest(mesh_a, mesh_b));
    EXPECT_LE(mpq_class(found.lower), depth);
    EXPECT_GE(mpq_class(found.upper), depth);
    (depth > 0 ? deep : zero) += 1;
  }
  EXPECT_GT(deep, 500);
  EXPECT_GT(zero, 250);
}

// The depth of a body below a face that no axis knows is that of its lowest vertex: the root of a
// rational.
TEST(SurfaceDepth, BelowATiltedFaceIsExactlyWithinTheInterval) {
  TriangleSource source(814);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d rotation = random_rotation(source);
    const Vec3 offset = source.point(Vec3::Zero(), 1.0);
    const double depth = std::ldexp(1.0, -2 - source.below(12));
    const std::vector<Vec3> tall = {{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}, {0, 0, -8}};
    const std::vector<Vec3> small = {
        {0, 0, -depth}, {0.05, 0, -depth / 2}, {-0.05, 0.05, -depth / 4}, {0, -0.05, -depth / 8}};
    const std::vector<Triangle> faces = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 3}};
    const TriangleMesh outer{moved(tall, rotation, offset), faces};
    const TriangleMesh inner{moved(small, rotation, offset), faces};
    const SurfaceDepth found = depth_of(outer, inner);
    // So narrow that rounding counts.
    EXPECT_LE(found.upper - found.lower, 2e-12);
    const auto corner = [&](std::size_t k) {
      return oracle::rational::to_rational(outer.vertices[k]);
    };
    using oracle::rational::operator-;
    const auto normal = oracle::rational::cross(corner(1) - corner(0), corner(2) - corner(0));
    const mpq_class height =
        oracle::rational::dot(normal, oracle::rational::to_rational(inner.vertices[0]) - corner(0));
    const mpq_class squared = height * height / oracle::rational::dot(normal, normal);
    const mpq_class lower(found.lower), upper(found.upper);
    EXPECT_LE(lower * lower, squared);
    EXPECT_GE(upper * upper, squared);
  }
}

TEST(SurfaceDepth, PowersOfTwoScaleTheIntervalExactly) {
  const TriangleMesh a = sphere_mesh({0, 0, 0}, 1, 1), b = ell_mesh();
  const SurfaceDepth at_one = depth_of(a, b);
  for (const int exponent : {-900, -400, -3, 7, 500, 1000}) {
    const double factor = std::ldexp(1.0, exponent);
    const SurfaceDepth depth = depth_of({scaled(a.vertices, factor), a.triangles},
                                        {scaled(b.vertices, factor), b.triangles});
    EXPECT_EQ(depth.lower, at_one.lower * factor) << exponent;
    EXPECT_EQ(depth.upper, at_one.upper * factor) << exponent;
  }
}

// ---- brute force

// Distances and sides by all triangles, apart from the search that is judged: scaled to 1.
struct BruteSolid {
  BruteSolid(TriangleMesh m, int exponent) : mesh(std::move(m)), tree(mesh) {
    for (Vec3& v : mesh.vertices) v = oracle::scaled_by_two_to(-exponent, v);
    tree.refit(mesh.vertices);
  }

  static double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    const double length2 = d.squaredNorm();
    const double s = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
    return (a + s * d - p).norm();
  }
  static double to_triangle(const Vec3& p, const std::array<Vec3, 3>& t) {
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    bool over = n.squaredNorm() > 0;
    double edges = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = t[k], &b = t[(k + 1) % 3];
      over = over && (b - a).cross(p - a).dot(n) >= 0;
      edges = std::min(edges, to_segment(p, a, b));
    }
    return over ? std::abs((p - t[0]).dot(n)) / n.norm() : edges;
  }
  /// How deep p is inside, if that may be more than `known`; else anything at most `known`.
  double height(const Vec3& p, double known) const {
    double out = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < mesh.triangles.size() && out > known; ++t)
      out = std::min(out, to_triangle(p, tree.corners(t)));
    return out <= known || oracle::strictly_inside(tree, p) ? out : -out;
  }

  TriangleMesh mesh;
  oracle::SurfaceTree tree;
};

constexpr double kBruteRounding = 1e-13;

double sampled_depth(const BruteSolid& of, const BruteSolid& into, TriangleSource& source) {
  double depth = 0.0;
  const auto sample = [&](const Vec3& p) {
    if (into.tree.bounds().contains(p)) depth = std::max(depth, into.height(p, depth));
  };
  for (std::uint32_t t = 0; t < of.mesh.triangles.size(); ++t) {
    const std::array<Vec3, 3> c = of.tree.corners(t);
    for (int k = 0; k < 3; ++k) {
      sample(c[k]);
      sample((c[k] + c[(k + 1) % 3]) / 2);
    }
    for (int i = 0; i < 6; ++i) {
      const double s = std::abs(source.unit()), r = (1 - s) * std::abs(source.unit());
      sample(c[0] + s * (c[1] - c[0]) + r * (c[2] - c[0]));
    }
  }
  return depth;
}

// No point is deeper: pieces of `fine` or less in radius, each at most its radius deeper than its
// middle. Pieces that cannot be deeper than `known` are left out.
double highest_depth(const std::array<Vec3, 3>& piece, const BruteSolid& into, double fine,
                     double known) {
  const Vec3 middle = (piece[0] + piece[1] + piece[2]) / 3;
  double radius = 0.0;
  for (const Vec3& corner : piece) radius = std::max(radius, (corner - middle).norm());
  const double height = into.height(middle, known - radius);
  if (height + radius <= known) return known;
  if (radius <= fine) return height + radius;
  double out = known;
  const Vec3 ab = (piece[0] + piece[1]) / 2, bc = (piece[1] + piece[2]) / 2,
             ca = (piece[2] + piece[0]) / 2;
  for (const std::array<Vec3, 3>& part :
       {std::array{piece[0], ab, ca}, {ab, piece[1], bc}, {ca, bc, piece[2]}, {ab, bc, ca}})
    out = std::max(out, highest_depth(part, into, fine, known));
  return out;
}

double highest_depth(const BruteSolid& of, const BruteSolid& into, double fine, double known) {
  double out = known;
  for (std::uint32_t t = 0; t < of.mesh.triangles.size(); ++t)
    out = std::max(out, highest_depth(of.tree.corners(t), into, fine, known));
  return out;
}

struct Tally {
  int deep = 0, zero = 0, without_vertex = 0;
};

void judge_pair(TriangleSource& source, Tally& tally) {
  const DrawnPair pair = drawn_pair(source);
  const double largest_coordinate = largest(pair.a, pair.b);
  const int exponent = oracle::exponent_above(largest_coordinate);
  const BruteSolid a(pair.a, exponent), b(pair.b, exponent);
  const SurfaceDepth depth = depth_of(pair.a, pair.b);
  expect_width(depth, largest_coordinate);
  const double lower = std::ldexp(depth.lower, -exponent),
               upper = std::ldexp(depth.upper, -exponent);
  const double sampled = std::max(sampled_depth(a, b, source), sampled_depth(b, a, source));
  EXPECT_LE(sampled - kBruteRounding, upper);
  const double fine = std::max(0.08 * upper, 0.004);
  const double highest =
      std::max(highest_depth(a, b, fine, sampled), highest_depth(b, a, fine, sampled));
  EXPECT_GE(highest + kBruteRounding, lower);
  double at_vertices = 0.0;
  for (const Vec3& v : a.mesh.vertices) at_vertices = std::max(at_vertices, b.height(v, 0.0));
  for (const Vec3& v : b.mesh.vertices) at_vertices = std::max(at_vertices, a.height(v, 0.0));
  (lower > 0 ? tally.deep : tally.zero) += 1;
  tally.without_vertex += lower > 0 && at_vertices <= 0;
}

Tally judge_pairs(std::uint64_t seed, int count) {
  TriangleSource source(seed);
  Tally tally;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("pair " + std::to_string(i) + " of seed " + std::to_string(seed));
    judge_pair(source, tally);
  }
  return tally;
}

TEST(SurfaceDepthAgainstBruteForce, RandomSolids) {
  const Tally tally = judge_pairs(812, 250);
  EXPECT_GT(tally.deep, 100);
  EXPECT_GT(tally.zero, 20);
  EXPECT_GT(tally.without_vertex, 1);
}

// Two minutes: an entry of its own in ctest, with the label slow.
TEST(SurfaceDepthAgainstBruteForce, DISABLED_TenThousandPairs) {
  const Tally tally = judge_pairs(813, 10'000);
  EXPECT_GT(tally.deep, 4'000);
  EXPECT_GT(tally.zero, 1'000);
  EXPECT_GT(tally.without_vertex, 100);
}

}  // namespace
}  // namespace contactcheck::test
