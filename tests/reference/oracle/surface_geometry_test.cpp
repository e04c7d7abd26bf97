#include "reference/oracle/surface_geometry.h"

#include <gmock/gmock.h>

#include <cfenv>
#include <cmath>

#include "core/deform/ffd_aabb.h"
#include "reference/oracle/exact_tests.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/shapes.h"
#include "tests/support/wide.h"

namespace contactcheck::test {
namespace {

using Corners3 = oracle::TriangleCorners;

MATCHER_P(IsDirection, direction, "") { return (arg - Vec3(direction)).norm() < 1e-12; }

// Bare bodies in one frame, with the geometry set to it.
struct Scene {
  explicit Scene(std::vector<Body> b) : Scene(b, meshes_of(b)) {}
  Scene(std::vector<Body> b, const std::vector<std::vector<Vec3>>& nodes)
      : bodies(std::move(b)), data(make_frame(bodies, nodes)), geometry(bodies) {
    geometry.set_frame(data.frame());
  }

  static std::vector<std::vector<Vec3>> meshes_of(const std::vector<Body>& bodies) {
    std::vector<std::vector<Vec3>> out;
    for (const Body& body : bodies) out.push_back(rest_nodes_at(*body.shape, Vec3::Zero()));
    return out;
  }
  Corners3 corners(std::uint32_t body, std::uint32_t triangle) const {
    const Triangle& t = bodies[body].shape->mesh.triangles[triangle];
    const std::vector<Vec3>& v = data.vertices[body];
    return {v[t[0]], v[t[1]], v[t[2]]};
  }

  std::vector<Body> bodies;
  FrameData data;
  oracle::SurfaceGeometry geometry;
};

// ---- vertex to surface

// A body of points: the vertices of one degenerate triangle and more.
Body points(std::vector<Vec3> at) {
  TriangleMesh mesh{std::move(at), {}};
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) mesh.triangles.push_back({v, v, v});
  return test::bare_body("points", mesh);
}

oracle::Penetration way_from(const Vec3& vertex, TriangleMesh mesh) {
  Scene scene({points({vertex}), test::bare_body("surface", std::move(mesh))});
  return scene.geometry.vertex_to_surface({0, 1, 0});
}

TEST(VertexToSurface, NearestFacesOfABoxAreAllTold) {
  const TriangleMesh box = box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 2);
  const oracle::Penetration one = way_from(Vec3(1, 1.5, 2), box);
  EXPECT_DOUBLE_EQ(one.depth, 1.0);
  EXPECT_THAT(one.directions, testing::ElementsAre(IsDirection(Vec3(-1, 0, 0))));
  const oracle::Penetration two = way_from(Vec3(1, 2, 3), box);
  EXPECT_DOUBLE_EQ(two.depth, 1.0);
  EXPECT_THAT(two.directions, testing::UnorderedElementsAre(IsDirection(Vec3(-1, 0, 0)),
                                                            IsDirection(Vec3(0, 0, 1))));
  EXPECT_EQ(way_from(Vec3(2, 2, 2), box).directions.size(), 6u);
}

TEST(VertexToSurface, WithinABillionthOfTheSizeIsAsNear) {
  const TriangleMesh box = box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 2);
  EXPECT_EQ(way_from(Vec3(1, 1 + 3e-9, 2), box).directions.size(), 2u);  // of 4e-9
  EXPECT_EQ(way_from(Vec3(1, 1 + 6e-9, 2), box).directions.size(), 1u);
}

TEST(VertexToSurface, OutsideTheNearestIsAnEdgeOrACorner) {
  const TriangleMesh box = box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 2);
  const oracle::Penetration edge = way_from(Vec3(-3, -4, 1.5), box);
  EXPECT_DOUBLE_EQ(edge.depth, 5.0);
  EXPECT_THAT(edge.directions, testing::ElementsAre(IsDirection(Vec3(0.6, 0.8, 0))));
  EXPECT_DOUBLE_EQ(way_from(Vec3(-1, -2, -2), box).depth, 3.0);
}

