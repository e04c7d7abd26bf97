#include "core/deform/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/deform/body.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-14;  // metres, for bodies of size 1

Curve constant(double value) { return {{{0.0, value}}, false}; }

void expect_near(const Vec3& actual, const Vec3& expected, double tolerance = kRounding) {
  EXPECT_LT((actual - expected).norm(), tolerance)
      << actual.transpose() << " is not " << expected.transpose();
}

// Where `points` of a body [-1, 1]^3 go. They are points of a bare shape.
std::vector<Vec3> moved(const std::vector<Vec3>& points, const Motion& motion, double time = 0.0) {
  TriangleMesh mesh = test::box_mesh(Vec3::Constant(-1), Vec3::Ones(), 1);
  for (const Vec3& p : points) {
    const auto v = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(p);
    mesh.triangles.push_back({v, v, v});
  }
  const std::vector<Vec3> nodes = nodes_at(*make_bare_shape(mesh), motion, time);
  return {nodes.end() - static_cast<std::ptrdiff_t>(points.size()), nodes.end()};
}

Motion deformed_by(const Deformer& deformer) {
  Motion motion;
  motion.deformers = {deformer};
  return motion;
}

TEST(Curve, IsLinearBetweenKeysAndConstantOutside) {
  const Curve curve{{{1.0, 10.0}, {2.0, 20.0}, {4.0, 0.0}}, false};
  EXPECT_EQ(curve.at(0.0), 10.0);
  EXPECT_EQ(curve.at(1.0), 10.0);
  EXPECT_EQ(curve.at(1.25), 12.5);
  EXPECT_EQ(curve.at(2.0), 20.0);
  EXPECT_EQ(curve.at(3.0), 10.0);
  EXPECT_EQ(curve.at(4.0), 0.0);
  EXPECT_EQ(curve.at(99.0), 0.0);
}

TEST(Curve, SmoothEasesWithThreeSquaresMinusTwoCubes) {
  const Curve curve{{{0.0, 0.0}, {1.0, 32.0}}, true};
  EXPECT_EQ(curve.at(0.25), 5.0);
  EXPECT_EQ(curve.at(0.5), 16.0);
  EXPECT_EQ(curve.at(0.75), 27.0);
  EXPECT_EQ(curve.at(1.5), 32.0);
}

TEST(Curve, WithoutKeysIsZeroAndWithOneIsConstant) {
  EXPECT_EQ(Curve{}.at(3.0), 0.0);
  EXPECT_EQ(constant(7.0).at(-1.0), 7.0);
  EXPECT_EQ(constant(7.0).at(9.0), 7.0);
}

TEST(Motion, EmptyPathPutsTheRestCentreAtTheOrigin) {
  TriangleMesh mesh = test::box_mesh({4, 5, 6}, {6, 9, 12}, 1);  // centre (5, 7, 9)
  const std::vector<Vec3> nodes = nodes_at(*make_bare_shape(mesh), Motion{}, 0.0);
  for (std::size_t v = 0; v < nodes.size(); ++v)
    expect_near(nodes[v], mesh.vertices[v] - Vec3(5, 7, 9));
}

TEST(Twist, Of90DegreesTurnsTopAndBottomBy45EachWay) {
  const auto p =
      moved({{1, 1, 1}, {1, 1, -1}, {1, 1, 0}, {1, 1, 0.5}}, deformed_by(Twist{2, constant(90.0)}));
  expect_near(p[0], {0, std::sqrt(2.0), 1});
  expect_near(p[1], {std::sqrt(2.0), 0, -1});
  expect_near(p[2], {1, 1, 0});
  const double at = kPi / 4 + kPi / 8;
  expect_near(p[3], {std::sqrt(2.0) * std::cos(at), std::sqrt(2.0) * std::sin(at), 0.5});
}

TEST(Twist, AboutXIsTheSameWithTurnedAxes) {
  const auto p = moved({{1, 1, 1}}, deformed_by(Twist{0, constant(90.0)}));
  expect_near(p[0], {1, 0, std::sqrt(2.0)});
}

TEST(Bend, KeepsTheLengthOfTheCentreLine) {
  std::vector<Vec3> line;
  constexpr int kPieces = 1000;
  for (int i = 0; i <= kPieces; ++i) line.push_back({0, 0, 2.0 * i / kPieces - 1.0});
  for (double angle : {-200.0, 1e-9, 90.0, 300.0}) {
    const auto bent = moved(line, deformed_by(Bend{2, 0, constant(angle)}));
    double length = 0.0;
    for (int i = 1; i <= kPieces; ++i) length += (bent[i] - bent[i - 1]).norm();
    // A chord is shorter than its arc by the share theta^2 / 24, here below 2e-6.
    EXPECT_NEAR(length, 2.0, 5e-6) << angle;
  }
}

TEST(Bend, By90DegreesPutsTheTopOnAnArcAndTurnsItsSection) {
  const auto p = moved({{0, 0, 1}, {1, 0.5, 1}, {0, 0, 0}}, deformed_by(Bend{2, 0, constant(90)}));
  const double radius = 4.0 / kPi, c = std::sqrt(0.5);  // 2 metres on a quarter circle; at 45
  expect_near(p[0], {radius * (1 - c), 0, radius * c});
  expect_near(p[1], {radius - (radius - 1) * c, 0.5, (radius - 1) * c});
  expect_near(p[2], {0, 0, 0});
}

TEST(Bend, ByZeroDegreesMovesNothing) {
  const Vec3 p(0.25, -0.5, 0.75);
  EXPECT_EQ(moved({p}, deformed_by(Bend{2, 1, constant(0.0)}))[0], p);
}

