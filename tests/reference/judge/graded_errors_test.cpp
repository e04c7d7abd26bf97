#include "reference/judge/graded_errors.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/reference/judge/labelled_bodies.h"
#include "tests/support/shapes.h"

namespace contactcheck::judge {
namespace {

using test::FrameData;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::Optional;

constexpr double kClose = 1e-9;

// A large triangle in the plane z = 0 and one that hangs through it, 0.125 deep, 0.25 wide there.
std::vector<Body> crossing() {
  return {{"floor", make_bare_shape(test::triangle_mesh({-8, -8, 0}, {8, -8, 0}, {0, 8, 0}))},
          {"spike",
           make_bare_shape(test::triangle_mesh({0, 0, -0.125}, {1, 0, 0.875}, {-1, 0, 0.875}))}};
}

struct Graded {
  explicit Graded(std::vector<Body> of, Semantics semantics = {})
      : bodies(std::move(of)), geometry(bodies), errors(bodies, semantics, 1.0) {
    std::vector<std::vector<Vec3>> nodes;
    for (const Body& body : bodies) nodes.push_back(test::rest_nodes_at(*body.shape, Vec3::Zero()));
    data = test::make_frame(bodies, std::move(nodes));
    geometry.set_frame(data.frame());
  }
  results::Geometry of(const oracle::Truth& truth, const std::vector<double>& contour,
                       ContactSet answer) {
    answer.canonicalize();
    covered = errors.add_frame(truth, contour, answer, geometry);
    return errors.summary();
  }

  std::vector<Body> bodies;
  FrameData data;
  oracle::SurfaceGeometry geometry;
  GradedErrors errors;
  std::optional<double> covered;  ///< of the last frame
};

Semantics of_triangles() {
  Semantics s;
  s.levels = {Level::kTriangle};
  s.depth = DepthKind::kConvexPair;
  return s;
}

ContactSet contact(double depth, const Vec3& normal) {
  ContactSet answer;
  answer.triangles = {{0, 1, 0, 0}};
  answer.piece_contacts = {{{0, 1, 0, 0}, depth, normal}};
  return answer;
}

MATCHER_P2(IsBin, from, below, "holds one error") {
  return arg.from == from && arg.below == below && arg.count == 1;
}

TEST(SpreadOf, IsMaxMeanAndNearestRank) {
  std::vector<double> errors;
  EXPECT_EQ(spread_of(errors).judged, 0u);
  EXPECT_EQ(spread_of(errors).max, std::nullopt);
  for (int i = 100; i > 0; --i) errors.push_back(i);
  const results::ErrorSpread spread = spread_of(errors);
  EXPECT_EQ(spread.judged, 100u);
  EXPECT_THAT(spread.max, Optional(100.0));
  EXPECT_THAT(spread.mean, Optional(50.5));
  EXPECT_THAT(spread.p95, Optional(95.0));
  std::vector<double> one = {7.0};
  EXPECT_THAT(spread_of(one).p95, Optional(7.0));
}

TEST(GradedErrors, MissedPairsWeighTheirLength) {
  Graded graded(test::labelled_bodies(), of_triangles());
  const oracle::Truth truth = test::truth_of({{0, 1, 0, 0}, {0, 1, 1, 1}});
  ContactSet answer;
  answer.triangles = {{0, 1, 0, 0}};
  EXPECT_THAT(graded.of(truth, {3.0, 1.0}, answer).missed_length, Optional(1.0));
  EXPECT_THAT(graded.covered, Optional(0.75));
  const results::Geometry both = graded.of(truth, {2.0, 2.0}, ContactSet{});
  EXPECT_THAT(both.missed_length, Optional(5.0));
  EXPECT_THAT(both.covered_length_fraction, Optional(3.0 / 8.0));
  EXPECT_THAT(graded.covered, Optional(0.0));
}

TEST(GradedErrors, FrameWithoutContourHasNoShare) {
  Graded graded(test::labelled_bodies(), of_triangles());
  const results::Geometry errors = graded.of(oracle::Truth{}, {}, ContactSet{});
  EXPECT_THAT(errors.missed_length, Optional(0.0));
  EXPECT_EQ(errors.covered_length_fraction, std::nullopt);
  EXPECT_EQ(graded.covered, std::nullopt);
}

TEST(GradedErrors, CellsCoverTheContourOfTheirTriangles) {
  Semantics cells;
  cells.levels = {Level::kCell};
  Graded graded(test::labelled_bodies(), cells);
  ContactSet answer;
  answer.cells = {{0, 1, 0, 0}};  // holds triangles 0 and 1 of both bodies
  const results::Geometry errors =
      graded.of(test::truth_of({{0, 1, 0, 1}, {0, 1, 2, 2}}), {1.0, 3.0}, answer);
  EXPECT_THAT(errors.missed_length, Optional(3.0));
  EXPECT_EQ(errors.spurious_distance_max, std::nullopt);
}

TEST(GradedErrors, DetectorOfBodiesAloneHasNoContour) {
  Semantics bodies;
  bodies.levels = {Level::kBody};
  Graded graded(test::labelled_bodies(), bodies);
  const results::Geometry errors = graded.of(test::truth_of({{0, 1, 0, 0}}), {1.0}, ContactSet{});
  EXPECT_EQ(errors.missed_length, std::nullopt);
  EXPECT_EQ(errors.depth.judged, 0u);
}

TEST(GradedErrors, SpuriousPairWeighsItsDistance) {
  Graded graded(
      {{"low", make_bare_shape(test::triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}))},
       {"high", make_bare_shape(test::triangle_mesh({0, 0, 0.25}, {1, 0, 0.25}, {0, 1, 0.5}))}},
      of_triangles());
  ContactSet answer;
  answer.triangles = {{0, 1, 0, 0}};
  EXPECT_THAT(graded.of(oracle::Truth{}, {}, answer).spurious_distance_max,
              Optional(DoubleNear(0.25, kClose)));
}