TEST(VertexToSurface, OnTheSurfaceIsZeroWithoutDirections) {
  const TriangleMesh box = box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 2);
  for (const Vec3& on : {Vec3(0, 1, 1.5), Vec3(0, 0, 3), Vec3(4, 4, 4)}) {
    const oracle::Penetration way = way_from(on, box);
    EXPECT_EQ(way.depth, 0.0);
    EXPECT_TRUE(way.directions.empty());
  }
  const oracle::Penetration off = way_from(Vec3(0x1p-70, 1, 1.5), box);
  EXPECT_EQ(off.depth, 0x1p-70);
  EXPECT_THAT(off.directions, testing::ElementsAre(IsDirection(Vec3(-1, 0, 0))));
}

// Coordinates in units so small or large that squares underflow or overflow.
TEST(VertexToSurface, EveryScaleOfDoubles) {
  for (double scale : {0x1p-1060, 0x1p-600, 0x1p+600, 0x1p+1021}) {
    TriangleMesh box = box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 1);
    box.vertices = scaled(box.vertices, scale);
    const oracle::Penetration way = way_from(Vec3(1, 1.5, 2) * scale, box);
    EXPECT_EQ(way.depth, scale);
    EXPECT_THAT(way.directions, testing::ElementsAre(IsDirection(Vec3(-1, 0, 0)))) << scale;
  }
}

using WideVec = std::array<Wide, 3>;