TEST(Taper, ScalesSectionsByTheirHeight) {
  const auto p = moved({{1, 1, 1}, {1, 1, -1}, {1, 1, 0}}, deformed_by(Taper{2, constant(0.5)}));
  expect_near(p[0], {1.5, 1.5, 1});
  expect_near(p[1], {0.5, 0.5, -1});
  expect_near(p[2], {1, 1, 0});
}

TEST(Stretch, KeepsTheVolumeOfABox) {
  for (double amount : {-0.5, 0.0, 1.0, 3.0}) {
    const auto p = moved({{1, 1, 1}, {-1, -1, -1}}, deformed_by(Stretch{1, constant(amount)}));
    const Vec3 size = p[0] - p[1];
    EXPECT_NEAR(size.y(), 2.0 * (1.0 + amount), kRounding);
    EXPECT_NEAR(size.prod(), 8.0, 1e-13) << amount;
  }
}

NodeKeys two_keys() {
  NodeKeys keys;
  keys.keys = {{1.0, {{{0, 0, 0}, Vec3(8, 0, 0)}}},
               {3.0, {{{0, 0, 0}, Vec3(0, 4, 0)}, {{1, 1, 1}, Vec3(0, 0, 2)}}}};
  return keys;
}

TEST(NodeKeys, MoveNamedNodesLinearlyBetweenKeys) {
  const auto shape =
      make_shape(test::box_mesh(Vec3::Constant(-1), Vec3::Ones(), 1), {1, 1, 1}, 0.5);
  const std::vector<Vec3> rest = shape->lattice->rest_nodes();  // corners of [-2, 2]^3
  const auto at = [&](double time) { return nodes_at(*shape, deformed_by(two_keys()), time); };
  expect_near(at(0.0)[0], rest[0] + Vec3(8, 0, 0));
  expect_near(at(1.5)[0], rest[0] + Vec3(6, 1, 0));
  expect_near(at(1.5)[7], rest[7] + Vec3(0, 0, 0.5));
  expect_near(at(9.0)[7], rest[7] + Vec3(0, 0, 2));
  for (std::size_t n = 1; n < 7; ++n) expect_near(at(2.0)[n], rest[n]);
}

TEST(NodeKeys, WithoutKeysOrForNodesNotKeptMoveNothing) {
  const auto shape = make_shape(test::unit_box_mesh(1), {1, 1, 1});
  NodeKeys other;
  other.keys = {{0.0, {{{5, 5, 5}, Vec3(1, 1, 1)}}}};
  const auto rest = nodes_at(*shape, Motion{}, 0.0);
  EXPECT_EQ(nodes_at(*shape, deformed_by(NodeKeys{}), 0.0), rest);
  EXPECT_EQ(nodes_at(*shape, deformed_by(other), 0.0), rest);
}

TEST(RigidPath, SpinsAboutTheRestCentreThenMovesItThere) {
  Motion motion;
  motion.path.position = {constant(10), constant(20), Curve{{{0, 30}, {2, 50}}, false}};
  motion.path.spins = {{Vec3(0, 0, 2), constant(90)}, {Vec3::UnitX(), constant(90)}};
  // About z first: (1, 0, 0) -> (0, 1, 0), then about x -> (0, 0, 1).
  expect_near(moved({{1, 0, 0}}, motion, 1.0)[0], {10, 20, 41}, 1e-13);
}

TEST(RigidPath, ComesAfterTheDeformers) {
  Motion motion = deformed_by(Stretch{0, constant(1.0)});
  motion.path.spins = {{Vec3::UnitZ(), constant(90)}};
  expect_near(moved({{1, 0, 0}}, motion)[0], {0, 2, 0});
}

TEST(Motion, DisplacementsOfDeformersAreSummedFromRest) {
  const Twist twist{2, constant(70)};
  const Stretch stretch{2, constant(0.5)};
  const Vec3 p(0.5, -0.25, 0.75);
  Motion both;
  both.deformers = {twist, stretch};
  const Vec3 by_twist = moved({p}, deformed_by(twist))[0] - p;
  const Vec3 by_stretch = moved({p}, deformed_by(stretch))[0] - p;
  EXPECT_GT(by_twist.norm(), 0.1);
  EXPECT_GT(by_stretch.norm(), 0.1);
  expect_near(moved({p}, both)[0], p + by_twist + by_stretch);
  std::swap(both.deformers[0], both.deformers[1]);
  expect_near(moved({p}, both)[0], p + by_twist + by_stretch);
}

TEST(Motion, MovesLatticeNodesOfAnEmbeddedBody) {
  const auto shape = make_shape(test::unit_box_mesh(2), {3, 3, 3});
  Motion motion;
  motion.path.position = {constant(0.5), constant(0.5), constant(7.5)};  // centre was (.5, .5, .5)
  const auto nodes = nodes_at(*shape, motion, 0.0);
  ASSERT_EQ(nodes.size(), shape->lattice->nodes.size());
  for (std::uint32_t n = 0; n < nodes.size(); ++n)
    expect_near(nodes[n], shape->lattice->rest_node(n) + Vec3(0, 0, 7));
}

TEST(MotionDeathTest, NodeKeysWithoutALatticeBreakAPromise) {
  const auto shape = make_bare_shape(test::unit_box_mesh(1));
  EXPECT_DEATH(nodes_at(*shape, deformed_by(two_keys()), 0.0), "node keyframes");
}

}  // namespace
}  // namespace contactcheck
