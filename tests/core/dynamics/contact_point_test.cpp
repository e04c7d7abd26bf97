#include "core/dynamics/contact_point.h"

#include <gtest/gtest.h>

#include <set>

#include "core/deform/mapping.h"
#include "tests/core/dynamics/contact_cases.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

// Coordinates are a few metres; a point goes through some twenty roundings of 2^-53.
constexpr double kRounding = 1e-14;

// Lattice [-1/2, 3/2]^3, one cell, round the cube [0, 1]^3: its FFD-AABB is [1/4, 3/4]^3 in local
// coordinates.
std::vector<Body> two_cubes() {
  return {test::make_body("a", test::unit_box_mesh(1), {1, 1, 1}, 0.5),
          test::make_body("b", test::unit_box_mesh(1), {1, 1, 1}, 0.5)};
}

test::FrameData cubes_apart(const std::vector<Body>& bodies, const Vec3& offset) {
  return test::make_frame(bodies, {test::rest_nodes_at(*bodies[0].shape, Vec3::Zero()),
                                   test::rest_nodes_at(*bodies[1].shape, offset)});
}

void expect_near(const Vec3& actual, const Vec3& expected, double tolerance) {
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), tolerance)
      << actual.transpose() << " instead of " << expected.transpose();
}

void expect_convex(const NodeBlend& blend) {
  ASSERT_EQ(blend.nodes.size(), blend.weights.size());
  for (double weight : blend.weights) EXPECT_GE(weight, 0.0);
  EXPECT_NEAR(test::weight_sum(blend), 1.0, 1e-15);
  EXPECT_EQ(std::set<std::uint32_t>(blend.nodes.begin(), blend.nodes.end()).size(),
            blend.nodes.size());
}

TEST(NodeBlend, OfAVertexReproducesTheMappedVertex) {
  const auto shape = make_shape(test::sphere_mesh({0.1, 0.2, 0.3}, 1.0, 2), {3, 4, 2});
  test::TriangleSource random(71);
  std::vector<Vec3> nodes(shape->node_count());
  for (Vec3& n : nodes) n = random.point(Vec3::Zero(), 1.0);
  std::vector<Vec3> vertices(shape->mesh.vertices.size());
  map_body(*shape, nodes, vertices);
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const NodeBlend blend = blend_of_vertex(*shape, v);
    expect_convex(blend);
    expect_near(test::blended(blend, nodes), vertices[v], 1e-15);  // nodes are below 1
  }
}

TEST(NodeBlend, OfABareVertexIsTheVertex) {
  const auto shape = make_bare_shape(test::unit_box_mesh(1));
  const NodeBlend blend = blend_of_vertex(*shape, 5);
  EXPECT_EQ(blend.nodes, std::vector<std::uint32_t>{5});
  EXPECT_EQ(blend.weights, std::vector<double>{1.0});
}

TEST(NodeBlend, OfALocalCornerIsThatNodeAlone) {
  const auto shape = make_shape(test::unit_box_mesh(1), {2, 2, 2});
  const NodeBlend blend = blend_of_local(*shape->lattice, 3, {1.0, 0.0, 1.0});
  for (int c = 0; c < 8; ++c) {
    EXPECT_EQ(blend.nodes[c], shape->lattice->cell_nodes[3][c]);
    EXPECT_EQ(blend.weights[c], c == 5 ? 1.0 : 0.0);
  }
}

TEST(CellPoints, CornersInsideTheOtherCellHaveTheDepthAndSideInClosedForm) {
  const std::vector<Body> bodies = two_cubes();
  // b's low corner at (1, 3/4, 1/2), a's high corner at 3/2: 1/2 deep along x, less than y and z.
  const test::FrameData data = cubes_apart(bodies, {1.5, 1.25, 1.0});
  const auto points =
      ContactPoints(bodies, ContactVolume::kCell).from(test::all_cells(bodies), data.frame());
  ASSERT_EQ(points.size(), 2u);
  const Vec3 places[2] = {{1.5, 1.5, 1.5}, {1.0, 0.75, 0.5}};
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(points[i].body_a, 0u);
    EXPECT_EQ(points[i].body_b, 1u);
    EXPECT_NEAR(points[i].depth, 0.5, kRounding);
    expect_near(points[i].normal, Vec3::UnitX(), kRounding);
    expect_near(test::blended(points[i].a, data.nodes[0]), places[i], kRounding);
    expect_near(test::blended(points[i].b, data.nodes[1]), places[i], kRounding);
  }
}

TEST(CellPoints, OfFfdAabbsUseTheSurfacesBoxes) {
  const std::vector<Body> bodies = two_cubes();
  const ContactPoints cells(bodies, ContactVolume::kCell), boxes(bodies, ContactVolume::kFfdAabb);
  const test::FrameData data = cubes_apart(bodies, {0.5, -0.75, 0.5});
  const auto points = boxes.from(test::all_cells(bodies), data.frame());
  ASSERT_EQ(points.size(), 2u);
  for (const ContactPoint& point : points) {
    EXPECT_NEAR(point.depth, 0.25, kRounding);
    expect_near(point.normal, -Vec3::UnitY(), kRounding);
    expect_near(test::blended(point.a, data.nodes[0]), test::blended(point.b, data.nodes[1]),
                kRounding);
  }
  // The surfaces' boxes are one metre wide, the cells two.
  const test::FrameData apart = cubes_apart(bodies, {1.25, 1.25, 1.25});
  EXPECT_TRUE(boxes.from(test::all_cells(bodies), apart.frame()).empty());
  EXPECT_EQ(cells.from(test::all_cells(bodies), apart.frame()).size(), 2u);
}