WideVec wide(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
WideVec operator-(const WideVec& a, const WideVec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Wide dot(const WideVec& a, const WideVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Wide squared_to_edge(const WideVec& p, const WideVec& a, const WideVec& b) {
  const WideVec d = b - a, w = p - a;
  const Wide along = dot(d, w), length2 = dot(d, d);
  if (length2 == 0 || along <= 0) return dot(w, w);
  if (along >= length2) return dot(p - b, p - b);
  return dot(w, w) - along * along / length2;
}

// With 113 bits: 1e-16 right after the square root.
Wide squared_to_triangle(const WideVec& p, const Corners3& t) {
  const WideVec a = wide(t[0]), b = wide(t[1]), c = wide(t[2]), u = b - a, v = c - a, w = p - a;
  Wide best = squared_to_edge(p, a, b);
  best = std::min(best, squared_to_edge(p, b, c));
  best = std::min(best, squared_to_edge(p, c, a));
  const Wide uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), det = uu * vv - uv * uv;
  if (!(det > 0)) return best;
  const Wide s = (dot(w, u) * vv - dot(w, v) * uv) / det,
             r = (dot(w, v) * uu - dot(w, u) * uv) / det;
  if (s < 0 || r < 0 || s + r > 1) return best;
  return std::min(best, dot(w, w) - s * dot(w, u) - r * dot(w, v));
}

double brute_force_distance(const Scene& scene, const WideVec& p) {
  Wide best = 1e30;
  for (std::uint32_t t = 0; t < scene.bodies[1].shape->mesh.triangles.size(); ++t)
    best = std::min(best, squared_to_triangle(p, scene.corners(1, t)));
  return std::sqrt(std::max(0.0, static_cast<double>(best)));
}

// A crumpled torus with slivers and zero-area triangles.
TriangleMesh crumpled_torus(TriangleSource& source) {
  TriangleMesh mesh = torus_mesh(1.0, 0.4, 16, 10);
  for (Vec3& v : mesh.vertices) v = source.point(v, 0.08);
  for (std::size_t v = 0; v + 3 < mesh.vertices.size(); v += 20) {
    mesh.vertices[v + 1] = mesh.vertices[v];
    mesh.vertices[v + 3] = mesh.vertices[v + 2] + Vec3(1e-9, 0, 0);
  }
  return mesh;
}

class VertexToSurfaceAgainstBruteForce : public testing::Test {
 protected:
  // `count` random vertices round the torus, all moved by `offset`.
  void compare(int count, const Vec3& offset) {
    TriangleSource source(1101);
    TriangleMesh mesh = crumpled_torus(source);
    std::vector<Vec3> at;
    for (int i = 0; i < count; ++i) at.push_back(source.point(Vec3::Zero(), 1.5) + offset);
    mesh.vertices = moved(mesh.vertices, Eigen::Matrix3d::Identity(), offset);
    Scene scene({points(at), test::bare_body("torus", mesh)});
    for (std::uint32_t v = 0; v < at.size(); ++v) check(scene, v);
  }

  void check(Scene& scene, std::uint32_t vertex) {
    const Vec3& p = scene.data.vertices[0][vertex];
    const oracle::Penetration way = scene.geometry.vertex_to_surface({0, 1, vertex});
    EXPECT_NEAR(way.depth, brute_force_distance(scene, wide(p)), 3e-12) << hex_points({&p, 1});
    ASSERT_FALSE(way.directions.empty());
    if (vertex % 4 != 0) return;  // slow
    for (const Vec3& d : way.directions) {
      EXPECT_NEAR(d.norm(), 1.0, 1e-14);
      WideVec end = wide(p);
      for (int k = 0; k < 3; ++k) end[k] += Wide(way.depth) * d[k];
      EXPECT_LT(brute_force_distance(scene, end), 3.1e-9 + 1e-12) << hex_points({&p, 1});
    }
  }
};

TEST_F(VertexToSurfaceAgainstBruteForce, OverAllTrianglesOn1000RandomVertices) {
  compare(1000, Vec3::Zero());
}

TEST_F(VertexToSurfaceAgainstBruteForce, FarFromTheOrigin) { compare(100, Vec3(1e5, -3e4, 2e5)); }

// Vertices a hair off the surface, where the direction from point to point is mostly rounding.
TEST(VertexToSurface, TinyDepthsAreRightToo) {
  TriangleSource source(1102);
  const TriangleMesh ball = sphere_mesh(Vec3::Zero(), 1.0, 2);
  std::vector<Vec3> at;
  for (int i = 0; i < 100; ++i) {
    const Triangle& t = ball.triangles[static_cast<std::size_t>(source.below(128))];
    const Vec3 &a = ball.vertices[t[0]], &b = ball.vertices[t[1]], &c = ball.vertices[t[2]];
    const double s = 0.5 + 0.5 * source.unit(), r = (1 - s) * (0.5 + 0.5 * source.unit());
    at.push_back((a + s * (b - a) + r * (c - a)) * (1 - std::ldexp(1.0, -20 - source.below(30))));
  }
  Scene scene({points(at), test::bare_body("ball", ball)});
  for (std::uint32_t v = 0; v < at.size(); ++v)
    EXPECT_NEAR(scene.geometry.vertex_to_surface({0, 1, v}).depth,
                brute_force_distance(scene, wide(at[v])), 2e-12);
}

// ---- pairs of triangles

class TwoTriangles {
 public:
  TwoTriangles(const Corners3& a, const Corners3& b)
      : scene_({test::bare_body("a", triangle_mesh(a[0], a[1], a[2])),
                test::bare_body("b", triangle_mesh(b[0], b[1], b[2]))}) {}
  double distance() const { return scene_.geometry.triangle_distance({0, 1, 0, 0}); }
  double length() const { return scene_.geometry.intersection_length({0, 1, 0, 0}); }
  std::optional<oracle::Penetration> way() const {
    return scene_.geometry.triangle_penetration({0, 1, 0, 0});
  }

 private:
  Scene scene_;
};

const Corners3 kFloor{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

TEST(TrianglePairs, DistanceIsTheUpperEndOfANarrowInterval) {
  TriangleSource source(1103);
  int apart = 0;
  for (int i = 0; i < 200; ++i) {
    const Corners3 p = source.triangle(Vec3::Zero(), 1);
    Corners3 q = source.triangle(Vec3(1, 0, 0), 1);
    if (i % 2) q = source.near_degenerate_partner(p, 1);
    const mpq_class squared = oracle::rational::squared_distance(p, q);
    const double distance = TwoTriangles(p, q).distance();
    EXPECT_EQ(distance == 0, squared == 0);
    EXPECT_GE(mpq_class(distance) * mpq_class(distance), squared);
    EXPECT_LE(distance, std::sqrt(squared.get_d()) * (1 + 1.1e-9) + 1e-150);
    apart += squared > 0;
  }
  EXPECT_GT(apart, 60);
}

TEST(TrianglePairs, TouchingAndSmallestGap) {
  Corners3 above = kFloor;
  EXPECT_EQ(TwoTriangles(kFloor, above).distance(), 0.0);
  for (Vec3& c : above) c.z() = 0x1p-1074;
  EXPECT_GT(TwoTriangles(kFloor, above).distance(), 0.0);
  EXPECT_LT(TwoTriangles(kFloor, above).distance(), 1e-150);
}

TEST(TrianglePairs, LengthAndWayOfACrossing) {
  const TwoTriangles pair(kFloor, {Vec3(1, 1, -0.5), Vec3(1, 1, 1.5), Vec3(1, 2, 1.5)});
  EXPECT_DOUBLE_EQ(pair.length(), 0.25);
  ASSERT_TRUE(pair.way());
  EXPECT_DOUBLE_EQ(pair.way()->depth, 0.5);
  EXPECT_THAT(pair.way()->directions, testing::ElementsAre(IsDirection(Vec3(0, 0, 1))));
}

TEST(TrianglePairs, PieceBMovesWhicheverBodyItIsOf) {
  Scene scene(
      {test::bare_body("a", triangle_mesh(kFloor[0], kFloor[1], kFloor[2])),
       test::bare_body("b", triangle_mesh(Vec3(1, 1, -0.5), Vec3(1, 1, 1.5), Vec3(1, 2, 1.5)))});
  const auto up = scene.geometry.triangle_penetration({0, 1, 0, 0});
  const auto down = scene.geometry.triangle_penetration({1, 0, 0, 0});
  ASSERT_TRUE(up && down);
  EXPECT_THAT(up->directions, testing::ElementsAre(IsDirection(Vec3(0, 0, 1))));
  EXPECT_THAT(down->directions, testing::ElementsAre(IsDirection(Vec3(0, 0, -1))));
}

TEST(TrianglePairs, DisjointOnesHaveNoWayOut) {
  Corners3 above = kFloor;
  EXPECT_TRUE(TwoTriangles(kFloor, above).way());
  for (Vec3& c : above) c.z() = 0x1p-1074;
  EXPECT_FALSE(TwoTriangles(kFloor, above).way());
  EXPECT_EQ(TwoTriangles(kFloor, above).length(), 0.0);
}

TEST(TrianglePairs, WaysAtEveryScaleOfDoubles) {
  for (double scale : {0x1p-1060, 0x1p-600, 0x1p+600, 0x1p+1020}) {
    const auto times = [&](const Corners3& t) {
      return Corners3{t[0] * scale, t[1] * scale, t[2] * scale};
    };
    const TwoTriangles pair(times(kFloor),
                            times({Vec3(1.5, 1, -1), Vec3(1.5, 1, 3), Vec3(1.5, 2, 3)}));
    ASSERT_TRUE(pair.way());
    EXPECT_EQ(pair.way()->depth, scale);
    EXPECT_THAT(pair.way()->directions, testing::ElementsAre(IsDirection(Vec3(0, 0, 1))));
  }
}

// ---- mapped boxes

// Two bodies of one cell whose box is the cube [0, 1]^3 of the mesh, wherever the nodes go.
Scene two_cubes(const Eigen::Matrix3d& turn, const Vec3& offset_b) {
  const Body a = make_body("a", unit_box_mesh(1), {1, 1, 1});
  const std::vector<Vec3> rest = rest_nodes_at(*a.shape, Vec3::Zero());
  std::vector<Vec3> moved_b = moved(rest, Eigen::Matrix3d::Identity(), offset_b);
  return Scene({a, {"b", a.shape}},
               {moved(rest, turn, Vec3::Zero()), moved(moved_b, turn, Vec3::Zero())});
}

TEST(PartBoxes, CubesOverlappingByATenthPartAlongTheAxis) {
  Scene scene = two_cubes(Eigen::Matrix3d::Identity(), Vec3(0.9, 0.3, -0.2));
  const auto way = scene.geometry.box_penetration({0, 1, 0, 0});
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->depth, 0.1, 1e-15);
  EXPECT_THAT(way->directions, testing::ElementsAre(IsDirection(Vec3(1, 0, 0))));
  const auto back = scene.geometry.box_penetration({1, 0, 0, 0});
  EXPECT_THAT(back->directions, testing::ElementsAre(IsDirection(Vec3(-1, 0, 0))));
}

TEST(PartBoxes, EqualOverlapsGiveTwoWaysOut) {
  Scene scene = two_cubes(Eigen::Matrix3d::Identity(), Vec3(0.9, -0.9, 0.2));
  const auto way = scene.geometry.box_penetration({0, 1, 0, 0});
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->depth, 0.1, 1e-15);
  EXPECT_THAT(way->directions, testing::UnorderedElementsAre(IsDirection(Vec3(1, 0, 0)),
                                                             IsDirection(Vec3(0, -1, 0))));
}

TEST(PartBoxes, TurnedTogetherTheWayTurnsToo) {
  TriangleSource source(1104);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d turn = random_rotation(source);
    Scene scene = two_cubes(turn, Vec3(0.2, 0.3, -0.75));
    const auto way = scene.geometry.box_penetration({0, 1, 0, 0});
    ASSERT_TRUE(way);
    EXPECT_NEAR(way->depth, 0.25, 1e-14);
    ASSERT_EQ(way->directions.size(), 1u);
    EXPECT_LT((way->directions[0] + turn.col(2)).norm(), 1e-14);
  }
}

