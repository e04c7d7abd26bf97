#include "reference/oracle/oracle.h"

#include <gmock/gmock.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include <cfenv>
#include <cmath>

#include "core/deform/ffd_aabb.h"
#include "core/types/check.h"
#include "reference/oracle/exact_tests.h"
#include "reference/oracle/hull_overlap.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr oracle::WantedTruth kEverything{true, true, true, true};

FrameData rest_frame(const std::vector<Body>& bodies) {
  std::vector<std::vector<Vec3>> nodes;
  for (const Body& body : bodies) nodes.push_back(rest_nodes_at(*body.shape, Vec3::Zero()));
  return make_frame(bodies, std::move(nodes));
}

oracle::Truth judge_at_rest(const std::vector<Body>& bodies,
                            const oracle::WantedTruth& wanted = kEverything) {
  oracle::Oracle oracle(bodies);
  const FrameData data = rest_frame(bodies);
  return oracle.judge(data.frame(), wanted);
}

TEST(Oracle, TouchingBoxesShareAFaceAndHoldNothing) {
  const oracle::Truth truth =
      judge_at_rest({test::bare_body("a", unit_box_mesh(2)),
                     test::bare_body("b", box_mesh(Vec3(1, 0, 0), Vec3(2, 1, 1), 2))});
  EXPECT_THAT(truth.surface.bodies, ElementsAre(BodyPair{0, 1}));
  EXPECT_FALSE(truth.surface.triangles.empty());
  EXPECT_THAT(truth.surface.vertices, IsEmpty());
  EXPECT_THAT(truth.surface.cells, IsEmpty());
  EXPECT_THAT(truth.containment, IsEmpty());
}

// Several triangles at one place, with corners of their own.
TriangleMesh pile(std::uint32_t count) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const Vec3& v : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) mesh.vertices.push_back(v);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

std::string refusal(const std::vector<Body>& bodies, const oracle::WantedTruth& wanted) {
  try {
    judge_at_rest(bodies, wanted);
  } catch (const RefusedInput& e) {
    return e.what();
  }
  return "";
}

TEST(Oracle, RefusesMoreContactsThanItMayList) {
  const std::vector<Body> one = {bare_body("a", pile(7))},
                          two = {bare_body("a", pile(7)), bare_body("b", pile(3))},
                          three = {bare_body("a", pile(3)), bare_body("b", pile(3)),
                                   bare_body("c", pile(2))};
  oracle::WantedTruth pairs, self;
  pairs.most_contacts = self.most_contacts = 21;
  self.triangles = false;
  self.self = true;
  EXPECT_EQ(judge_at_rest(one, self).surface.self.size(), 21u);
  EXPECT_EQ(judge_at_rest(two, pairs).surface.triangles.size(), 21u);
  EXPECT_EQ(judge_at_rest(three, pairs).surface.triangles.size(), 21u);
  const std::string sentence =
      "more than 20 pairs of triangles are in contact; at most that many can be judged";
  pairs.most_contacts = self.most_contacts = 20;
  EXPECT_EQ(refusal(one, self), sentence);
  EXPECT_EQ(refusal(two, pairs), sentence);
  EXPECT_EQ(refusal(three, pairs), sentence);
}

// A box 1 m from another one, with a vertex that no triangle uses on, in and far from the other.
TEST(Oracle, VertexThatNoTriangleUsesIsNotJudged) {
  const Body wall = bare_body("wall", box_mesh(Vec3(-3, -2, -2), Vec3(-1, 2, 2), 2));
  for (const Vec3& place : {Vec3(-1, 0, 0), Vec3(-2, 0, 0), Vec3(1e12, 0, 0)}) {
    TriangleMesh mesh = unit_box_mesh(2);
    mesh.vertices.push_back(place);
    const std::vector<Body> bodies = {wall, bare_body("box", mesh)},
                            plain = {wall, bare_body("box", unit_box_mesh(2))};
    const FrameData data = rest_frame(bodies);
    oracle::Oracle oracle(bodies), expected(plain);
    EXPECT_THAT(oracle.judge(data.frame(), kEverything).surface.vertices, IsEmpty());
    EXPECT_THAT(oracle.near(data.frame(), 0.5), IsEmpty());
    EXPECT_EQ(oracle.near(data.frame(), 1.5), expected.near(data.frame(), 1.5));
    EXPECT_EQ(oracle.separation(data.frame()).upper, expected.separation(data.frame()).upper);
    EXPECT_EQ(oracle.distance(data.frame(), {0, 1}).lower,
              expected.distance(data.frame(), {0, 1}).lower);
  }
}

