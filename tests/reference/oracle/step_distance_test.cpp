// How near reports come to contact, against all pairs of elements and known distances.

#include "reference/oracle/step_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/types/mesh_edges.h"
#include "reference/oracle/step_truth.h"
#include "tests/support/step_scenes.h"

namespace contactcheck::test::step_distance {
namespace {

using oracle::NearVerdict;
using oracle::StepDistances;
using oracle::StepNearness;

double next_below(double x) { return std::nextafter(x, 0.0); }

/// A triangle of edge 1 at rest, and one of half its size above its inside that falls from a height
/// of 1 to 1/8.
StepScene falling() {
  const auto triangle = [](double from, double to) {
    return TriangleMesh{{Vec3(from, from, 0), Vec3(to, from, 0), Vec3(from, to, 0)}, {{0, 1, 2}}};
  };
  std::vector<Body> bodies = {{"large", make_bare_shape(triangle(0, 1))},
                              {"small", make_bare_shape(triangle(0.125, 0.375))}};
  const auto at = [&](double height) {
    NodesOfBodies nodes = {bodies[0].shape->mesh.vertices, bodies[1].shape->mesh.vertices};
    for (Vec3& node : nodes[1]) node.z() += height;
    return nodes;
  };
  NodesOfBodies start = at(1.0), end = at(0.125);
  return make_step_scene("falling", std::move(bodies), std::move(start), std::move(end));
}

const std::map<Level, ElementPair> kReports = {{Level::kImpactVf, {1, 0, 2, 0}},
                                               {Level::kImpactTriangle, {0, 1, 0, 0}},
                                               {Level::kImpact, {0, 1, 0, 0}}};

TEST(StepDistances, ToleranceOfExactlyTheDistanceIsNear) {
  const StepScene scene = falling();
  StepDistances distances(scene.bodies);
  distances.set_step(scene.step());
  for (const auto& [level, pair] : kReports) {
    SCOPED_TRACE(name_of(level));
    EXPECT_EQ(distances.nearness(level, pair, {next_below(0.125), 0}).verdict,
              NearVerdict::kSpurious);
    const StepNearness near = distances.nearness(level, pair, {0.125, 0});
    EXPECT_EQ(near.verdict, NearVerdict::kNear);
    EXPECT_EQ(near.distance, 0.125);
    EXPECT_NEAR(near.of_start, 0.125, 1e-9);
    EXPECT_GE(near.of_start, 0.125);
  }
}

TEST(StepDistances, ToleranceMayBeAShareOfTheDistanceAtTheStart) {
  const StepScene scene = falling();
  StepDistances distances(scene.bodies);
  distances.set_step(scene.step());
  for (const auto& [level, pair] : kReports) {
    SCOPED_TRACE(name_of(level));
    EXPECT_EQ(distances.nearness(level, pair, {0, 0.125}).verdict, NearVerdict::kNear);
    EXPECT_EQ(distances.nearness(level, pair, {0, next_below(0.125)}).verdict,
              NearVerdict::kSpurious);
    EXPECT_EQ(distances.nearness(level, pair, {}).verdict, NearVerdict::kSpurious);
  }
}

TEST(StepDistances, EdgesHaveTheirOwnDistance) {
  const StepScene scene = falling();
  StepDistances distances(scene.bodies);
  distances.set_step(scene.step());
  // Edge 0 of either triangle is that along x: they are parallel, and 1/8 apart along y and z.
  const ElementPair edges{0, 1, 0, 0};
  EXPECT_EQ(distances.nearness(Level::kImpactEe, edges, {0.1767, 0}).verdict,
            NearVerdict::kSpurious);
  const StepNearness near = distances.nearness(Level::kImpactEe, edges, {0.1768, 0});
  EXPECT_EQ(near.verdict, NearVerdict::kNear);
  EXPECT_NEAR(near.distance, std::sqrt(2.0) / 8, 1e-3);
}

TEST(StepDistances, StartHasItsOwnDistance) {
  const StepScene scene = falling();
  StepDistances distances(scene.bodies);
  distances.set_step(scene.step());
  EXPECT_EQ(distances.near_at_start({0, 1}, next_below(1.0)), NearVerdict::kSpurious);
  EXPECT_EQ(distances.near_at_start({0, 1}, 1.0), NearVerdict::kNear);
  // The step is the same afterwards.
  EXPECT_EQ(distances.nearness(Level::kImpact, {0, 1, 0, 0}, {0.125, 0}).verdict,
            NearVerdict::kNear);
}

TEST(StepDistances, ElementsWithACommonVertexAreNeverNear) {
  StepScene scene;
  TriangleMesh mesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)},
                    {{0, 1, 2}, {2, 1, 3}}};
  const NodesOfBodies at = {mesh.vertices};
  scene = make_step_scene("sheet", {{"sheet", make_bare_shape(mesh)}}, at, at);
  StepDistances distances(scene.bodies);
  distances.set_step(scene.step());
  EXPECT_EQ(distances.nearness(Level::kImpactSelfVf, {0, 0, 1, 0}, {10, 0}).verdict,
            NearVerdict::kSpurious);
  EXPECT_EQ(distances.nearness(Level::kImpactSelfVf, {0, 0, 3, 0}, {10, 0}).verdict,
            NearVerdict::kNear);
}

