// Depths and normals of the node-against-plane members: the question `contacts`.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/deform/ffd_aabb.h"
#include "core/narrow/node_plane.h"
#include "tests/core/detect/scenes.h"
#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using test::answer;
using test::FrameData;
using test::prepared;
using test::Scene;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

std::array<Vec3, 8> corners_of_box(const Vec3& lo, const Vec3& hi) {
  std::array<Vec3, 8> corners;
  for (int c = 0; c < 8; ++c)
    corners[c] = {(c & 1) ? hi.x() : lo.x(), (c & 2) ? hi.y() : lo.y(), (c & 4) ? hi.z() : lo.z()};
  return corners;
}

TEST(NodeDepth, IsTheDistanceToTheNearestPlaneAndItsNormal) {
  const BoxPlanes box = planes_of_box(corners_of_box({-2, -1, -3}, {2, 1, 3}));
  for (const auto& [node, depth, normal] : {std::tuple(Vec3(1.75, 0, 0), 0.25, Vec3(1, 0, 0)),
                                            std::tuple(Vec3(-1.875, 0.5, 1), 0.125, Vec3(-1, 0, 0)),
                                            std::tuple(Vec3(0, 0.25, 0), 0.75, Vec3(0, 1, 0)),
                                            std::tuple(Vec3(0, -0.25, -2.5), 0.5, Vec3(0, 0, -1)),
                                            std::tuple(Vec3(2, 0.5, 0.5), 0.0, Vec3(1, 0, 0))}) {
    const NodeDepth got = node_depth(box, node);
    EXPECT_EQ(got.depth, depth);
    EXPECT_EQ(got.outward, normal);
  }
}

TEST(NodeDepth, IsInMetresForLargeTinyAndTurnedBoxes) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 2).normalized()).matrix();
  for (double size : {1.0, 1e-90, 1e-155, 1e90, 1e150}) {
    auto corners = corners_of_box(Vec3::Constant(-size), Vec3::Constant(size));
    for (Vec3& c : corners) c = turn * c;
    const NodeDepth got = node_depth(planes_of_box(corners), turn * Vec3(0, 0.75 * size, 0));
    EXPECT_NEAR(got.depth / size, 0.25, 1e-12) << size;
    EXPECT_LT((got.outward - turn.col(1)).norm(), 1e-12) << size;
  }
}

TEST(NodeDepth, LeavesFacesWithoutAreaOut) {
  const BoxPlanes flat = planes_of_box(corners_of_box({0.5, 0, 0}, {0.5, 1, 1}));
  const NodeDepth on_it = node_depth(flat, {0.5, 0.25, 0.25});
  EXPECT_EQ(on_it.depth, 0.0);
  EXPECT_EQ(on_it.outward.cwiseAbs(), Vec3(1, 0, 0));
  const BoxPlanes point = planes_of_box(corners_of_box(Vec3::Ones(), Vec3::Ones()));
  EXPECT_EQ(node_depth(point, Vec3::Ones()).outward, Vec3(Vec3::Zero()));
}

/// Two cubes of side 1 in one cell each, exactly so; the second at `offset`.
Scene two_cubes(const Vec3& offset, bool swapped) {
  Scene scene;
  const Body cube = test::make_body("", test::unit_box_mesh(1), {1, 1, 1}, 0.0);
  scene.bodies = {cube, cube};
  const Vec3 at(40, 40, 40);  // away from lines of the hash grid
  scene.frames = {test::make_frame(scene.bodies,
                                   {test::rest_nodes_at(*cube.shape, swapped ? at + offset : at),
                                    test::rest_nodes_at(*cube.shape, swapped ? at : at + offset)})};
  return scene;
}