TEST(GradedErrors, DepthAndNormalOfPiecesAreComparedWithTheShortestSeparatingTranslation) {
  Graded graded(crossing(), of_triangles());
  const results::Geometry good =
      graded.of(test::truth_of({{0, 1, 0, 0}}), {0.25}, contact(0.125, Vec3::UnitZ()));
  EXPECT_EQ(good.depth.judged, 1u);
  EXPECT_THAT(good.depth.max, Optional(DoubleNear(0.0, kClose)));
  EXPECT_THAT(good.normal_deg.max, Optional(DoubleNear(0.0, 1e-6)));
  const results::Geometry bad =
      graded.of(test::truth_of({{0, 1, 0, 0}}), {0.25}, contact(0.5, Vec3(0, 1, 1).normalized()));
  EXPECT_EQ(bad.depth.judged, 2u);
  EXPECT_THAT(bad.depth.max, Optional(DoubleNear(0.375, kClose)));
  EXPECT_THAT(bad.normal_deg.max, Optional(DoubleNear(45.0, 1e-6)));
}

TEST(GradedErrors, EveryErrorCountsInItsHistogram) {
  Graded graded(crossing(), of_triangles());
  graded.of(test::truth_of({{0, 1, 0, 0}}), {0.25}, contact(0.5, Vec3(0, 1, 2).normalized()));
  // The second frame's truth is empty: there the pair, whose triangles cross, is spurious, too.
  const results::Geometry errors = graded.of(oracle::Truth{}, {}, contact(0.25, Vec3::UnitZ()));
  EXPECT_THAT(errors.depth.histogram, ElementsAre(IsBin(0.1, 0.2), IsBin(0.2, 0.5)));
  EXPECT_THAT(errors.normal_deg.histogram, ElementsAre(IsBin(0.0, 5.0), IsBin(25.0, 30.0)));
  EXPECT_THAT(errors.spurious_distance_histogram, ElementsAre(IsBin(0.0, 1e-12)));
}