/// By all elements of two bodies; none of them meet.
NearVerdict brute_force(StepDistances& distances, const StepScene& scene, std::uint32_t a,
                        std::uint32_t b, const ImpactTolerance& tolerance) {
  const TriangleMesh &p = scene.bodies[a].shape->mesh, &q = scene.bodies[b].shape->mesh;
  const auto near = [&](Level level, const ElementPair& pair) {
    return distances.nearness(level, pair, tolerance).verdict == NearVerdict::kNear;
  };
  for (std::uint32_t v = 0; v < p.vertices.size(); ++v)
    for (std::uint32_t t = 0; t < q.triangles.size(); ++t)
      if (near(Level::kImpactVf, {a, b, v, t})) return NearVerdict::kNear;
  for (std::uint32_t v = 0; v < q.vertices.size(); ++v)
    for (std::uint32_t t = 0; t < p.triangles.size(); ++t)
      if (near(Level::kImpactVf, {b, a, v, t})) return NearVerdict::kNear;
  const auto edges = [](const TriangleMesh& mesh) {
    return static_cast<std::uint32_t>(mesh_edges(mesh.triangles).edges.size());
  };
  for (std::uint32_t e = 0; e < edges(p); ++e)
    for (std::uint32_t f = 0; f < edges(q); ++f)
      if (near(Level::kImpactEe, {a, b, e, f})) return NearVerdict::kNear;
  return NearVerdict::kSpurious;
}

/// Two octahedra, each 2 wide, that move and turn.
StepScene two_octahedra(TriangleSource& random) {
  const Body body = {"octahedron", make_bare_shape(sphere_mesh(Vec3::Zero(), 1.0, 0))};
  NodesOfBodies start(2), end(2);
  for (std::size_t b = 0; b < 2; ++b) {
    const Vec3 from = random.point(Vec3(3.0 * static_cast<double>(b), 0, 0), 0.8);
    const Vec3 to = random.point(from, 0.6);
    const Eigen::Matrix3d first = draw_rotation(random), last = draw_rotation(random);
    for (const Vec3& node : body.shape->mesh.vertices) {
      start[b].push_back(first * node + from);
      end[b].push_back(last * node + to);
    }
  }
  return make_step_scene("octahedra", {body, body}, std::move(start), std::move(end));
}

TEST(StepDistances, BodiesAreNearWhereSomeOfTheirElementsAre) {
  TriangleSource random(56);
  std::map<NearVerdict, int> seen;
  for (int drawn = 0; drawn < 40; ++drawn) {
    const StepScene scene = two_octahedra(random);
    const Step step = scene.step();
    oracle::StepOracle steps(scene.bodies);
    if (!steps.judge(step, {}, {true, false}).first.empty()) continue;
    StepDistances distances(scene.bodies);
    distances.set_step(step);
    const ImpactTolerance tolerance{drawn % 3 == 0 ? 0.0 : 0.5 * (1 + random.unit()),
                                    drawn % 3 == 1 ? 0.0 : 0.5 * (1 + random.unit())};
    const NearVerdict verdict = distances.nearness(Level::kImpact, {0, 1, 0, 0}, tolerance).verdict;
    ASSERT_EQ(verdict, brute_force(distances, scene, 0, 1, tolerance)) << drawn;
    ++seen[verdict];
  }
  EXPECT_GE(seen[NearVerdict::kNear], 3);
  EXPECT_GE(seen[NearVerdict::kSpurious], 3);
}

// Boxes of steep triangles overlap where the triangles are apart.
TEST(StepDistances, SearchOfBodiesEndsUndecided) {
  constexpr std::uint32_t kQuads = 22;
  TriangleMesh sheet;
  for (std::uint32_t i = 0; i <= kQuads; ++i)
    for (std::uint32_t j = 0; j <= kQuads; ++j)
      sheet.vertices.emplace_back(i, j, -static_cast<double>(i) - static_cast<double>(j));
  for (std::uint32_t i = 0; i < kQuads; ++i)
    for (std::uint32_t j = 0; j < kQuads; ++j) {
      const std::uint32_t corner = i * (kQuads + 1) + j, next = corner + kQuads + 1;
      sheet.triangles.push_back({corner, next, corner + 1});
      sheet.triangles.push_back({next, next + 1, corner + 1});
    }
  std::vector<Body> bodies = {{"lower", make_bare_shape(sheet)}, {"upper", make_bare_shape(sheet)}};
  NodesOfBodies at = {sheet.vertices, sheet.vertices};
  for (Vec3& node : at[1]) node.z() += 0.5;
  const StepScene scene = make_step_scene("sheets", std::move(bodies), at, at);
  StepDistances distances(scene.bodies);
  distances.set_step(scene.step());
  const double apart = 0.5 / std::sqrt(3.0);
  EXPECT_EQ(distances.nearness(Level::kImpact, {0, 1, 0, 0}, {0.99 * apart, 0}).verdict,
            NearVerdict::kUndecided);
  EXPECT_EQ(distances.nearness(Level::kImpact, {0, 1, 0, 0}, {1.01 * apart, 0}).verdict,
            NearVerdict::kNear);
}

}  // namespace
}  // namespace contactcheck::test::step_distance