TEST(Oracle, OneUlpGapIsNoContact) {
  const double next = std::nextafter(1.0, 2.0);
  const oracle::Truth truth =
      judge_at_rest({test::bare_body("a", unit_box_mesh(2)),
                     test::bare_body("b", box_mesh(Vec3(next, 0, 0), Vec3(2, 1, 1), 2))});
  EXPECT_THAT(truth.surface.bodies, IsEmpty());
  EXPECT_THAT(truth.surface.triangles, IsEmpty());
}

TEST(Oracle, HeldBodyIsContainmentAndAllItsVerticesAreInside) {
  const Body inner = test::bare_body("inner", box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1));
  const Body outer = test::bare_body("outer", box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 3));
  const oracle::Truth truth = judge_at_rest({inner, outer});
  EXPECT_THAT(truth.surface.bodies, IsEmpty());
  EXPECT_THAT(truth.containment, ElementsAre(BodyPair{0, 1}));
  ASSERT_EQ(truth.surface.vertices.size(), 8u);
  for (std::uint32_t v = 0; v < 8; ++v)
    EXPECT_EQ(truth.surface.vertices[v], (VertexInBody{0, 1, v}));
}

// It was asked that all lie inside: a part beside the solid hid one in it.
TEST(Oracle, OneComponentInsideIsContainment) {
  const TriangleMesh one = box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1);
  const Body outer = test::bare_body("outer", box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 3));
  const TriangleMesh in = box_mesh(Vec3(3, 3, 3), Vec3(3.5, 3.5, 3.5), 1);
  const TriangleMesh out = box_mesh(Vec3(5, 3, 3), Vec3(6, 4, 4), 1);
  for (const TriangleMesh& parts : {joined(one, in), joined(one, out), joined(out, one)})
    for (const oracle::Truth& truth : {judge_at_rest({outer, test::bare_body("parts", parts)}),
                                       judge_at_rest({test::bare_body("parts", parts), outer})}) {
      EXPECT_THAT(truth.containment, ElementsAre(BodyPair{0, 1}));
      EXPECT_THAT(truth.surface.bodies, IsEmpty());
    }
  EXPECT_THAT(judge_at_rest({outer, test::bare_body("out", out)}).containment, IsEmpty());
  // Each has a part in the other, and one beside it.
  const Body a = test::bare_body("a", joined(box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 1),
                                             box_mesh(Vec3(8, 1, 1), Vec3(9, 2, 2), 1)));
  const Body b = test::bare_body("b", joined(box_mesh(Vec3(7, 0, 0), Vec3(11, 4, 4), 1),
                                             box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1)));
  EXPECT_THAT(judge_at_rest({a, b}).containment, ElementsAre(BodyPair{0, 1}));
}

TEST(Oracle, WallBetweenShellsHoldsAndTheirCavityDoesNot) {
  const Body shell =
      test::bare_body("shell", joined(box_mesh(Vec3(0, 0, 0), Vec3(9, 9, 9), 1),
                                      reversed(box_mesh(Vec3(3, 3, 3), Vec3(6, 6, 6), 1))));
  const TriangleMesh in_wall = box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1);
  const TriangleMesh in_cavity = box_mesh(Vec3(4, 4, 4), Vec3(5, 5, 5), 1);
  const TriangleMesh around_cavity = box_mesh(Vec3(2, 2, 2), Vec3(7, 7, 7), 1);
  const auto contained = [&](const TriangleMesh& mesh) {
    return !judge_at_rest({shell, test::bare_body("other", mesh)}).containment.empty();
  };
  EXPECT_TRUE(contained(in_wall));
  EXPECT_FALSE(contained(in_cavity));
  EXPECT_TRUE(contained(joined(in_cavity, in_wall)));
  EXPECT_TRUE(contained(around_cavity));
  // A cloth of two sides has no interior: it contains nothing.
  const TriangleMesh sheet = triangle_mesh(Vec3(-9, -9, 4), Vec3(90, -9, 4), Vec3(-9, 90, 4));
  const Body cloth = test::bare_body("cloth", joined(sheet, reversed(sheet)));
  const Body small = test::bare_body("small", in_wall);
  EXPECT_THAT(judge_at_rest({cloth, small}).open, IsEmpty());
  EXPECT_THAT(judge_at_rest({cloth, small}).containment, IsEmpty());
}