TEST(GradedErrors, OfSeveralContactsOfAPairTheDeepestCounts) {
  Graded graded(crossing(), of_triangles());
  ContactSet answer = contact(0.03125, Vec3::UnitX());
  answer.piece_contacts.push_back({{0, 1, 0, 0}, 0.125, Vec3::UnitZ()});
  // The same contact told by the other body: its normal turns with the pair.
  answer.piece_contacts.push_back({{1, 0, 0, 0}, 0.0625, Vec3::UnitX()});
  const results::Geometry errors = graded.of(test::truth_of({{0, 1, 0, 0}}), {0.25}, answer);
  EXPECT_EQ(errors.depth.judged, 1u);
  EXPECT_THAT(errors.depth.max, Optional(DoubleNear(0.0, kClose)));
  EXPECT_THAT(errors.normal_deg.max, Optional(DoubleNear(0.0, 1e-6)));
}

TEST(GradedErrors, ContactOfDisjointPiecesHasNoDepthToJudge) {
  std::vector<Body> apart = crossing();
  apart[1].shape =
      make_bare_shape(test::triangle_mesh({0, 0, 0.125}, {1, 0, 0.875}, {-1, 0, 0.875}));
  Graded graded(std::move(apart), of_triangles());
  EXPECT_EQ(graded.of(oracle::Truth{}, {}, contact(0.5, Vec3::UnitZ())).depth.judged, 0u);
}

TEST(GradedErrors, TouchingPiecesHaveADepthButNoDirection) {
  std::vector<Body> touching = crossing();
  touching[1].shape = make_bare_shape(test::triangle_mesh({0, 0, 0}, {1, 0, 1}, {-1, 0, 1}));
  Graded graded(std::move(touching), of_triangles());
  const results::Geometry errors =
      graded.of(test::truth_of({{0, 1, 0, 0}}), {0.0}, contact(0.0, Vec3::UnitX()));
  EXPECT_EQ(errors.depth.judged, 1u);
  EXPECT_EQ(errors.normal_deg.judged, 0u);
}

TEST(GradedErrors, VertexDepthIsItsDistanceToTheSurfaceAndTheShallowestContactCounts) {
  Semantics semantics;
  semantics.levels = {Level::kNear};
  semantics.depth = DepthKind::kVertexSurface;
  const Vec3 deep(0.25, 0.5, 0.5);
  Graded graded({{"point", make_bare_shape(test::triangle_mesh(deep, {9, 0, 0}, {9, 1, 0}))},
                 {"box", make_bare_shape(test::unit_box_mesh(2))}},
                semantics);
  oracle::Truth truth;
  truth.surface.vertices = {{0, 1, 0}};
  ContactSet answer;
  answer.vertex_contacts = {{{0, 1, 0}, 0.5, Vec3::UnitY()},
                            {{0, 1, 0}, 0.375, -Vec3::UnitX()},
                            {{0, 1, 1}, 3.0, Vec3::UnitX()}};  // vertex 1 is not inside
  const results::Geometry errors = graded.of(truth, {}, answer);
  EXPECT_EQ(errors.depth.judged, 1u);
  EXPECT_THAT(errors.depth.max, Optional(DoubleNear(0.125, kClose)));
  EXPECT_THAT(errors.normal_deg.max, Optional(DoubleNear(0.0, 1e-6)));
}

TEST(GradedErrors, NormalIsComparedWithTheNearestOfAllWaysOut) {
  Semantics semantics;
  semantics.depth = DepthKind::kVertexSurface;
  Graded graded(
      {{"point", make_bare_shape(test::triangle_mesh(Vec3::Constant(0.25), {9, 0, 0}, {9, 1, 0}))},
       {"box", make_bare_shape(test::unit_box_mesh(2))}},
      semantics);
  oracle::Truth truth;
  truth.surface.vertices = {{0, 1, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    ContactSet answer;
    answer.vertex_contacts = {{{0, 1, 0}, 0.25, -Vec3::Unit(axis)}};
    EXPECT_THAT(graded.of(truth, {}, answer).normal_deg.max, Optional(DoubleNear(0.0, 1e-6)));
  }
}

}  // namespace
}  // namespace contactcheck::judge
