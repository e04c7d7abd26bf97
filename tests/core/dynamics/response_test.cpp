#include "core/dynamics/response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/dynamics/contact_cases.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using test::random_blend;
using test::same_bits;

// Bodies that are clouds of nodes; empty masses: cannot be moved.
struct World {
  std::vector<NodeState> states;
  std::vector<std::vector<double>> masses;
  double restitution = 0.0, friction = 0.0;
  ResponseSettings settings;

  void add(std::vector<Vec3> positions, std::vector<Vec3> velocities, std::vector<double> mass) {
    states.push_back({std::move(positions), std::move(velocities)});
    masses.push_back(std::move(mass));
  }
  void respond(const std::vector<ContactPoint>& points) {
    std::vector<ResponseBody> bodies(states.size());
    for (std::size_t b = 0; b < states.size(); ++b)
      bodies[b] = {&states[b], masses[b], restitution, friction};
    respond_to_contacts(points, settings, bodies);
  }
  Vec3 momentum() const {
    Vec3 out = Vec3::Zero();
    for (std::size_t b = 0; b < states.size(); ++b)
      for (std::size_t n = 0; n < masses[b].size(); ++n)
        out += masses[b][n] * states[b].velocities[n];
    return out;
  }
  double kinetic_energy() const {
    double out = 0.0;
    for (std::size_t b = 0; b < states.size(); ++b)
      for (std::size_t n = 0; n < masses[b].size(); ++n)
        out += 0.5 * masses[b][n] * states[b].velocities[n].squaredNorm();
    return out;
  }
};

ContactPoint between(const NodeBlend& a, const NodeBlend& b, const Vec3& normal, double depth) {
  return {0, 1, a, b, normal, depth};
}

// Nodes 0 of bodies 0 and 1, separated along x.
ContactPoint along_x(double depth = 0.0) {
  return between({{0}, {1.0}}, {{0}, {1.0}}, Vec3::UnitX(), depth);
}

// Two bodies of one node each.
World two_masses(double mass_a, const Vec3& velocity_a, double mass_b, const Vec3& velocity_b) {
  World world;
  world.add({Vec3::Zero()}, {velocity_a}, {mass_a});
  world.add({Vec3::UnitX()}, {velocity_b}, {mass_b});
  return world;
}

// Two bodies of eight nodes that meet in `count` points; normals within 45 degrees of x.
constexpr std::uint32_t kNodes = 8;

World random_world(test::TriangleSource& random) {
  World world;
  for (double side : {-1.0, 1.0}) {
    std::vector<Vec3> positions, velocities;
    std::vector<double> masses;
    for (std::uint32_t n = 0; n < kNodes; ++n) {
      positions.push_back(random.point(Vec3(side, 0, 0), 1.0));
      velocities.push_back(random.point(Vec3(-3.0 * side, 0, 0), 4.0));
      masses.push_back(1.0 + 0.9 * random.unit());
    }
    world.add(positions, velocities, masses);
  }
  return world;
}

std::vector<ContactPoint> random_points(test::TriangleSource& random, int count) {
  std::vector<ContactPoint> points;
  for (int i = 0; i < count; ++i) {
    const Vec3 normal = (Vec3::UnitX() + 0.7 * random.point(Vec3::Zero(), 1.0)).normalized();
    points.push_back(between(random_blend(random, kNodes), random_blend(random, kNodes), normal,
                             0.1 * std::abs(random.unit())));
  }
  return points;
}

double approach_speed(const World& world, const ContactPoint& p) {
  return (test::blended(p.a, world.states[p.body_a].velocities) -
          test::blended(p.b, world.states[p.body_b].velocities))
      .dot(p.normal);
}

double distance_along(const World& world, const ContactPoint& p) {
  return (test::blended(p.b, world.states[p.body_b].positions) -
          test::blended(p.a, world.states[p.body_a].positions))
      .dot(p.normal);
}

TEST(Response, ConservesLinearMomentum) {
  test::TriangleSource random(81);
  for (int round = 0; round < 100; ++round) {
    World world = random_world(random);
    world.restitution = 0.5;
    world.friction = 0.5;
    const Vec3 before = world.momentum();
    const World start = world;
    world.respond(random_points(random, 20));
    EXPECT_LE((world.momentum() - before).norm(), 1e-12);
    EXPECT_FALSE(same_bits(world.states[0], start.states[0]));
  }
}

