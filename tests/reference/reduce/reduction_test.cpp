#include "reference/reduce/reduction.h"

#include <gmock/gmock.h>

#include "core/types/shared_corners.h"

#include "reference/oracle/oracle.h"
#include "tests/reference/reduce/candidates.h"
#include "tests/support/shapes.h"

namespace contactcheck::reduce {
namespace {

using test::two_boxes;
using test::two_triangles;
using testing::Each;
using testing::ElementsAre;

constexpr std::size_t kPlenty = 100'000;

oracle::Truth truth_of(const CaseCandidate& candidate, const oracle::WantedTruth& wanted = {}) {
  const Snapshot snapshot = snapshot_of(candidate);
  const test::FrameData data = test::make_frame(snapshot.bodies, snapshot.nodes);
  return oracle::Oracle(snapshot.bodies).judge(data.frame(), wanted);
}

bool touches(const CaseCandidate& candidate) {
  return !truth_of(candidate).surface.triangles.empty();
}

/// Every coordinate is a whole number of one figure.
bool small_whole_numbers(const CaseCandidate& candidate) {
  for (const double x : coordinates_of(candidate))
    if (x != std::nearbyint(x) || std::abs(x) > 9.0) return false;
  return true;
}

TEST(Reduce, WhateverTouchesToTwoTrianglesOfSmallWholeNumbers) {
  const auto reduction = reduce(two_boxes(), std::nullopt, touches, kPlenty);
  ASSERT_TRUE(reduction);
  EXPECT_TRUE(reduction->complete);
  EXPECT_TRUE(touches(reduction->result));
  EXPECT_EQ(reduction->result.triangles(), 2u);
  EXPECT_EQ(reduction->result.vertices(), 6u);
  EXPECT_TRUE(small_whole_numbers(reduction->result));
  EXPECT_THAT(dimensions_of(reduction->result), Each(2));
}

// As a detector that is wrong where three triangles of a body are in play.
TEST(Reduce, KeepsAllTrianglesThatItTakes) {
  const auto shows = [](const CaseCandidate& c) {
    return c.meshes[0].triangles.size() >= 3 && touches(c);
  };
  const auto reduction = reduce(two_boxes(), std::nullopt, shows, kPlenty);
  ASSERT_TRUE(reduction);
  EXPECT_EQ(reduction->result.meshes[0].triangles.size(), 3u);
  EXPECT_EQ(reduction->result.meshes[1].triangles.size(), 1u);
  EXPECT_TRUE(small_whole_numbers(reduction->result));
}

TEST(Reduce, KeepsTheNumbersThatItTakes) {
  const auto shows = [](const CaseCandidate& c) {
    const std::vector<double> all = coordinates_of(c);
    return touches(c) && *std::max_element(all.begin(), all.end()) > 1.3 &&
           *std::min_element(all.begin(), all.end()) == 0.1;
  };
  const auto reduction = reduce(two_boxes(), std::nullopt, shows, kPlenty);
  ASSERT_TRUE(reduction);
  EXPECT_TRUE(shows(reduction->result));
  EXPECT_EQ(reduction->result.triangles(), 2u);
}

TEST(Reduce, StartsWithThePairAlone) {
  const CaseCandidate boxes = two_boxes();
  const ElementPair pair = truth_of(boxes).surface.triangles.front();
  std::vector<std::size_t> sizes;
  const auto shows = [&](const CaseCandidate& c) {
    sizes.push_back(c.triangles());
    return touches(c);
  };
  ASSERT_TRUE(reduce(boxes, TrianglePair{pair.a, pair.b}, shows, kPlenty));
  EXPECT_EQ(sizes.front(), 2u);
}

TEST(Reduce, GrowsThePairUntilItShows) {
  const CaseCandidate boxes = two_boxes(4);
  const ElementPair pair = truth_of(boxes).surface.triangles.front();
  std::vector<std::size_t> sizes;
  const auto shows = [&](const CaseCandidate& c) {
    sizes.push_back(c.triangles());
    return c.triangles() >= 7 && touches(c);
  };
  const auto reduction = reduce(boxes, TrianglePair{pair.a, pair.b}, shows, kPlenty);
  ASSERT_TRUE(reduction);
  EXPECT_EQ(reduction->result.triangles(), 7u);
  EXPECT_LE(*std::max_element(sizes.begin(), sizes.end()), 8u);
}

TEST(Reduce, TakesALatticeWhereItNeedsOne) {
  const auto shows = [](const CaseCandidate& c) { return c.on_nodes && touches(c); };
  const auto reduction = reduce(two_boxes(), std::nullopt, shows, kPlenty);
  ASSERT_TRUE(reduction);
  EXPECT_TRUE(reduction->result.on_nodes);
  EXPECT_EQ(reduction->result.triangles(), 2u);
}

TEST(Reduce, GivesNothingWhereNoStartShows) {
  EXPECT_FALSE(reduce(
      two_boxes(), TrianglePair{0, 0}, [](const CaseCandidate&) { return false; }, kPlenty));
}

TEST(Reduce, GivesTheSameEveryTime) {
  const auto first = reduce(two_boxes(), std::nullopt, touches, kPlenty);
  const auto second = reduce(two_boxes(), std::nullopt, touches, kPlenty);
  EXPECT_EQ(coordinates_of(first->result), coordinates_of(second->result));
  EXPECT_EQ(first->result.meshes[0].triangles, second->result.meshes[0].triangles);
  EXPECT_EQ(first->evaluations, second->evaluations);
}

TEST(Reduce, AsksNoMoreThanTheBudgetAndNothingTwice) {
  std::size_t asked = 0;
  const auto shows = [&](const CaseCandidate& c) {
    ++asked;
    return touches(c);
  };
  const auto reduction = reduce(two_boxes(), std::nullopt, shows, 12);
  ASSERT_TRUE(reduction);
  EXPECT_EQ(asked, 12u);
  EXPECT_EQ(reduction->evaluations, 12u);
  EXPECT_FALSE(reduction->complete);
  EXPECT_TRUE(touches(reduction->result));
}

TEST(Reduce, DoesNotFlattenTriangles) {
  // A segment and a triangle, apart.
  const CaseCandidate start = two_triangles({0.3, 0.1, 0.7, 1.3, 0.1, 0.7, 2.3, 0.1, 0.7,  //
                                             5.1, 0.2, 0.3, 6.4, 0.2, 0.3, 5.1, 7.7, 0.3});
  ASSERT_THAT(dimensions_of(start), ElementsAre(1, 2));
  const auto reduction = reduce(
      start, std::nullopt, [](const CaseCandidate& c) { return !touches(c); }, kPlenty);
  ASSERT_TRUE(reduction);
  EXPECT_THAT(dimensions_of(reduction->result), ElementsAre(1, 2));
}

TEST(WithPieces, KeepsTheOrderOfTrianglesAndDropsUnusedVertices) {
  const CaseCandidate boxes = two_boxes(1);
  const CaseCandidate part = with_pieces(boxes, {{0, 4}, {0, 7}, {1, 11}});
  ASSERT_EQ(part.meshes[0].triangles.size(), 2u);
  EXPECT_EQ(part.meshes[1].vertices.size(), 3u);
  const auto corners = [](const TriangleMesh& mesh, std::size_t t) {
    std::vector<Vec3> out;
    for (const std::uint32_t v : mesh.triangles[t]) out.push_back(mesh.vertices[v]);
    return out;
  };
  EXPECT_EQ(corners(part.meshes[0], 0), corners(boxes.meshes[0], 4));
  EXPECT_EQ(corners(part.meshes[0], 1), corners(boxes.meshes[0], 7));
  EXPECT_EQ(corners(part.meshes[1], 0), corners(boxes.meshes[1], 11));
}

TEST(SnapshotOf, PutsTheVerticesWhereTheyAreWithAndWithoutALattice) {
  for (const bool on_nodes : {false, true}) {
    CaseCandidate boxes = two_boxes();
    boxes.on_nodes = on_nodes;
    const Snapshot snapshot = snapshot_of(boxes);
    EXPECT_EQ(snapshot.bodies[0].shape->lattice.has_value(), on_nodes);
    EXPECT_EQ(coordinates_of(candidate_of(snapshot)), coordinates_of(boxes));
  }
}

/// Two cubes of one cell each.
Snapshot two_cells() {
  const Body cube = test::make_body("cube", test::unit_box_mesh(1), {1, 1, 1}, 0.0);
  const std::vector<Vec3> nodes = test::rest_nodes_at(*cube.shape, Vec3(0.25, 0.1, 0.7));
  return {{cube, cube}, {test::rest_nodes_at(*cube.shape, Vec3::Zero()), nodes}};
}

TEST(CellCandidates, HaveTheNodesOfTheirCellsBitForBit) {
  const Snapshot cells = two_cells();
  const std::vector<CaseCandidate> candidates = cell_candidates(cells, {0, 0});
  ASSERT_EQ(candidates.size(), 144u);
  for (const CaseCandidate& c : candidates) {
    const Snapshot alone = snapshot_of(c);
    for (std::size_t b = 0; b < 2; ++b) {
      ASSERT_EQ(alone.bodies[b].shape->lattice->cells.size(), 1u);
      EXPECT_EQ(alone.nodes[b], cells.nodes[b]);
    }
  }
}

TEST(Reduce, StartsWithTheCellsAloneAndKeepsAllTheirNodes) {
  const Snapshot cells = two_cells();
  const auto boxes_overlap = [](const CaseCandidate& c) {
    oracle::WantedTruth wanted;
    wanted.boxes = true;
    return c.on_nodes && !truth_of(c, wanted).boxes.empty();
  };
  const auto reduction = reduce(candidate_of(cells), std::nullopt, boxes_overlap, kPlenty,
                                cell_candidates(cells, {0, 0}));
  ASSERT_TRUE(reduction);
  EXPECT_EQ(reduction->result.vertices(), 16u);
  EXPECT_EQ(reduction->result.triangles(), 2u);
  EXPECT_TRUE(small_whole_numbers(reduction->result));
}

TEST(GeneralPosition, IsLostWhereACornerLiesInTheOtherPlane) {
  const std::vector<double> crossing = {0, 0, -2, 3, 0, -1, 0, 0, 2, 1, -1, 0, 1, 2, 0, 2, 1, 1};
  EXPECT_TRUE(in_general_position(two_triangles(crossing), {0, 0}, {1, 0}));
  std::vector<double> touching = crossing;
  touching[10] = 0.0;  // a corner of the second comes into the plane y = 0 of the first
  EXPECT_FALSE(in_general_position(two_triangles(touching), {0, 0}, {1, 0}));
  std::vector<double> flat = crossing;
  flat[6] = 6.0, flat[8] = 0.0;  // the first becomes a segment
  EXPECT_FALSE(in_general_position(two_triangles(flat), {0, 0}, {1, 0}));
}

// A third box, in no contact, between two that touch.
TEST(Reduce, KeepsTheMeshesThatItTakes) {
  CaseCandidate three = two_boxes();
  three.names = {"left", "between", "right"};
  three.meshes.insert(three.meshes.begin() + 1, three.meshes[0]);
  for (Vec3& v : three.meshes[1].vertices) v += Vec3(100.0, 0.0, 0.0);
  three.sides = {0, 2};
  const ElementPair contact = truth_of(three).surface.triangles.front();
  ASSERT_EQ(contact.body_b, 2u);
  for (const std::size_t needed : {2, 3}) {
    const auto shows = [&](const CaseCandidate& c) {
      return c.meshes.size() >= needed && touches(c);
    };
    const auto reduction = reduce(three, TrianglePair{contact.a, contact.b}, shows, kPlenty);
    ASSERT_TRUE(reduction);
    const CaseCandidate& least = reduction->result;
    EXPECT_EQ(least.names, needed == 3 ? three.names : (std::vector<std::string>{"left", "right"}));
    EXPECT_EQ(least.triangles(), needed);
    EXPECT_EQ(least.mesh_of(0), 0u);
    EXPECT_EQ(least.mesh_of(1), needed - 1);
  }
}

// What two triangles of one mesh share is what they are about.
TEST(Reduction, OneMeshKeepsTheVerticesThatItsTrianglesShare) {
  CaseCandidate box = two_boxes();
  box.names.resize(1);
  box.meshes.resize(1);
  const auto share_one = [](const CaseCandidate& c) {
    const std::vector<Triangle>& triangles = c.meshes[0].triangles;
    for (const Triangle& p : triangles)
      for (const Triangle& q : triangles)
        if (shared_corners(p, q).count == 1) return true;
    return false;
  };
  TrianglePair pair = {0, 0};
  while (shared_corners(box.meshes[0].triangles[0], box.meshes[0].triangles[pair[1]]).count != 1)
    ++pair[1];
  const auto reduction = reduce(box, pair, share_one, 10000);
  ASSERT_TRUE(reduction);
  EXPECT_TRUE(reduction->complete);
  ASSERT_EQ(reduction->result.meshes.size(), 1u);
  EXPECT_EQ(reduction->result.triangles(), 2u);
  EXPECT_EQ(reduction->result.vertices(), 5u);
}

}  // namespace
}  // namespace contactcheck::reduce