TEST(NodePlaneContacts, OfTwoBoxesHaveTheOverlapsDepthAndAxisInBothOrders) {
  for (int axis = 0; axis < 3; ++axis) {
    for (bool swapped : {false, true}) {
      Vec3 offset = Vec3::Constant(0.5), expected = Vec3::Zero();
      offset[axis] = 0.875;
      expected[axis] = swapped ? -1.0 : 1.0;
      const Scene scene = two_cubes(offset, swapped);
      const auto detector = prepared("ffd-aabb:cell=100", scene);
      const ContactSet got = answer(*detector, scene.frames[0], Question::kContacts);
      // A corner of each cube lies inside the other.
      ASSERT_THAT(got.piece_contacts, SizeIs(2));
      for (const PieceContact& c : got.piece_contacts) {
        EXPECT_EQ(c.pieces, (ElementPair{0, 1, 0, 0}));
        EXPECT_EQ(c.depth, 0.125);
        EXPECT_EQ(c.normal, expected);
      }
    }
  }
}

TEST(NodePlaneContacts, OfCoincidingBoxesLieOnTheirPlanes) {
  const Scene scene = two_cubes(Vec3::Zero(), false);
  const auto got =
      answer(*prepared("ffd-aabb:cell=100", scene), scene.frames[0], Question::kContacts);
  EXPECT_THAT(got.piece_contacts, SizeIs(16));  // every corner of both
  for (const PieceContact& c : got.piece_contacts) {
    EXPECT_EQ(c.depth, 0.0);
    EXPECT_EQ(c.normal.norm(), 1.0);
  }
}

TEST(NodePlaneContacts, MovingTheSecondPieceByThemPartsAlignedBoxes) {
  const Vec3 offset(0.75, -0.5, 0.625);
  const Scene scene = two_cubes(offset, false);
  const auto detector = prepared("ffd-aabb:cell=100", scene);
  const ContactSet got = answer(*detector, scene.frames[0], Question::kContacts);
  ASSERT_THAT(got.piece_contacts, Not(IsEmpty()));
  for (const PieceContact& c : got.piece_contacts) {
    const Scene separated = two_cubes(offset + (c.depth + 0x1p-20) * c.normal, false);
    EXPECT_THAT(answer(*detector, separated.frames[0]).cells, IsEmpty());
    const Scene not_yet = two_cubes(offset + (c.depth - 0x1p-20) * c.normal, false);
    EXPECT_THAT(answer(*detector, not_yet.frames[0]).cells, SizeIs(1));
  }
}