TEST(PartBoxes, DisjointOnesHaveNoWayOutAndTouchingOnesAnEmptyOne) {
  Scene apart = two_cubes(Eigen::Matrix3d::Identity(), Vec3(1.5, 0, 0));
  EXPECT_FALSE(apart.geometry.box_penetration({0, 1, 0, 0}));
  // Mapping rounds, so that these two touch or overlap by an ulp.
  Scene touching = two_cubes(Eigen::Matrix3d::Identity(), Vec3(0, 1 - 0x1p-50, 0));
  const auto way = touching.geometry.box_penetration({0, 1, 0, 0});
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->depth, 0.0, 2e-15);
}

// The boxes are those that the level `box` judges.
TEST(PartBoxes, OverlapExactlyWhereTheOracleSaysSo) {
  const Body a = make_body("a", sphere_mesh(Vec3::Zero(), 0.6, 2), {3, 2, 3});
  const std::vector<Body> bodies{a, {"b", a.shape}};
  TriangleSource source(1105);
  std::size_t separated = 0;
  oracle::Oracle oracle(bodies);
  oracle::SurfaceGeometry geometry(bodies);
  for (int frame = 0; frame < 3; ++frame) {
    std::vector<std::vector<Vec3>> nodes;
    for (int b = 0; b < 2; ++b) {
      nodes.push_back(moved(rest_nodes_at(*a.shape, Vec3::Zero()), random_rotation(source),
                            source.point(Vec3::Zero(), 0.4)));
      for (Vec3& n : nodes.back()) n = source.point(n, 0.05);
    }
    const FrameData data = make_frame(bodies, nodes);
    const oracle::Truth truth = oracle.judge(data.frame(), {false, false, false, true});
    geometry.set_frame(data.frame());
    const auto cells = static_cast<std::uint32_t>(a.shape->lattice->cells.size());
    std::vector<ElementPair> overlapping;
    for (std::uint32_t i = 0; i < cells; ++i)
      for (std::uint32_t j = 0; j < cells; ++j)
        if (geometry.box_penetration({0, 1, i, j})) overlapping.push_back({0, 1, i, j});
    EXPECT_EQ(overlapping, truth.boxes);
    separated += overlapping.size();
  }
  EXPECT_GT(separated, 20u);
}

