#include "reference/scene/random_pairs.h"

#include <gtest/gtest.h>

#include <bit>

#include "core/types/hash.h"
#include "reference/scene/scene.h"

namespace contactcheck::scene {
namespace {

constexpr PairSpec kThreeFrames = {3 * RandomPairs::kSlots, 1};

std::uint64_t hash_of_frames(const RandomPairs& pairs) {
  Fnv1a hash;
  for (std::size_t f = 0; f < pairs.frames(); ++f)
    for (const std::vector<Vec3>& body : pairs.nodes(f))
      for (const Vec3& node : body)
        for (int k = 0; k < 3; ++k) hash.value(std::bit_cast<std::uint64_t>(node[k]));
  return hash.digest();
}

TEST(RandomPairs, AreTheseBitsOnEveryMachine) {
  EXPECT_EQ(hash_of_frames(RandomPairs(kThreeFrames)), 0xfcf34a93494a1974u)
      << std::hex << hash_of_frames(RandomPairs(kThreeFrames));
}

TEST(RandomPairs, DependOnTheSeedAloneAndOnNoFrameBefore) {
  const RandomPairs one({5 * RandomPairs::kSlots, 9}), same(one.spec()), other({5 * 576, 10});
  const auto last = one.nodes(4);
  EXPECT_EQ(one.nodes(1), same.nodes(1));
  EXPECT_EQ(same.nodes(4), last);
  EXPECT_NE(other.nodes(4), last);
  EXPECT_NE(one.nodes(3), last);
}

TEST(RandomPairs, AreAsManyAsAskedForAndTheRestOfTheLastFrameIsApart) {
  const RandomPairs pairs({RandomPairs::kSlots + 3, 1});
  EXPECT_EQ(pairs.frames(), 2u);
  EXPECT_EQ(pairs.pairs_of_frame(0), RandomPairs::kSlots);
  EXPECT_EQ(pairs.pairs_of_frame(1), 3u);
  for (std::size_t slot = 3; slot < RandomPairs::kSlots; ++slot) {
    const HardPair left_over = pairs.pair(1, slot);
    EXPECT_TRUE((left_over.a[0].array() < left_over.b[0].array()).all());
    for (std::size_t c = 1; c < 3; ++c) {
      EXPECT_EQ(left_over.a[c], left_over.a[0]);
      EXPECT_EQ(left_over.b[c], left_over.b[0]);
    }
  }
  EXPECT_EQ(RandomPairs({RandomPairs::kSlots, 1}).frames(), 1u);
  EXPECT_EQ(RandomPairs({1, 1}).pairs_of_frame(0), 1u);
}

bool strictly_inside(const Aabb& box, const std::array<Vec3, 3>& corners) {
  bool inside = true;
  for (const Vec3& c : corners)
    inside = inside && (box.lo.array() < c.array()).all() && (c.array() < box.hi.array()).all();
  return inside;
}

// Boxes that share at most their boundary, with everything strictly inside: only a triangle and its
// partner can touch.
TEST(RandomPairs, LieInSlotsOfTheirOwn) {
  const RandomPairs pairs({8 * RandomPairs::kSlots, 2});
  for (std::size_t f = 0; f < pairs.frames(); ++f) {
    std::vector<Aabb> boxes;
    for (std::size_t slot = 0; slot < RandomPairs::kSlots; ++slot) {
      boxes.push_back(pairs.slot_box(f, slot));
      const HardPair pair = pairs.pair(f, slot);
      ASSERT_TRUE(strictly_inside(boxes[slot], pair.a) && strictly_inside(boxes[slot], pair.b));
      for (std::size_t other = 0; other < slot; ++other) {
        const bool share_inside = (boxes[other].lo.array() < boxes[slot].hi.array()).all() &&
                                  (boxes[slot].lo.array() < boxes[other].hi.array()).all();
        ASSERT_FALSE(share_inside) << "frame " << f << ", slots " << slot << " and " << other;
      }
    }
  }
}

TEST(RandomPairs, ComeThroughTheLatticeBitForBit) {
  const RandomPairs pairs(kThreeFrames);
  const BodyShape& shape = *pairs.shape();
  ASSERT_EQ(shape.mesh.triangles.size(), RandomPairs::kSlots);
  const auto nodes = pairs.nodes(2);
  for (std::size_t body = 0; body < 2; ++body) {
    std::vector<Vec3> vertices(shape.mesh.vertices.size());
    map_body(shape, nodes[body], vertices);
    for (std::size_t slot = 0; slot < RandomPairs::kSlots; ++slot) {
      const HardPair pair = pairs.pair(2, slot);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(vertices[shape.mesh.triangles[slot][c]], (body == 0 ? pair.a : pair.b)[c]);
    }
  }
}

TEST(RandomPairs, HaveEveryKindInEveryFrameAndInTurnInEverySlot) {
  std::array<std::size_t, kPairKinds> of_frame = {}, of_slot = {};
  for (std::size_t slot = 0; slot < RandomPairs::kSlots; ++slot)
    ++of_frame[static_cast<std::size_t>(RandomPairs::kind_of(7, slot))];
  for (std::size_t frame = 0; frame < kPairKinds; ++frame)
    ++of_slot[static_cast<std::size_t>(RandomPairs::kind_of(frame, 5))];
  for (std::size_t k = 0; k < kPairKinds; ++k) {
    EXPECT_NEAR(static_cast<double>(of_frame[k]), 576.0 / kPairKinds, 1.0);
    EXPECT_EQ(of_slot[k], 1u);
  }
}

// The largest and the smallest slot that frames have been given.
TEST(RandomPairs, HaveManyScalesAndPlaces) {
  const RandomPairs pairs({200 * RandomPairs::kSlots, 1});
  double smallest = 1e300, largest = 0.0, farthest = 0.0;
  std::size_t about_origin = 0;
  for (std::size_t f = 0; f < pairs.frames(); ++f) {
    const Aabb box = pairs.slot_box(f, 0);
    const double side = box.extent().x(), away = box.center().cwiseAbs().maxCoeff();
    smallest = std::min(smallest, side);
    largest = std::max(largest, side);
    farthest = std::max(farthest, away / side);
    about_origin += away <= 8.0 * side;
  }
  EXPECT_LT(smallest, 0x1p-20);
  EXPECT_GT(largest, 0x1p40);
  EXPECT_GT(farthest, 0x1p15);
  EXPECT_GT(about_origin, 5u);
}

TEST(RandomPairs, AreAScene) {
  const Scene scene = make_pairs_scene({1000, 4});
  EXPECT_EQ(scene.id, "random-pairs");
  EXPECT_EQ(scene.frames, 2u);
  EXPECT_FALSE(scene.scripted());
  EXPECT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.nodes_of_frame(1), scene.pairs()->nodes(1));
}

}  // namespace
}  // namespace contactcheck::scene
