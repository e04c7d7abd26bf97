#include "core/types/contact_set.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ContactSet, CanonicalizeOrientsElementsWithTheirBodies) {
  ContactSet set;
  set.triangles = {{2, 1, 30, 40}};
  set.cells = {{3, 0, 5, 6}};
  set.canonicalize();
  EXPECT_THAT(set.triangles, ElementsAre(ElementPair{1, 2, 40, 30}));
  EXPECT_THAT(set.cells, ElementsAre(ElementPair{0, 3, 6, 5}));
}

TEST(ContactSet, CanonicalizeSortsAndRemovesRepeats) {
  ContactSet set;
  set.triangles = {{0, 1, 9, 1}, {0, 1, 2, 8}, {1, 0, 8, 2}, {0, 1, 2, 7}, {0, 1, 9, 1}};
  set.vertices = {{1, 0, 4}, {0, 1, 5}, {1, 0, 4}};
  set.canonicalize();
  EXPECT_THAT(set.triangles, ElementsAre(ElementPair{0, 1, 2, 7}, ElementPair{0, 1, 2, 8},
                                         ElementPair{0, 1, 9, 1}));
  EXPECT_THAT(set.vertices, ElementsAre(VertexInBody{0, 1, 5}, VertexInBody{1, 0, 4}));
}

TEST(ContactSet, CanonicalizeAddsTheBodiesThatElementsImply) {
  ContactSet set;
  set.bodies = {{4, 3}, {0, 1}};
  set.triangles = {{1, 0, 0, 0}, {5, 2, 0, 0}, {0, 1, 3, 3}};
  set.cells = {{0, 6, 0, 0}};
  set.canonicalize();
  EXPECT_THAT(set.bodies,
              ElementsAre(BodyPair{0, 1}, BodyPair{0, 6}, BodyPair{2, 5}, BodyPair{3, 4}));
}

TEST(ContactSet, VertexInsideImpliesNoSurfaceContact) {
  ContactSet set;
  set.vertices = {{0, 1, 5}};
  set.canonicalize();
  EXPECT_THAT(set.bodies, IsEmpty());
}

TEST(ContactSet, PairsOfOneBodyAreOrientedAndImplyTheBodyAlone) {
  ContactSet set;
  set.self = {{3, 9, 2}, {1, 4, 5}, {3, 2, 9}};
  set.self_cells = {{8, 1, 0}, {8, 0, 1}};
  set.self_near = {{9, 9, 4, 1}, {9, 9, 1, 4}, {9, 9, 4, 1}};
  set.self_bodies = {7, 3};
  set.canonicalize();
  EXPECT_THAT(set.self, ElementsAre(SelfPair{1, 4, 5}, SelfPair{3, 2, 9}));
  EXPECT_THAT(set.self_cells, ElementsAre(SelfPair{8, 0, 1}));
  EXPECT_THAT(set.self_near, ElementsAre(NearPair{9, 9, 1, 4}, NearPair{9, 9, 4, 1}));
  EXPECT_THAT(set.self_bodies, ElementsAre(1, 3, 7, 8, 9));
  EXPECT_THAT(set.bodies, IsEmpty());
  set.clear();
  EXPECT_THAT(set.self, IsEmpty());
  EXPECT_THAT(set.self_cells, IsEmpty());
  EXPECT_THAT(set.self_near, IsEmpty());
  EXPECT_THAT(set.self_bodies, IsEmpty());
}

TEST(ContactSet, CanonicalizeTwiceChangesNothing) {
  ContactSet set;
  set.triangles = {{1, 0, 2, 3}, {0, 1, 3, 1}};
  set.canonicalize();
  const ContactSet once = set;
  set.canonicalize();
  EXPECT_EQ(set.triangles, once.triangles);
  EXPECT_EQ(set.bodies, once.bodies);
}

TEST(ContactSet, ClearEmptiesEveryListAndKeepsCapacity) {
  ContactSet set;
  set.bodies = {{0, 1}};
  set.cells = {{0, 1, 0, 0}};
  set.triangles.assign(100, ElementPair{});
  set.vertices = {{0, 1, 0}};
  set.clear();
  EXPECT_TRUE(set.bodies.empty() && set.cells.empty() && set.triangles.empty() &&
              set.vertices.empty());
  EXPECT_GE(set.triangles.capacity(), 100u);
}

ContactSet sample() {
  ContactSet set;
  set.cells = {{0, 1, 2, 3}, {1, 2, 0, 7}};
  set.triangles = {{0, 1, 5, 6}, {0, 1, 5, 9}, {0, 2, 1, 1}};
  set.vertices = {{0, 1, 5}};
  set.canonicalize();
  return set;
}

TEST(ChainHash, IsFreeOfOrderAndOrientation) {
  const std::uint64_t expected = chain_hash(17, 3, sample());
  test::TriangleSource random(5);
  for (int round = 0; round < 20; ++round) {
    ContactSet mixed = sample();
    for (std::vector<ElementPair>* list : {&mixed.cells, &mixed.triangles}) {
      for (ElementPair& p : *list)
        if (random.below(2)) p = {p.body_b, p.body_a, p.b, p.a};
      for (std::size_t i = 1; i < list->size(); ++i)
        std::swap((*list)[i], (*list)[random.below(static_cast<int>(i) + 1)]);
    }
    mixed.triangles.push_back(mixed.triangles.front());
    mixed.canonicalize();
    EXPECT_EQ(chain_hash(17, 3, mixed), expected);
  }
}

TEST(ChainHash, DiffersForEveryChange) {
  std::vector<std::uint64_t> hashes = {chain_hash(17, 3, sample()), chain_hash(18, 3, sample()),
                                       chain_hash(17, 4, sample()), chain_hash(17, 3, {})};
  const auto add = [&](auto change) {
    ContactSet set = sample();
    change(set);
    hashes.push_back(chain_hash(17, 3, set));
  };
  add([](ContactSet& s) { s.triangles.pop_back(); });
  add([](ContactSet& s) { s.triangles[0].a ^= 1; });
  add([](ContactSet& s) { s.triangles[0].b ^= 1; });
  add([](ContactSet& s) { s.triangles[0].body_b ^= 8; });
  add([](ContactSet& s) { s.bodies.pop_back(); });
  add([](ContactSet& s) { s.vertices[0].vertex ^= 1; });
  add([](ContactSet& s) { s.vertices.clear(); });
  // The same pair in another list is another answer.
  add([](ContactSet& s) {
    s.cells.push_back(s.triangles[0]), s.triangles.erase(s.triangles.begin());
  });
  add([](ContactSet& s) { s.triangles.swap(s.cells); });
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());
}

}  // namespace
}  // namespace contactcheck