// ---- frames

TEST(SurfaceGeometryFrames, EveryAnswerIsAboutTheFrameSet) {
  const std::vector<Body> bodies{make_body("a", unit_box_mesh(2), {1, 1, 1}),
                                 make_body("b", unit_box_mesh(2), {1, 1, 1})};
  oracle::SurfaceGeometry geometry(bodies);
  for (double offset : {0.9, 0.6, 0.9}) {
    const FrameData data =
        make_frame(bodies, {rest_nodes_at(*bodies[0].shape, Vec3::Zero()),
                            rest_nodes_at(*bodies[1].shape, Vec3(offset, 0.25, 0.25))});
    geometry.set_frame(data.frame());
    EXPECT_NEAR(geometry.box_penetration({0, 1, 0, 0})->depth, 1 - offset, 1e-14);
    const auto& vertices = data.vertices[1];
    const auto lowest =
        std::min_element(vertices.begin(), vertices.end(), [](const Vec3& x, const Vec3& y) {
          return (x - Vec3(0, 0.75, 0.75)).squaredNorm() < (y - Vec3(0, 0.75, 0.75)).squaredNorm();
        });
    const auto v = static_cast<std::uint32_t>(lowest - vertices.begin());
    EXPECT_NEAR(geometry.vertex_to_surface({1, 0, v}).depth,
                std::min(1 - offset, 1 - std::max(lowest->y(), lowest->z())), 1e-14);
  }
}