TEST(Response, KeepsTheCentreOfMass) {
  test::TriangleSource random(82);
  World world = random_world(random);
  const auto centre = [&] {
    Vec3 sum = Vec3::Zero();
    for (int b = 0; b < 2; ++b)
      for (std::uint32_t n = 0; n < kNodes; ++n)
        sum += world.masses[b][n] * world.states[b].positions[n];
    return sum;
  };
  const Vec3 before = centre();
  world.respond(random_points(random, 20));
  EXPECT_LE((centre() - before).norm(), 1e-12);
}

TEST(Response, NeverGainsKineticEnergy) {
  test::TriangleSource random(83);
  std::size_t conserved = 0;
  for (int round = 0; round < 1000; ++round) {
    World world = random_world(random);
    world.restitution = 0.5 * (round % 3);
    world.friction = 0.5 * (round / 3 % 3);
    const double before = world.kinetic_energy();
    world.respond(random_points(random, 1 + round % 20));
    EXPECT_LE(world.kinetic_energy(), before * (1.0 + 1e-12));
    if (world.kinetic_energy() > before * (1.0 - 1e-12)) ++conserved;
  }
  EXPECT_GT(conserved, 100u);  // it is a bound that is reached
}

TEST(Response, OfACentralElasticCollisionSwapsTheVelocities) {
  World world = two_masses(2.0, {3.0, 0.25, 0.0}, 2.0, {-1.0, 0.0, 0.5});
  world.restitution = 1.0;
  world.respond({along_x()});
  EXPECT_LE((world.states[0].velocities[0] - Vec3(-1.0, 0.25, 0.0)).norm(), 1e-15);
  EXPECT_LE((world.states[1].velocities[0] - Vec3(3.0, 0.0, 0.5)).norm(), 1e-15);
}

TEST(Response, UsesTheLargerRestitutionAndTheGeometricMeanOfFrictions) {
  World world = two_masses(1.0, {2.0, 3.0, 0.0}, 3.0, Vec3::Zero());
  std::vector<ResponseBody> bodies = {{&world.states[0], world.masses[0], 0.25, 0.4},
                                      {&world.states[1], world.masses[1], 0.5, 0.1}};
  respond_to_contacts({along_x()}, {}, bodies);
  // Effective mass 3/4 kg, impulse 3/4 * 2 * (1 + 1/2) = 9/4 N s, friction 0.2 of it.
  EXPECT_LE((world.states[0].velocities[0] - Vec3(-0.25, 3.0 - 0.45, 0.0)).norm(), 1e-15);
  EXPECT_LE((world.states[1].velocities[0] - Vec3(0.75, 0.15, 0.0)).norm(), 1e-15);
}

TEST(Response, WithoutRestitutionStopsTheApproach) {
  test::TriangleSource random(84);
  for (int round = 0; round < 100; ++round) {
    World world = random_world(random);
    const auto points = random_points(random, 1);
    if (approach_speed(world, points[0]) <= 0.0) continue;
    world.respond(points);
    EXPECT_NEAR(approach_speed(world, points[0]), 0.0, 1e-14);
  }
}

TEST(Response, ToASlowApproachDoesNotBounce) {
  World world = two_masses(1.0, {0.375, 0, 0}, 1.0, Vec3::Zero());  // below 0.4 m/s
  world.restitution = 1.0;
  world.respond({along_x()});
  EXPECT_EQ(world.states[0].velocities[0], world.states[1].velocities[0]);
}

TEST(Response, LeavesPartingBodiesAlone) {
  World world = two_masses(1.0, {-1.0, 2.0, 0}, 1.0, {1.0, 0, 0});
  world.restitution = world.friction = 1.0;
  const World start = world;
  world.respond({along_x()});
  for (int b = 0; b < 2; ++b) EXPECT_TRUE(same_bits(world.states[b], start.states[b]));
}

TEST(Response, FrictionSlowsSlidingByCoulombsShare) {
  World world = two_masses(1.0, {2.0, 3.0, -4.0}, 1.0, Vec3::Zero());
  world.masses[1].clear();
  world.friction = 0.5;
  world.respond({along_x()});
  // 2 N s along x; 1 N s against a sliding of 5 m/s.
  EXPECT_LE((world.states[0].velocities[0] - Vec3(0.0, 2.4, -3.2)).norm(), 1e-15);
}

