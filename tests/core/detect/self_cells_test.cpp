// A body against itself. Its cells: as those of two bodies in one place, without neighbours. Its
// triangles: those of all pairs.
#include <gtest/gtest.h>

#include <set>

#include "core/deform/lattice.h"
#include "core/narrow/adjacent_triangles.h"
#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::Scene;
using Cells = std::set<std::pair<std::uint32_t, std::uint32_t>>;

// The first body alone, or twice in one place.
Scene copies_of_first(const Scene& scene, std::size_t count) {
  Scene out;
  out.bodies.assign(count, scene.bodies[0]);
  for (const FrameData& frame : scene.frames)
    out.frames.push_back(
        test::make_frame(out.bodies, std::vector<std::vector<Vec3>>(count, frame.nodes[0])));
  return out;
}

Cells apart(const BodyShape& shape, const auto& pairs) {
  Cells out;
  for (const auto& p : pairs)
    if (!share_node(*shape.lattice, p.a, p.b)) out.insert(std::minmax(p.a, p.b));
  return out;
}

TEST(SelfCells, AreThoseOfTwoBodiesInOnePlace) {
  std::size_t found = 0;
  for (const std::string& id : test::family())
    for (const char* variant : {"", ":bounds=safe", ":precision=single"})
      for (const std::uint64_t seed : {1, 2, 3}) {
        const Scene all = test::approach({seed, 1.2}, 3);
        const Scene one = copies_of_first(all, 1), two = copies_of_first(all, 2);
        const auto own = test::prepared(id + variant, one),
                   pair = test::prepared(id + variant, two);
        for (std::size_t f = 0; f < one.frames.size(); ++f) {
          const ContactSet self = test::answer(*own, one.frames[f], Question::kSelf);
          const Cells cells = apart(*one.bodies[0].shape, self.self_cells);
          EXPECT_EQ(cells.size(), self.self_cells.size()) << "no neighbours, each pair once";
          EXPECT_EQ(cells, apart(*one.bodies[0].shape,
                                 test::answer(*pair, two.frames[f], Question::kCells).cells))
              << id << variant << ", seed " << seed << ", frame " << f;
          EXPECT_EQ(self.self_bodies.size(), cells.empty() ? 0u : 1u);
          found += cells.size();
        }
      }
  EXPECT_GT(found, 100u);
}

TEST(SelfCells, AskedBetweenOtherQuestionsChangeNoAnswer) {
  const Scene scene = test::approach({4, 0.8}, 4);
  for (const std::string& id : test::family()) {
    const auto detector = test::prepared(id, scene), other = test::prepared(id, scene);
    for (const FrameData& frame : scene.frames) {
      const ContactSet before = test::answer(*detector, frame, Question::kCells);
      const ContactSet self = test::answer(*other, frame, Question::kSelf);
      EXPECT_EQ(test::answer(*detector, frame, Question::kSelf).self_cells, self.self_cells);
      EXPECT_EQ(test::answer(*detector, frame, Question::kCells).cells, before.cells);
    }
  }
}

std::vector<SelfPair> brute_force(const BodyShape& shape, std::span<const Vec3> vertices) {
  const std::vector<Triangle>& triangles = shape.mesh.triangles;
  const auto points = [&](std::size_t t) {
    return TrianglePoints{vertices[triangles[t][0]], vertices[triangles[t][1]],
                          vertices[triangles[t][2]]};
  };
  std::vector<SelfPair> out;
  for (std::uint32_t a = 0; a < triangles.size(); ++a)
    for (std::uint32_t b = a + 1; b < triangles.size(); ++b)
      if (meet_beyond_shared(shared_corners(triangles[a], triangles[b]), points(a), points(b)))
        out.push_back({0, a, b});
  return out;
}

TEST(SelfTriangles, AreThoseOfAllPairs) {
  std::size_t found = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Scene one = copies_of_first(test::approach({seed, 1.2}, 3), 1);
    std::vector<std::vector<SelfPair>> truth;
    for (const FrameData& frame : one.frames)
      truth.push_back(brute_force(*one.bodies[0].shape, frame.vertices[0]));
    for (const std::string& id : test::family()) {
      const auto safe = test::prepared(id + "+tri", one),
                 paper = test::prepared(id + "+tri:bounds=paper", one);
      for (std::size_t f = 0; f < one.frames.size(); ++f) {
        EXPECT_EQ(test::answer(*safe, one.frames[f], Question::kSelf).self, truth[f])
            << id << ", seed " << seed << ", frame " << f;
        const ContactSet some = test::answer(*paper, one.frames[f], Question::kSelf);
        EXPECT_TRUE(std::ranges::includes(truth[f], some.self)) << id;
        found += truth[f].size();
      }
    }
  }
  EXPECT_GT(found, 100u);
}

}  // namespace
}  // namespace contactcheck