TEST(Oracle, ContainmentWhereItIsKnownWhoTouches) {
  const std::vector<Body> bodies = {
      test::bare_body("outer", box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 1)),
      test::bare_body("inner", box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1)),
      test::bare_body("patch", triangle_mesh(Vec3(3, 3, 3), Vec3(3, 3, 5), Vec3(3, 5, 3)))};
  oracle::Oracle oracle(bodies);
  const FrameData data = rest_frame(bodies);
  const oracle::Containment found = oracle.containment(data.frame(), {{0, 2}});
  EXPECT_THAT(found.pairs, ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(found.open, ElementsAre(oracle::OpenBody{2, {0, 0, 1}}));
  EXPECT_THAT(oracle.containment(data.frame(), {{0, 1}, {0, 2}}).pairs, IsEmpty());
}

// A seam of doubled vertices is open in the frames in which it comes apart.
TEST(Oracle, BodyIsOpenInTheFramesInWhichItsSeamIs) {
  TriangleMesh lid = box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 1);
  const Triangle torn = lid.triangles.back();
  for (std::uint32_t& v : lid.triangles.back()) {
    lid.vertices.push_back(Vec3(lid.vertices[v]));
    v = static_cast<std::uint32_t>(lid.vertices.size() - 1);
  }
  const std::vector<Body> bodies = {
      test::bare_body("seam", lid),
      test::bare_body("in", box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1))};
  oracle::Oracle oracle(bodies);
  FrameData data = rest_frame(bodies);
  for (const bool apart : {false, true, false}) {
    data.vertices[0][8] = lid.vertices[torn[0]] + Vec3(apart ? 0x1p-40 : 0.0, 0, 0);
    const oracle::Truth truth = oracle.judge(data.frame(), kEverything);
    EXPECT_EQ(truth.open.empty(), !apart);
    EXPECT_EQ(truth.containment.size(), apart ? 0u : 1u);
    EXPECT_EQ(truth.surface.vertices.size(), apart ? 0u : 8u);
  }
}

// Welding tells neighbours, and nothing else: every vertex stays one.
TEST(Oracle, VerticesOfAWeldedBodyAreInsideEachOnItsOwn) {
  TriangleMesh corners;
  for (const Triangle& t : box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1).triangles) {
    const auto first = static_cast<std::uint32_t>(corners.vertices.size());
    for (const std::uint32_t v : t)
      corners.vertices.push_back(box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1).vertices[v]);
    corners.triangles.push_back({first, first + 1, first + 2});
  }
  const Body outer = test::bare_body("outer", box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 1));
  const oracle::Truth truth = judge_at_rest({outer, {"welded", welded(*make_bare_shape(corners))}});
  EXPECT_EQ(truth.surface.vertices.size(), 36u);
  EXPECT_THAT(truth.containment, ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(truth.open, IsEmpty());
}

TEST(Oracle, VerticesWithoutTrianglesAreNotInside) {
  TriangleMesh stray = box_mesh(Vec3(7, 7, 7), Vec3(8, 8, 8), 1);
  stray.vertices.emplace_back(1, 1, 1);
  stray.vertices.emplace_back(9, 9, 9);
  const oracle::Truth truth =
      judge_at_rest({test::bare_body("box", box_mesh(Vec3(0, 0, 0), Vec3(7.5, 7.5, 7.5), 1)),
                     test::bare_body("stray", stray)});
  EXPECT_THAT(truth.surface.vertices, testing::Not(testing::Contains(VertexInBody{1, 0, 8})));
  EXPECT_FALSE(truth.surface.vertices.empty());
}