TEST(Response, FrictionStopsSlidingAndDoesNotReverseIt) {
  World world = two_masses(1.0, {2.0, 0.3, -0.4}, 1.0, Vec3::Zero());
  world.masses[1].clear();
  world.friction = 0.5;
  world.respond({along_x(), along_x(), along_x()});
  EXPECT_LE(world.states[0].velocities[0].norm(), 1e-15);
}

TEST(Response, LeavesARestingBodyBitForBit) {
  World world = two_masses(1.0, {-0.0, 0.0, -0.0}, 2.0, Vec3::Constant(-0.0));
  world.states[0].positions[0] = Vec3(-0.0, 0.1, -0.0);
  world.restitution = world.friction = 1.0;
  const World start = world;
  world.respond({along_x(0.0), along_x(0.0)});
  for (int b = 0; b < 2; ++b) EXPECT_TRUE(same_bits(world.states[b], start.states[b]));
}

TEST(Response, OfSwappedBodiesIsMirroredBitForBit) {
  test::TriangleSource random(85);
  World world = random_world(random);
  world.restitution = 0.5;
  world.friction = 0.3;
  World swapped = world;
  std::swap(swapped.states[0], swapped.states[1]);
  std::swap(swapped.masses[0], swapped.masses[1]);
  auto points = random_points(random, 10);
  world.respond(points);
  for (ContactPoint& p : points) {
    std::swap(p.a, p.b);
    p.normal = -p.normal;
  }
  swapped.respond(points);
  EXPECT_TRUE(same_bits(world.states[0], swapped.states[1]));
  EXPECT_TRUE(same_bits(world.states[1], swapped.states[0]));
}

TEST(Response, LeavesImmovableBodiesBitForBit) {
  test::TriangleSource random(86);
  World world = random_world(random);
  world.restitution = 0.5;
  world.masses[1].clear();
  const World start = world;
  const auto points = random_points(random, 10);
  world.respond(points);
  EXPECT_TRUE(same_bits(world.states[1], start.states[1]));
  EXPECT_FALSE(same_bits(world.states[0], start.states[0]));
  const World middle = world;
  world.masses[0].clear();
  world.respond(points);
  EXPECT_TRUE(same_bits(world.states[0], middle.states[0]));
}

TEST(Response, OfOtherBodiesIsOfNoConsequence) {
  test::TriangleSource random(87);
  for (int round = 0; round < 20; ++round) {
    World alone = random_world(random), both = alone;
    const World other = random_world(random);
    for (int b = 0; b < 2; ++b) {
      both.states.push_back(other.states[b]);
      both.masses.push_back(other.masses[b]);
    }
    alone.restitution = both.restitution = 1.0;
    auto points = random_points(random, 5);
    alone.respond(points);
    for (ContactPoint p : random_points(random, 5)) {
      p.body_a = 2;
      p.body_b = 3;
      points.push_back(p);
    }
    both.respond(points);
    for (int b = 0; b < 2; ++b) EXPECT_TRUE(same_bits(alone.states[b], both.states[b]));
  }
}

TEST(Response, CorrectsTheSameDepthForOnePointAndForAThousand) {
  test::TriangleSource random(88);
  const ContactPoint point = random_points(random, 1)[0];
  for (std::size_t count : {1u, 1000u}) {
    World world = random_world(random);
    world.settings.corrected_share = 0.5;
    const double before = distance_along(world, point);
    world.respond(std::vector<ContactPoint>(count, point));
    EXPECT_NEAR(distance_along(world, point) - before, 0.5 * point.depth, 1e-14);
  }
}

TEST(Response, CorrectsDepthByInverseMass) {
  World world = two_masses(1.0, Vec3::Zero(), 3.0, Vec3::Zero());
  world.settings.corrected_share = 0.5;
  world.respond({along_x(0.5)});
  EXPECT_EQ(world.states[0].positions[0], Vec3(-0.1875, 0, 0));
  EXPECT_EQ(world.states[1].positions[0], Vec3(1.0625, 0, 0));
  EXPECT_EQ(world.momentum(), Vec3::Zero());  // a correction gives no speed
}

// Without a model of deformation nothing holds a body's nodes together: all take the mean offset.
void make_rigid(const std::vector<Vec3>& before, std::vector<Vec3>& positions) {
  Vec3 offset = Vec3::Zero();
  for (std::size_t n = 0; n < before.size(); ++n) offset += positions[n] - before[n];
  offset /= static_cast<double>(before.size());
  for (std::size_t n = 0; n < before.size(); ++n) positions[n] = before[n] + offset;
}