TEST(CellPoints, AreOnePlaceOnBothSidesOfShearedBoxes) {
  const std::vector<Body> bodies = two_cubes();
  test::FrameData data = cubes_apart(bodies, {0.5, 0.6, 0.7});
  for (auto& nodes : data.nodes)
    for (Vec3& n : nodes) n += Vec3(0.3 * n.y() - 0.1 * n.z(), 0.2 * n.x(), 0.25 * n.y());
  const auto points =
      ContactPoints(bodies, ContactVolume::kFfdAabb).from(test::all_cells(bodies), data.frame());
  ASSERT_EQ(points.size(), 2u);
  for (const ContactPoint& point : points)
    expect_near(test::blended(point.a, data.nodes[0]), test::blended(point.b, data.nodes[1]),
                kRounding);
}

TEST(CellPoints, OfBentCellsStayWithinTheirCells) {
  const std::vector<Body> bodies = two_cubes();
  test::TriangleSource random(72);
  const ContactPoints maker(bodies, ContactVolume::kFfdAabb);
  std::size_t seen = 0;
  for (int round = 0; round < 200; ++round) {
    test::FrameData data = cubes_apart(bodies, random.point(Vec3::Zero(), 0.8));
    for (auto& nodes : data.nodes)
      for (Vec3& n : nodes) n = random.point(n, 0.5);
    for (const ContactPoint& point : maker.from(test::all_cells(bodies), data.frame())) {
      expect_convex(point.a);
      expect_convex(point.b);
      EXPECT_NEAR(point.normal.norm(), 1.0, kRounding);
      EXPECT_GE(point.depth, 0.0);
      ++seen;
    }
  }
  EXPECT_GT(seen, 200u);
}

TEST(CellPoints, OfAFlatSurfaceComeFromTheOtherBox) {
  std::vector<Body> bodies = two_cubes();
  bodies[0] =
      test::make_body("flat", test::triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), {1, 1, 1}, 0.5);
  // The flat box [0, 1]^2 at z = 0 reaches 3/8 into the cube, 1/4 above its underside.
  const test::FrameData data = cubes_apart(bodies, {0.625, 0.625, -0.25});
  const auto points =
      ContactPoints(bodies, ContactVolume::kFfdAabb).from(test::all_cells(bodies), data.frame());
  ASSERT_EQ(points.size(), 2u);  // the low and the high corner, which are one point
  for (const ContactPoint& point : points) {
    EXPECT_NEAR(point.depth, 0.25, kRounding);
    // Its own way out, up, is 74 degrees off the way between the two centres.
    expect_near(point.normal, Vec3(0.625, 0.625, 0.25).normalized(), kRounding);
    expect_near(test::blended(point.b, data.nodes[1]), {1, 1, 0}, kRounding);
  }
}

std::vector<Body> two_spheres() {
  return {test::make_body("a", test::sphere_mesh(Vec3::Zero(), 1.0, 3), {4, 4, 4}),
          test::make_body("b", test::sphere_mesh(Vec3::Zero(), 1.0, 3), {3, 5, 4})};
}

TEST(TrianglePoints, AreOnePerPairAtOnePlacePushingApart) {
  const std::vector<Body> bodies = two_spheres();
  const Vec3 offset(1.1, 1.2, 0.8);
  const test::FrameData data = cubes_apart(bodies, offset);
  ContactSet contacts = test::triangle_contacts(bodies, data.frame());
  contacts.cells.push_back({0, 1, 0, 0});  // left alone where there are triangles
  const auto points = ContactPoints(bodies, ContactVolume::kFfdAabb).from(contacts, data.frame());
  ASSERT_EQ(points.size(), contacts.triangles.size());
  ASSERT_GT(points.size(), 20u);
  for (const ContactPoint& point : points) {
    expect_convex(point.a);
    expect_convex(point.b);
    expect_near(test::blended(point.a, data.nodes[0]), test::blended(point.b, data.nodes[1]),
                kRounding);
    EXPECT_GT(point.normal.dot(offset.normalized()), 0.8);
    // The spheres overlap by 2 - |offset| = 0.186.
    EXPECT_LE(point.depth, 0.186);
  }
}

TEST(TrianglePoints, OfBareBodiesBlendTheVertices) {
  const std::vector<Body> bodies = {
      {"a", make_bare_shape(test::triangle_mesh({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}))},
      {"b", make_bare_shape(test::triangle_mesh({0, 0, -0.25}, {0, 1, 0.75}, {0, -1, 0.75}))}};
  const test::FrameData data = cubes_apart(bodies, Vec3::Zero());
  const auto points = ContactPoints(bodies, ContactVolume::kCell)
                          .from(test::triangle_contacts(bodies, data.frame()), data.frame());
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].a.nodes, (std::vector<std::uint32_t>{0, 1, 2}));
  expect_near({points[0].a.weights[0], points[0].a.weights[1], points[0].a.weights[2]},
              {0.5, 0.25, 0.25}, kRounding);
  expect_near({points[0].b.weights[0], points[0].b.weights[1], points[0].b.weights[2]},
              {0.75, 0.125, 0.125}, kRounding);
}

TEST(TrianglePoints, OfOneTriangleTwiceAreLeftOut) {
  const Body body{"a", make_bare_shape(test::triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}))};
  const std::vector<Body> bodies = {body, body};
  const test::FrameData data = cubes_apart(bodies, Vec3::Zero());
  const ContactSet contacts = test::triangle_contacts(bodies, data.frame());
  ASSERT_EQ(contacts.triangles.size(), 1u);
  EXPECT_TRUE(ContactPoints(bodies, ContactVolume::kCell).from(contacts, data.frame()).empty());
}

}  // namespace
}  // namespace contactcheck