TEST(Oracle, ContactRulesContainmentOut) {
  const oracle::Truth truth = judge_at_rest(
      {test::bare_body("outer", unit_box_mesh(2)),
       test::bare_body("inner", box_mesh(Vec3(0, 0.2, 0.2), Vec3(0.5, 0.7, 0.7), 1))});
  EXPECT_THAT(truth.surface.bodies, ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(truth.containment, IsEmpty());
  EXPECT_EQ(truth.surface.vertices.size(), 4u);  // the other four lie on the outer's face
  // Half out, with its components' first vertex inside.
  const Body half = test::bare_body("half", box_mesh(Vec3(0.5, 0.2, 0.2), Vec3(1.5, 0.7, 0.7), 1));
  const oracle::Truth crossing = judge_at_rest({test::bare_body("outer", unit_box_mesh(2)), half});
  EXPECT_THAT(crossing.surface.bodies, ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(crossing.containment, IsEmpty());
  EXPECT_THAT(crossing.surface.vertices, testing::Contains(VertexInBody{1, 0, 0}));
}

TEST(Oracle, BodyInACavityIsNotHeld) {
  const Body shell =
      test::bare_body("shell", joined(box_mesh(Vec3(0, 0, 0), Vec3(5, 5, 5), 2),
                                      reversed(box_mesh(Vec3(1, 1, 1), Vec3(4, 4, 4), 2))));
  const oracle::Truth truth =
      judge_at_rest({shell, test::bare_body("b", box_mesh(Vec3(2, 2, 2), Vec3(3, 3, 3), 1))});
  EXPECT_THAT(truth.containment, IsEmpty());
  EXPECT_THAT(truth.surface.vertices, IsEmpty());
}

TEST(Oracle, OpenBodiesHoldNothingButCanBeHeld) {
  TriangleMesh open = box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 2);
  open.triangles.pop_back();
  const Body inner = test::bare_body("inner", box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1));
  const oracle::Truth in_open = judge_at_rest({test::bare_body("open", open), inner});
  EXPECT_THAT(in_open.containment, IsEmpty());
  EXPECT_THAT(in_open.surface.vertices, IsEmpty());
  const Body patch =
      test::bare_body("patch", triangle_mesh(Vec3(1, 1, 1), Vec3(2, 1, 1), Vec3(1, 2, 1)));
  const oracle::Truth held =
      judge_at_rest({patch, test::bare_body("box", box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 2))});
  EXPECT_THAT(held.containment, ElementsAre(BodyPair{0, 1}));
  EXPECT_EQ(held.surface.vertices.size(), 3u);
}

TEST(Oracle, WhatIsNotWantedIsNotThere) {
  const std::vector<Body> bodies{
      make_body("a", unit_box_mesh(3), {2, 2, 2}),
      make_body("b", box_mesh(Vec3(0.5, 0.5, 0.5), Vec3(2, 2, 2), 3), {2, 2, 2})};
  const oracle::Truth none = judge_at_rest(bodies, {false, false, false, false});
  EXPECT_THAT(none.surface.bodies, IsEmpty());
  EXPECT_THAT(none.surface.triangles, IsEmpty());
  EXPECT_THAT(none.surface.vertices, IsEmpty());
  EXPECT_THAT(none.boxes, IsEmpty());
  const oracle::Truth all = judge_at_rest(bodies);
  EXPECT_THAT(judge_at_rest(bodies, {false, true, false, false}).surface.triangles, IsEmpty());
  EXPECT_EQ(judge_at_rest(bodies, {true, false, false, false}).surface.triangles,
            all.surface.triangles);
  EXPECT_EQ(judge_at_rest(bodies, {false, false, true, false}).surface.vertices,
            all.surface.vertices);
  EXPECT_EQ(judge_at_rest(bodies, {false, false, false, true}).boxes, all.boxes);
  EXPECT_FALSE(all.boxes.empty());
  EXPECT_FALSE(all.surface.vertices.empty());
}