// A smaller cube in the middle of a larger one's face, overlapping along x; what a detector would
// report is found and answered until a twentieth of the overlap is left.
template <typename Contacts>
void expect_separated(double overlap, const Contacts& contacts) {
  const std::vector<Body> bodies = {
      test::make_body("a", test::unit_box_mesh(4), {3, 3, 3}),
      test::make_body("b", test::box_mesh({1.0, 0.2, 0.2}, {1.6, 0.8, 0.8}, 3), {2, 2, 2})};
  World world;
  for (const Body& body : bodies) {
    const std::size_t nodes = body.shape->node_count();
    world.add(test::rest_nodes_at(*body.shape, Vec3::Zero()), {nodes, Vec3::Zero()},
              std::vector<double>(nodes, 0.1));
  }
  for (Vec3& n : world.states[1].positions) n.x() -= overlap;
  const ContactPoints maker(bodies, ContactVolume::kFfdAabb);
  const World start = world;
  Vec3 offset = Vec3::Zero();  // of b against a
  for (int round = 0; round < 200 && offset.x() < 0.95 * overlap; ++round) {
    const World before = world;
    const test::FrameData data =
        test::make_frame(bodies, {world.states[0].positions, world.states[1].positions});
    world.respond(maker.from(contacts(bodies, data.frame()), data.frame()));
    for (int b = 0; b < 2; ++b) make_rigid(before.states[b].positions, world.states[b].positions);
    offset = (world.states[1].positions[0] - start.states[1].positions[0]) -
             (world.states[0].positions[0] - start.states[0].positions[0]);
  }
  EXPECT_GE(offset.x(), 0.95 * overlap);
  EXPECT_LE(offset.x(), 1.05 * overlap);  // separated, not thrown
  EXPECT_LE(std::abs(offset.y()) + std::abs(offset.z()), 0.2 * overlap);
}

TEST(Response, PartsOverlappingBoxesByTheirTriangles) {
  expect_separated(0.2, test::triangle_contacts);
}

// Cells are a third of a metre: the nearest plane of one is the surface only for half of that.
TEST(Response, PartsOverlappingBoxesByTheirCells) {
  expect_separated(
      0.05, [](const std::vector<Body>& bodies, const Frame&) { return test::all_cells(bodies); });
}

TEST(GroundResponse, StopsBouncesSlowsAndLifts) {
  const auto shape = make_bare_shape(test::triangle_mesh({0, -0.5, 0}, {1, 2, 0}, {0, 2, 1}));
  World world;
  world.add(shape->mesh.vertices, {{3, -2, 0}, {0, -2, 0}, {0, -2, 0}}, {2.0, 2.0, 2.0});
  ResponseBody body{&world.states[0], world.masses[0], 0.0, 0.15};
  Ground ground;  // restitution 0.2, friction 0.6: with the body's, 0.3
  world.settings.corrected_share = 0.5;
  respond_to_ground(*shape, vertices_in_ground(*shape, world.states[0].positions, ground), ground,
                    world.settings, body);
  EXPECT_LE((world.states[0].velocities[0] - Vec3(3.0 - 0.3 * 2.4, 0.4, 0.0)).norm(), 1e-15);
  EXPECT_EQ(world.states[0].positions[0], Vec3(0, -0.25, 0));
  EXPECT_EQ(world.states[0].velocities[1], Vec3(0, -2, 0));
  EXPECT_EQ(world.states[0].positions[1], Vec3(1, 2, 0));
}

TEST(GroundResponse, LeavesABodyThatRestsOnItBitForBit) {
  const auto shape = make_shape(test::unit_box_mesh(3), {2, 3, 2});
  World world;
  world.add(test::rest_nodes_at(*shape, {0.1, 0.7, 0.3}), {shape->node_count(), Vec3::Zero()},
            std::vector<double>(shape->node_count(), 0.5));
  std::vector<Vec3> vertices(shape->mesh.vertices.size());
  map_body(*shape, world.states[0].positions, vertices);
  Ground ground;
  ground.height = bounding_box(vertices).lo.y();
  const auto held = vertices_in_ground(*shape, world.states[0].positions, ground);
  ASSERT_FALSE(held.empty());
  const World start = world;
  ResponseBody body{&world.states[0], world.masses[0], 0.5, 0.5};
  respond_to_ground(*shape, held, ground, {}, body);
  EXPECT_TRUE(same_bits(world.states[0], start.states[0]));
}

}  // namespace
}  // namespace contactcheck