TEST(SurfaceGeometryFrames, RoundingModeDoesNotChangeTheAnswers) {
  TriangleSource source(1106);
  Scene scene({test::bare_body("torus", crumpled_torus(source)),
               test::bare_body("ball", sphere_mesh(Vec3(1, 0, 0), 0.5, 1))});
  const oracle::Truth truth = oracle::Oracle(scene.bodies).judge(scene.data.frame(), {});
  ASSERT_GT(truth.surface.triangles.size(), 20u);
  const auto sum = [&] {
    double out = 0;
    for (const ElementPair& pair : truth.surface.triangles) {
      out += scene.geometry.intersection_length(pair);
      out += scene.geometry.triangle_penetration(pair)->depth;
      out += scene.geometry.triangle_distance({0, 1, pair.a, (pair.b + 9) % 32});
    }
    for (std::uint32_t v = 0; v < 18; ++v) out += scene.geometry.vertex_to_surface({1, 0, v}).depth;
    return out;
  };
  const double expected = sum();
  for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::vector<double> parts;
    const ElementPair pair = truth.surface.triangles[3];
    std::fesetround(mode);
    scene.geometry.set_frame(scene.data.frame());
    const double depth = scene.geometry.triangle_penetration(pair)->depth;
    const double length = scene.geometry.intersection_length(pair);
    const double way = scene.geometry.vertex_to_surface({1, 0, 3}).depth;
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(depth, scene.geometry.triangle_penetration(pair)->depth);
    EXPECT_EQ(length, scene.geometry.intersection_length(pair));
    EXPECT_EQ(way, scene.geometry.vertex_to_surface({1, 0, 3}).depth);
    EXPECT_EQ(sum(), expected);
  }
}

TEST(SurfaceGeometryDeathTest, WhatIsNotThereIsRefused) {
  Scene scene({points({Vec3::Zero()}), test::bare_body("b", unit_box_mesh(1))});
  EXPECT_DEATH(scene.geometry.vertex_to_surface({0, 2, 0}), "a body of the scene");
  EXPECT_DEATH(scene.geometry.vertex_to_surface({0, 1, 1}), "a vertex of the body");
  EXPECT_DEATH(scene.geometry.intersection_length({0, 1, 0, 12}), "a triangle of the body");
  EXPECT_DEATH(scene.geometry.box_penetration({0, 1, 0, 0}), "a kept cell");
}

}  // namespace
}  // namespace contactcheck::test