// Three bodies of two shapes, turned at random, all truth against brute force.
class OracleAgainstBruteForce : public testing::Test {
 protected:
  OracleAgainstBruteForce() {
    bodies_ = {
        make_body("box", box_mesh(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5), 3), {3, 3, 3}),
        make_body("ball", sphere_mesh(Vec3::Zero(), 0.6, 2), {3, 2, 3})};
    bodies_.push_back({"again", bodies_[0].shape});
  }

  FrameData random_frame(TriangleSource& source) const {
    std::vector<std::vector<Vec3>> nodes;
    for (const Body& body : bodies_) {
      std::vector<Vec3> rest = rest_nodes_at(*body.shape, Vec3::Zero());
      for (Vec3& p : rest) p = source.point(p, 0.05);
      nodes.push_back(moved(rest, random_rotation(source), source.point(Vec3::Zero(), 0.45)));
    }
    return make_frame(bodies_, std::move(nodes));
  }

  oracle::TriangleCorners corners(const FrameData& data, std::uint32_t body,
                                  std::uint32_t t) const {
    const Triangle& v = bodies_[body].shape->mesh.triangles[t];
    const auto& p = data.vertices[body];
    return {p[v[0]], p[v[1]], p[v[2]]};
  }

  std::vector<ElementPair> triangles(const FrameData& data) const {
    std::vector<ElementPair> out;
    for (std::uint32_t a = 0; a < 3; ++a)
      for (std::uint32_t b = a + 1; b < 3; ++b)
        for (std::uint32_t i = 0; i < bodies_[a].shape->mesh.triangles.size(); ++i)
          for (std::uint32_t j = 0; j < bodies_[b].shape->mesh.triangles.size(); ++j)
            if (oracle::triangles_intersect(corners(data, a, i), corners(data, b, j)))
              out.push_back({a, b, i, j});
    return out;
  }

  // Solid angles sum to 4 pi times the winding number; in double, which is far from 2 pi here.
  bool inside(const FrameData& data, std::uint32_t body, const Vec3& p) const {
    double angle = 0;
    for (std::uint32_t t = 0; t < bodies_[body].shape->mesh.triangles.size(); ++t) {
      const auto c = corners(data, body, t);
      const Vec3 a = (c[0] - p).normalized(), b = (c[1] - p).normalized(),
                 d = (c[2] - p).normalized();
      angle += 2 * std::atan2(a.dot(b.cross(d)), 1 + a.dot(b) + b.dot(d) + d.dot(a));
    }
    return std::abs(angle) > 2 * 3.14159265358979;
  }

  std::vector<VertexInBody> vertices(const FrameData& data) const {
    std::vector<VertexInBody> out;
    for (std::uint32_t a = 0; a < 3; ++a)
      for (std::uint32_t b = 0; b < 3; ++b)
        for (std::uint32_t v = 0; a != b && v < data.vertices[a].size(); ++v)
          if (inside(data, b, data.vertices[a][v])) out.push_back({a, b, v});
    return out;
  }

  std::vector<ElementPair> boxes(const FrameData& data) const {
    std::vector<std::vector<oracle::ConvexHull>> hulls;
    for (std::uint32_t a = 0; a < 3; ++a) {
      const BodyShape& shape = *bodies_[a].shape;
      const auto local = ffd_aabbs(shape.mesh, *shape.lattice, shape.embedding);
      hulls.emplace_back();
      for (std::uint32_t c = 0; c < local.size(); ++c)
        hulls[a].push_back(
            oracle::make_hull(mapped_box(*shape.lattice, c, local[c], data.nodes[a])));
    }
    std::vector<ElementPair> out;
    for (std::uint32_t a = 0; a < 3; ++a)
      for (std::uint32_t b = a + 1; b < 3; ++b)
        for (std::uint32_t i = 0; i < hulls[a].size(); ++i)
          for (std::uint32_t j = 0; j < hulls[b].size(); ++j)
            if (oracle::hulls_overlap(hulls[a][i], hulls[b][j])) out.push_back({a, b, i, j});
    return out;
  }

  std::vector<Body> bodies_;
};

TEST_F(OracleAgainstBruteForce, TrianglesVerticesAndBoxes) {
  oracle::Oracle oracle(bodies_);
  TriangleSource source(701);
  std::size_t triangles_found = 0, vertices_found = 0, boxes_found = 0;
  for (int i = 0; i < 8; ++i) {
    const FrameData data = random_frame(source);
    const oracle::Truth truth = oracle.judge(data.frame(), kEverything);
    EXPECT_EQ(truth.surface.triangles, triangles(data));
    EXPECT_EQ(truth.surface.vertices, vertices(data));
    EXPECT_EQ(truth.boxes, boxes(data));
    triangles_found += truth.surface.triangles.size();
    vertices_found += truth.surface.vertices.size();
    boxes_found += truth.boxes.size();
  }
  EXPECT_GT(triangles_found, 500u);
  EXPECT_GT(vertices_found, 100u);
  EXPECT_GT(boxes_found, 500u);
}

