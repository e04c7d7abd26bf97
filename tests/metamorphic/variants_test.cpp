// That variants are what they say: the same surfaces, moved without a rounding where that is said.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "core/narrow/triangle_triangle.h"
#include "tests/metamorphic/movement.h"
#include "tests/metamorphic/renaming.h"

namespace contactcheck {
namespace {

using test::Carrier;
using test::FrameData;
using test::make_frame;
using test::Rest;
using test::rest_nodes_at;
using test::Subject;
using test::Variant;
using ::testing::ElementsAre;

// A ball in a lattice and a box without one; two moments.
std::shared_ptr<const Subject> ball_and_box() {
  Subject out;
  out.bodies = {test::make_body("ball", test::sphere_mesh(Vec3::Zero(), 1.0, 1), {3, 3, 3}),
                {"box", make_bare_shape(test::unit_box_mesh(2))}};
  for (const double x : {0.3, 1.7}) {
    std::vector<std::vector<Vec3>> nodes;
    for (const Body& body : out.bodies)
      nodes.push_back(rest_nodes_at(*body.shape, Vec3(x, 0.1, 0)));
    for (Vec3& n : nodes[0]) n.y() += 0.3 * n.x() * n.z();
    out.frames.push_back(make_frame(out.bodies, std::move(nodes)));
    out.labels.push_back("ball and box at " + std::to_string(x));
  }
  return std::make_shared<const Subject>(std::move(out));
}

TrianglePoints corners(const std::vector<Body>& bodies, const FrameData& frame, std::uint32_t body,
                       std::uint32_t triangle) {
  const Triangle& t = bodies[body].shape->mesh.triangles[triangle];
  const std::vector<Vec3>& v = frame.vertices[body];
  return {v[t[0]], v[t[1]], v[t[2]]};
}

// How corners of a triangle of the variant stand among those of its namesake.
std::vector<std::ptrdiff_t> order_of(const TrianglePoints& in, const TrianglePoints& of) {
  std::vector<std::ptrdiff_t> out;
  for (const Vec3& p : of) out.push_back(std::find(in.begin(), in.end(), p) - in.begin());
  return out;
}

std::set<std::vector<std::ptrdiff_t>> orders(const Subject& plain, const Variant& variant) {
  std::set<std::vector<std::ptrdiff_t>> out;
  for (std::uint32_t b = 0; b < variant.bodies.size(); ++b)
    for (std::uint32_t t = 0; t < variant.names.triangle[b].size(); ++t)
      out.insert(order_of(corners(plain.bodies, plain.frames[1], variant.names.body[b],
                                  variant.names.triangle[b][t]),
                          corners(variant.bodies, *variant.frames[1], b, t)));
  return out;
}

bool is_identity(const std::vector<std::uint32_t>& ids) { return std::ranges::is_sorted(ids); }

TEST(Renaming, ReversesBodies) {
  const auto plain = ball_and_box();
  const Variant out = renamed(plain, {.reverse_bodies = true});
  EXPECT_THAT(out.names.body, ElementsAre(1, 0));
  EXPECT_EQ(out.bodies[0].name, "box");
  EXPECT_THAT(orders(*plain, out), ElementsAre(ElementsAre(0, 1, 2)));
}

TEST(Renaming, FlipsEveryTriangle) {
  const auto plain = ball_and_box();
  const Variant out = renamed(plain, {.flip_winding = true});
  EXPECT_THAT(orders(*plain, out), ElementsAre(ElementsAre(0, 2, 1)));
  EXPECT_TRUE(is_identity(out.names.triangle[0]) && is_identity(out.names.vertex[0]));
}

TEST(Renaming, TurnsEveryTriangleOneWayOrTheOther) {
  const auto plain = ball_and_box();
  const Variant out = renamed(plain, {.turn_corners = true});
  EXPECT_THAT(orders(*plain, out), ElementsAre(ElementsAre(1, 2, 0), ElementsAre(2, 0, 1)));
}

TEST(Renaming, ShufflesTrianglesAndVerticesApart) {
  const auto plain = ball_and_box();
  for (const bool triangles : {true, false}) {
    const Variant out =
        renamed(plain, {.shuffle_triangles = triangles, .shuffle_vertices = !triangles});
    for (const auto& ids : out.names.triangle) EXPECT_EQ(is_identity(ids), !triangles);
    for (const auto& ids : out.names.vertex) EXPECT_EQ(is_identity(ids), triangles);
    EXPECT_THAT(orders(*plain, out), ElementsAre(ElementsAre(0, 1, 2)));
  }
}

TEST(Renaming, ReadsEveryKindOfIdBack) {
  const Variant out = renamed(ball_and_box(), {true, true, true, true, true});
  const auto& [body, triangle, vertex] = out.names;
  ContactSet set;
  set.triangles = {{0, 1, 3, 5}};
  set.vertices = {{0, 1, 4}};
  set.near = {{1, 0, 6, 2}};
  set.cells = {{0, 1, 7, 8}};
  const ContactSet read = test::in_names_of_subject(set, out.names);
  EXPECT_THAT(read.triangles, ElementsAre(ElementPair{0, 1, triangle[1][5], triangle[0][3]}));
  EXPECT_THAT(read.vertices, ElementsAre(VertexInBody{1, 0, vertex[0][4]}));
  EXPECT_THAT(read.near, ElementsAre(NearPair{0, 1, vertex[1][6], triangle[0][2]}));
  EXPECT_THAT(read.cells, ElementsAre(ElementPair{0, 1, 8, 7}));
  EXPECT_THAT(read.bodies, ElementsAre(BodyPair{0, 1}));
}

TEST(Scaling, IsExactOrLeftOut) {
  const auto plain = ball_and_box();
  for (const Rest rest : {Rest::kStays, Rest::kMoves}) {
    const Variant out = scaled(plain, -40, rest);
    for (std::size_t f = 0; f < 2; ++f)
      for (std::size_t b = 0; b < 2; ++b)
        for (std::size_t v = 0; v < plain->frames[f].vertices[b].size(); ++v)
          EXPECT_EQ(out.frames[f]->vertices[b][v], plain->frames[f].vertices[b][v] * 0x1p-40);
    const double side = bounding_box(out.bodies[1].shape->mesh.vertices).extent().x();
    EXPECT_EQ(side, rest == Rest::kMoves ? 0x1p-40 : 1.0);
  }
  for (const int too_far : {-1060, 1024})
    for (const auto& frame : scaled(plain, too_far, Rest::kStays).frames) EXPECT_FALSE(frame);
}

TEST(Scaling, ReachesBothEndsOfTheRange) {
  const auto plain = ball_and_box();
  for (const auto& frame : scaled_to_the_largest(plain).frames) {
    double largest = 0.0;
    for (const auto& body : frame->nodes)
      for (const Vec3& p : body) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    EXPECT_TRUE(std::isfinite(largest) && largest >= 0x1p1023);
  }
  for (const auto& frame : scaled_to_the_smallest(plain).frames)
    EXPECT_LT(frame->vertices[0][0].norm(), 0x1p-900);
  // What is not mapped goes down to the last digit.
  Subject bare;
  bare.bodies = {
      {"triangle", make_bare_shape(test::triangle_mesh({3, 1, 0}, {1, 0, 0}, {0, 2, 0}))}};
  bare.frames = {make_frame(bare.bodies, {bare.bodies[0].shape->mesh.vertices})};
  const Variant out = scaled_to_the_smallest(std::make_shared<const Subject>(std::move(bare)));
  EXPECT_EQ(out.frames[0]->vertices[0][0], Vec3(3, 1, 0) * 0x1p-1074);
}

// The way of every coordinate is the shift, whichever way it is computed: nothing was rounded.
TEST(Translation, IsExactOnRoundedVertices) {
  const auto subject = ball_and_box();
  for (const Carrier carrier : {Carrier::kNodes, Carrier::kBare})
    for (const int exponent : {0, 20, 44}) {
      const Variant out = translated(subject, exponent, carrier);
      EXPECT_EQ(out.bodies[1].shape->lattice.has_value(), carrier == Carrier::kNodes);
      for (std::size_t f = 0; f < 2; ++f) {
        std::set<std::array<double, 3>> ways;
        for (std::size_t b = 0; b < 2; ++b)
          for (std::size_t v = 0; v < out.plain->frames[f].vertices[b].size(); ++v) {
            const Vec3 &from = out.plain->frames[f].vertices[b][v],
                       &to = out.frames[f]->vertices[b][v];
            const Vec3 way = to - from;
            ways.insert({way.x(), way.y(), way.z()});
            EXPECT_EQ(from, to - way);
            EXPECT_LE((from - subject->frames[f].vertices[b][v]).cwiseAbs().maxCoeff(),
                      std::ldexp(1.0, exponent - 48));
          }
        EXPECT_EQ(ways.size(), 1u) << exponent;
        EXPECT_GE(std::abs((*ways.begin())[0]), std::ldexp(1.0, exponent));
      }
    }
}

double volume(const FrameData& frame) {
  const std::vector<Vec3>& v = frame.vertices[0];
  return (v[1] - v[0]).cross(v[2] - v[0]).dot(v[4] - v[0]);
}

TEST(TurningToOtherAxes, KeepsEveryCoordinateButForItsPlaceAndSign) {
  const auto plain = ball_and_box();
  const auto sizes = [](const Vec3& p) {
    std::array<double, 3> out = {std::abs(p.x()), std::abs(p.y()), std::abs(p.z())};
    std::ranges::sort(out);
    return out;
  };
  for (const bool mirrored : {false, true}) {
    const Variant out = turned_to_other_axes(plain, mirrored);
    for (std::size_t f = 0; f < 2; ++f) {
      const auto &from = plain->frames[f].vertices[0], &to = out.frames[f]->vertices[0];
      EXPECT_NE(from, to);
      for (std::size_t v = 0; v < from.size(); ++v) EXPECT_EQ(sizes(from[v]), sizes(to[v]));
      const double ratio = volume(*out.frames[f]) / volume(plain->frames[f]);
      EXPECT_NEAR(ratio, mirrored ? -1.0 : 1.0, 1e-9);
    }
  }
}

TEST(TurningToOtherAxes, GoesThroughAllTurns) {
  Subject many;
  many.bodies = {{"point", make_bare_shape(test::triangle_mesh({1, 2, 3}, {4, 5, 6}, {7, 8, 8}))}};
  for (int i = 0; i < 400; ++i) {
    many.frames.push_back(make_frame(many.bodies, {many.bodies[0].shape->mesh.vertices}));
    many.labels.push_back("frame " + std::to_string(i));
  }
  const auto subject = std::make_shared<const Subject>(std::move(many));
  for (const bool mirrored : {false, true}) {
    std::set<std::array<double, 3>> images;
    for (const auto& frame : turned_to_other_axes(subject, mirrored).frames) {
      const Vec3& p = frame->vertices[0][0];
      images.insert({p.x(), p.y(), p.z()});
    }
    EXPECT_EQ(images.size(), mirrored ? 24u : 23u);
    EXPECT_EQ(images.count({1, 2, 3}), 0u);
  }
}

TEST(MovingWithRounding, KeepsDistancesAndLeavesNoAxis) {
  const auto plain = ball_and_box();
  const Variant out = moved_with_rounding(plain);
  for (std::size_t f = 0; f < 2; ++f) {
    const auto &from = plain->frames[f].vertices[1], &to = out.frames[f]->vertices[1];
    EXPECT_EQ(out.plain->frames[f].vertices, out.frames[f]->vertices);
    for (std::size_t v = 1; v < from.size(); ++v) {
      EXPECT_NEAR((to[v] - to[0]).norm(), (from[v] - from[0]).norm(), 1e-12);
      EXPECT_GT((to[v] - to[0]).cwiseAbs().minCoeff(), 1e-3);
    }
  }
}

}  // namespace
}  // namespace contactcheck