class NodePlaneMembers : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, NodePlaneMembers,
                         ::testing::Values("ffd-aabb", "ffd-aabb-sphere", "ffd-aabb-sphere2",
                                           "ffd-aabb-sphereN"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

TEST_P(NodePlaneMembers, DeclareContactsOfConvexPiecesForTheLevelBoxAlone) {
  const Scene scene = test::approach({.seed = 801}, 1);
  const Semantics paper = prepared(GetParam(), scene)->semantics();
  EXPECT_THAT(paper.questions, ::testing::ElementsAre(Question::kCells, Question::kBody,
                                                      Question::kContacts, Question::kSelf));
  EXPECT_EQ(paper.depth, DepthKind::kConvexPair);
  EXPECT_TRUE(paper.claims(Level::kBox));
  for (const std::string& name :
       {std::string("ffd-grid"), std::string(GetParam()) + ":bounds=safe",
        std::string(GetParam()) + "+tri", std::string(GetParam()) + "+tri:bounds=paper"}) {
    const Semantics other = prepared(name, scene)->semantics();
    EXPECT_FALSE(other.answers(Question::kContacts)) << name;
    EXPECT_EQ(other.depth, DepthKind::kNone) << name;
  }
}

/// Corners of the box of every kept cell, as the detector maps them.
std::vector<Corners> boxes_of(const BodyShape& shape, const std::vector<Vec3>& nodes) {
  const std::vector<Aabb> local = ffd_aabbs(shape.mesh, *shape.lattice, shape.embedding);
  std::vector<Corners> boxes;
  for (std::uint32_t cell = 0; cell < local.size(); ++cell)
    boxes.push_back(mapped_box(*shape.lattice, cell, local[cell], nodes));
  return boxes;
}

/// Depths to leave `box` of those corners that it holds, straight along `direction`.
std::vector<double> depths_along(const Corners& corners, const Corners& box,
                                 const Vec3& direction) {
  const BoxPlanes planes = planes_of_box(box);
  std::vector<double> depths;
  for (const Vec3& p : corners) {
    if (!node_inside(planes, p)) continue;
    for (int f = 0; f < 6; ++f) {
      const Vec3 unit = planes.normal[f].normalized();
      if ((unit - direction).norm() < 1e-9) depths.push_back(unit.dot(planes.point[f] - p));
    }
  }
  return depths;
}

TEST_P(NodePlaneMembers, ContactsCoverExactlyTheReportedCells) {
  std::size_t contacts = 0, from_a = 0, from_b = 0;
  for (std::uint64_t seed : {802, 803, 804}) {
    const Scene scene = test::approach({.seed = seed});
    const auto detector = prepared(std::string(GetParam()) + ":cell=2", scene);
    for (const FrameData& frame : scene.frames) {
      const ContactSet cells = answer(*detector, frame, Question::kCells);
      const ContactSet got = answer(*detector, frame, Question::kContacts);
      EXPECT_EQ(got.cells, cells.cells);
      EXPECT_EQ(got.bodies, cells.bodies);
      EXPECT_THAT(cells.piece_contacts, IsEmpty());
      std::vector<ElementPair> pieces;
      for (const PieceContact& c : got.piece_contacts) pieces.push_back(c.pieces);
      canonicalize(pieces);
      EXPECT_EQ(pieces, cells.cells);
      const auto a = boxes_of(*scene.bodies[0].shape, frame.nodes[0]);
      const auto b = boxes_of(*scene.bodies[1].shape, frame.nodes[1]);
      for (const PieceContact& c : got.piece_contacts) {
        EXPECT_NEAR(c.normal.norm(), 1.0, 1e-12);
        EXPECT_GE(c.depth, 0.0);
        // The normal moves b. Out of a box of a goes b's corner along it, out of one of b goes a's
        // corner against it.
        const auto b_in_a = depths_along(b[c.pieces.b], a[c.pieces.a], c.normal);
        const auto a_in_b = depths_along(a[c.pieces.a], b[c.pieces.b], -c.normal);
        const auto near = ::testing::DoubleNear(c.depth, 1e-9);
        EXPECT_TRUE(::testing::Value(b_in_a, Contains(near)) ||
                    ::testing::Value(a_in_b, Contains(near)));
        from_a += ::testing::Value(a_in_b, Contains(near));
        from_b += ::testing::Value(b_in_a, Contains(near));
      }
      contacts += got.piece_contacts.size();
    }
  }
  EXPECT_GT(contacts, 100u);
  EXPECT_GT(from_a, 20u);
  EXPECT_GT(from_b, 20u);
}

TEST_P(NodePlaneMembers, ContactsTakeTheNearestPlane) {
  const Scene scene = test::approach({.seed = 805});
  const auto detector = prepared(GetParam(), scene);
  std::size_t compared = 0;
  for (const FrameData& frame : scene.frames) {
    const auto a = boxes_of(*scene.bodies[0].shape, frame.nodes[0]);
    const auto b = boxes_of(*scene.bodies[1].shape, frame.nodes[1]);
    for (const PieceContact& c : answer(*detector, frame, Question::kContacts).piece_contacts) {
      std::vector<double> nearest;
      for (const auto& [nodes, box] :
           {std::pair(a[c.pieces.a], b[c.pieces.b]), std::pair(b[c.pieces.b], a[c.pieces.a])})
        for (const Vec3& p : nodes) {
          const BoxPlanes planes = planes_of_box(box);
          double least = 1e9;
          for (int f = 0; f < 6; ++f)
            least = std::min(least, planes.normal[f].normalized().dot(planes.point[f] - p));
          if (least >= 0.0) nearest.push_back(least);
        }
      EXPECT_THAT(nearest, Contains(::testing::DoubleNear(c.depth, 1e-9)));
      ++compared;
    }
  }
  EXPECT_GT(compared, 20u);
}

}  // namespace
}  // namespace contactcheck