TEST_F(OracleAgainstBruteForce, DistanceIsZeroExactlyForBodiesInContact) {
  oracle::Oracle oracle(bodies_);
  TriangleSource source(702);
  int contacts = 0, apart = 0;
  for (int i = 0; i < 8; ++i) {
    const FrameData data = random_frame(source);
    const oracle::Truth truth = oracle.judge(data.frame(), {});
    for (const BodyPair& pair : {BodyPair{0, 1}, BodyPair{2, 1}, BodyPair{0, 2}}) {
      const BodyPair sorted{std::min(pair.a, pair.b), std::max(pair.a, pair.b)};
      const auto& bodies = truth.surface.bodies;
      const bool contact = std::find(bodies.begin(), bodies.end(), sorted) != bodies.end();
      const oracle::DistanceInterval d = oracle.distance(data.frame(), pair);
      EXPECT_EQ(d.upper == 0, contact);
      EXPECT_LE(d.lower, d.upper);
      contact ? ++contacts : ++apart;
    }
  }
  EXPECT_GT(contacts, 5);
  EXPECT_EQ(contacts + apart, 24);
}

TEST_F(OracleAgainstBruteForce, OrderOfBodiesDoesNotMatter) {
  TriangleSource source(703);
  const FrameData data = random_frame(source);
  const oracle::Truth truth = oracle::Oracle(bodies_).judge(data.frame(), kEverything);
  const std::uint32_t to[3] = {2, 0, 1};  // body i becomes body to[i]
  std::vector<Body> bodies(3);
  FrameData turned{std::vector<std::vector<Vec3>>(3), std::vector<std::vector<Vec3>>(3)};
  for (std::uint32_t i = 0; i < 3; ++i) {
    bodies[to[i]] = bodies_[i];
    turned.nodes[to[i]] = data.nodes[i];
    turned.vertices[to[i]] = data.vertices[i];
  }
  ContactSet expected = truth.surface;
  expected.cells = truth.boxes;  // canonicalize() orients and sorts them too
  for (auto* pairs : {&expected.triangles, &expected.cells})
    for (ElementPair& p : *pairs) p = {to[p.body_a], to[p.body_b], p.a, p.b};
  for (VertexInBody& v : expected.vertices) v = {to[v.body], to[v.in], v.vertex};
  expected.bodies.clear();
  expected.canonicalize();
  const oracle::Truth swapped = oracle::Oracle(bodies).judge(turned.frame(), kEverything);
  EXPECT_EQ(swapped.surface.triangles, expected.triangles);
  EXPECT_EQ(swapped.surface.vertices, expected.vertices);
  EXPECT_EQ(swapped.boxes, expected.cells);
}

// Powers of two that keep every bit, and two that reach where products underflow.
TEST(Oracle, PowersOfTwoGiveIdenticalSets) {
  const TriangleMesh torus = torus_mesh(1.0, 0.4, 16, 8);
  const TriangleMesh sphere = sphere_mesh(Vec3(1, 0.1, 0.2), 0.5, 2);
  oracle::Truth expected;
  for (int exponent : {0, -40, 30, 200, -530, -1000}) {
    std::vector<Body> bodies;
    for (TriangleMesh mesh : {torus, sphere}) {
      mesh.vertices = scaled(mesh.vertices, std::ldexp(1.0, exponent));
      bodies.push_back(test::bare_body("scaled", mesh));
    }
    oracle::Truth truth = judge_at_rest(bodies);
    if (exponent == 0) expected = truth;
    EXPECT_EQ(truth.surface.triangles, expected.surface.triangles) << exponent;
    EXPECT_EQ(truth.surface.vertices, expected.surface.vertices) << exponent;
  }
  EXPECT_GT(expected.surface.triangles.size(), 50u);
  EXPECT_GT(expected.surface.vertices.size(), 10u);
}

// Coordinates that are multiples of the smallest subnormal number.
TEST(Oracle, SubnormalCoordinates) {
  for (double scale : {1e-160, 1e-300, 0x1p-1074}) {
    TriangleMesh a = box_mesh(Vec3(0, 0, 0), Vec3(8, 8, 8), 2);
    TriangleMesh b = box_mesh(Vec3(2, 2, 2), Vec3(6, 6, 6), 2);
    TriangleMesh c = box_mesh(Vec3(9, 0, 0), Vec3(17, 8, 8), 2);
    for (TriangleMesh* mesh : {&a, &b, &c}) mesh->vertices = scaled(mesh->vertices, scale);
    const oracle::Truth truth =
        judge_at_rest({test::bare_body("a", a), test::bare_body("b", b), test::bare_body("c", c)});
    EXPECT_THAT(truth.surface.bodies, IsEmpty()) << scale;
    EXPECT_THAT(truth.containment, ElementsAre(BodyPair{0, 1})) << scale;
    EXPECT_EQ(truth.surface.vertices.size(), b.vertices.size()) << scale;
  }
}

TEST(Oracle, FlattenedLatticeStillHasBoxes) {
  const std::vector<Body> bodies{make_body("a", unit_box_mesh(3), {2, 2, 2}),
                                 make_body("b", unit_box_mesh(3), {2, 2, 2})};
  std::vector<std::vector<Vec3>> nodes;
  for (const Body& body : bodies) nodes.push_back(rest_nodes_at(*body.shape, Vec3::Zero()));
  for (Vec3& p : nodes[0]) p.z() = 0.5;
  for (Vec3& p : nodes[1]) p.x() = p.y() = 0.25;
  const FrameData data = make_frame(bodies, std::move(nodes));
  const oracle::Truth truth = oracle::Oracle(bodies).judge(data.frame(), kEverything);
  EXPECT_THAT(truth.surface.bodies, ElementsAre(BodyPair{0, 1}));
  EXPECT_FALSE(truth.boxes.empty());
  EXPECT_THAT(truth.surface.vertices, IsEmpty());
}

class FloatingPointEnvironment : public testing::Test {
 protected:
  ~FloatingPointEnvironment() override { std::fesetenv(FE_DFL_ENV); }

  // Two bodies in contact and one apart.
  std::vector<Body> bodies_{test::bare_body("a", torus_mesh(1.0, 0.4, 12, 8)),
                            test::bare_body("b", sphere_mesh(Vec3(1, 0.1, 0.2), 0.5, 2)),
                            test::bare_body("c", sphere_mesh(Vec3(0.3, 0.1, 2.2), 0.5, 2))};
};

TEST_F(FloatingPointEnvironment, RoundingModeIsAsBeforeAndDoesNotChangeTheTruth) {
  const FrameData data = rest_frame(bodies_);
  oracle::Oracle oracle(bodies_);
  const oracle::Truth expected = oracle.judge(data.frame(), kEverything);
  const oracle::DistanceInterval distance = oracle.distance(data.frame(), {0, 2});
  for (int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const oracle::Truth truth = oracle.judge(data.frame(), kEverything);
    EXPECT_EQ(std::fegetround(), mode);
    const oracle::DistanceInterval again = oracle.distance(data.frame(), {0, 2});
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(truth.surface.triangles, expected.surface.triangles);
    EXPECT_EQ(truth.surface.vertices, expected.surface.vertices);
    EXPECT_EQ(again.lower, distance.lower);
    EXPECT_EQ(again.upper, distance.upper);
  }
}

#ifdef __SSE2__
// As some libraries leave it behind: subnormal numbers read as 0 and results flushed to 0.
TEST_F(FloatingPointEnvironment, FlushToZeroIsAsBeforeAndDoesNotChangeTheTruth) {
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  for (Body& body : bodies_) {
    TriangleMesh mesh = body.shape->mesh;
    mesh.vertices = scaled(mesh.vertices, 1e-312);
    body = test::bare_body(body.name, mesh);
  }
  const FrameData data = rest_frame(bodies_);
  oracle::Oracle oracle(bodies_);
  const oracle::Truth expected = oracle.judge(data.frame(), kEverything);
  ASSERT_THAT(expected.surface.bodies, ElementsAre(BodyPair{0, 1}));
  const unsigned changed = _mm_getcsr() | kFlushToZero | kDenormalsAreZero;
  _mm_setcsr(changed);
  const oracle::Truth truth = oracle.judge(data.frame(), kEverything);
  const unsigned after = _mm_getcsr();
  std::fesetenv(FE_DFL_ENV);
  EXPECT_EQ(after & (kFlushToZero | kDenormalsAreZero), kFlushToZero | kDenormalsAreZero);
  EXPECT_EQ(truth.surface.triangles, expected.surface.triangles);
  EXPECT_EQ(truth.surface.vertices, expected.surface.vertices);
}
#endif

TEST(OracleDeathTest, FrameWithoutVerticesIsRefused) {
  const std::vector<Body> bodies{test::bare_body("a", unit_box_mesh(1)),
                                 test::bare_body("b", unit_box_mesh(1))};
  FrameData data = rest_frame(bodies);
  Frame frame = data.frame();
  frame.bodies[1].vertices = {};
  EXPECT_DEATH(oracle::Oracle(bodies).judge(frame, {}), "every deformed vertex");
}

}  // namespace
}  // namespace contactcheck::test
