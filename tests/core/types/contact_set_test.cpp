#include "core/types/contact_set.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// The bodies of impacts, with their times; -1: none.
std::vector<std::pair<BodyPair, double>> timed(const ContactSet& set) {
  std::vector<std::pair<BodyPair, double>> out;
  for (const BodyImpact& impact : set.impacts)
    out.emplace_back(impact.bodies, impact.time.value_or(-1.0));
  return out;
}

TEST(ContactSet, ListsOfStepsAreOrientedSortedAndWithoutRepeats) {
  ContactSet set;
  set.impact_triangles = {{2, 1, 30, 40}, {1, 2, 40, 30}, {1, 2, 4, 5}};
  set.impact_edges = {{3, 0, 5, 6}, {0, 3, 6, 5}, {0, 3, 5, 6}};
  // A vertex and a triangle are two kinds of elements: nothing is to be oriented.
  set.impact_vertices = {{2, 1, 7, 8}, {1, 2, 7, 8}, {2, 1, 7, 8}};
  set.self_impact_vertices = {{4, 4, 9, 1}, {4, 4, 1, 9}, {4, 4, 9, 1}};
  set.self_impact_edges = {{4, 9, 1}, {4, 1, 9}, {3, 2, 2}};
  set.canonicalize();
  EXPECT_THAT(set.impact_triangles,
              ElementsAre(ElementPair{1, 2, 4, 5}, ElementPair{1, 2, 40, 30}));
  EXPECT_THAT(set.impact_edges, ElementsAre(ElementPair{0, 3, 5, 6}, ElementPair{0, 3, 6, 5}));
  EXPECT_THAT(set.impact_vertices, ElementsAre(NearPair{1, 2, 7, 8}, NearPair{2, 1, 7, 8}));
  EXPECT_THAT(set.self_impact_vertices, ElementsAre(NearPair{4, 4, 1, 9}, NearPair{4, 4, 9, 1}));
  EXPECT_THAT(set.self_impact_edges, ElementsAre(SelfPair{3, 2, 2}, SelfPair{4, 1, 9}));
}

TEST(ContactSet, ElementsOfAStepImplyTheImpactOfTheirBodiesWithoutATime) {
  ContactSet triangles, vertices, edges;
  triangles.impact_triangles = {{5, 2, 0, 0}, {1, 0, 3, 3}, {2, 5, 1, 1}};
  vertices.impact_vertices = {{5, 2, 0, 0}, {0, 1, 3, 3}, {2, 5, 1, 1}, {1, 0, 3, 3}};
  edges.impact_edges = {{5, 2, 0, 0}, {1, 0, 3, 3}};
  for (ContactSet* set : {&triangles, &vertices, &edges}) {
    set->canonicalize();
    EXPECT_THAT(timed(*set),
                ElementsAre(std::pair{BodyPair{0, 1}, -1.0}, std::pair{BodyPair{2, 5}, -1.0}));
    EXPECT_THAT(set->bodies, IsEmpty()) << "a step says nothing about a frame";
  }
}

TEST(ContactSet, ContactOfABodyWithItselfInAStepImpliesNothing) {
  ContactSet set;
  set.self_impact_vertices = {{4, 4, 9, 1}};
  set.self_impact_edges = {{4, 9, 1}};
  set.canonicalize();
  EXPECT_THAT(set.impacts, IsEmpty());
  EXPECT_THAT(set.self_bodies, IsEmpty());
  EXPECT_THAT(set.bodies, IsEmpty());
}

TEST(ContactSet, ContactOfAFrameImpliesNoImpact) {
  ContactSet set;
  set.bodies = {{0, 1}};
  set.triangles = {{0, 1, 2, 3}};
  set.near = {{0, 1, 2, 3}};
  set.canonicalize();
  EXPECT_THAT(set.impacts, IsEmpty());
}

TEST(ContactSet, EarliestTimeOfTwoBodiesIsKept) {
  ContactSet set;
  set.impacts = {{{1, 0}, 0.75}, {{0, 1}, 0.25}, {{0, 1}, 0.5}, {{3, 2}, 1.0}, {{2, 3}, 0.0}};
  set.canonicalize();
  EXPECT_THAT(timed(set),
              ElementsAre(std::pair{BodyPair{0, 1}, 0.25}, std::pair{BodyPair{2, 3}, 0.0}));
}

TEST(ContactSet, BodiesWithAndWithoutATimeKeepTheTime) {
  ContactSet set;
  set.impacts = {{{1, 0}, std::nullopt}, {{0, 1}, 0.5}, {{2, 0}, std::nullopt}};
  set.impact_triangles = {{0, 1, 2, 3}};
  set.impact_vertices = {{3, 1, 2, 3}};
  set.canonicalize();
  EXPECT_THAT(timed(set),
              ElementsAre(std::pair{BodyPair{0, 1}, 0.5}, std::pair{BodyPair{0, 2}, -1.0},
                          std::pair{BodyPair{1, 3}, -1.0}));
}

TEST(ContactSet, TimeThatIsNoNumberIsKeptForWhoeverChecksTheSet) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<BodyImpact> impacts = {
      {{0, 1}, 0.5}, {{0, 1}, kNan}, {{0, 1}, -1.0}, {{0, 1}, std::nullopt}, {{1, 0}, kNan}};
  for (std::size_t turn = 0; turn < impacts.size(); ++turn) {
    ContactSet set;
    set.impacts = impacts;
    set.canonicalize();
    ASSERT_EQ(set.impacts.size(), 1u);
    ASSERT_TRUE(set.impacts[0].time.has_value());
    EXPECT_TRUE(std::isnan(*set.impacts[0].time));
    std::rotate(impacts.begin(), impacts.begin() + 1, impacts.end());
  }
}

TEST(ContactSet, ListsOfStepsAreTheSameAfterASecondTimeAndGoneAfterClear) {
  ContactSet set;
  set.impacts = {{{1, 0}, 0.5}};
  set.impact_triangles = {{2, 1, 30, 40}};
  set.impact_vertices = {{2, 1, 7, 8}};
  set.impact_edges = {{3, 0, 5, 6}};
  set.self_impact_vertices = {{4, 4, 9, 1}};
  set.self_impact_edges = {{4, 9, 1}};
  set.canonicalize();
  const ContactSet once = set;
  set.canonicalize();
  EXPECT_EQ(timed(set), timed(once));
  EXPECT_EQ(set.impacts.size(), 3u);
  EXPECT_EQ(set.impact_triangles, once.impact_triangles);
  EXPECT_EQ(set.impact_vertices, once.impact_vertices);
  EXPECT_EQ(set.impact_edges, once.impact_edges);
  EXPECT_EQ(set.self_impact_vertices, once.self_impact_vertices);
  EXPECT_EQ(set.self_impact_edges, once.self_impact_edges);
  set.clear();
  for_each_list([](ContactList, const auto& list) { EXPECT_THAT(list, IsEmpty()); }, set);
}

TEST(ContactSet, EachListIsVisitedOnceInOrder) {
  std::size_t next = 0;
  ContactSet set;
  for_each_list(
      [&](ContactList list, const auto&) { EXPECT_EQ(static_cast<std::size_t>(list), next++); },
      set);
  EXPECT_EQ(next, kContactLists);
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

/// Of a step: each list of elements has the same pair.
ContactSet sample_of_a_step() {
  ContactSet set;
  set.impacts = {{{0, 1}, 0.5}, {{1, 2}, std::nullopt}};
  set.impact_triangles = {{0, 1, 2, 3}};
  set.impact_vertices = {{0, 1, 2, 3}};
  set.impact_edges = {{0, 1, 2, 3}};
  set.self_impact_vertices = {{4, 4, 5, 6}};
  set.self_impact_edges = {{4, 5, 6}};
  set.canonicalize();
  return set;
}

TEST(ChainHash, DiffersForEveryChangeOfTheListsOfSteps) {
  std::vector<std::uint64_t> hashes = {chain_hash(17, 3, {}),
                                       chain_hash(17, 3, sample_of_a_step())};
  const auto add = [&](auto change) {
    ContactSet set = sample_of_a_step();
    change(set);
    hashes.push_back(chain_hash(17, 3, set));
  };
  add([](ContactSet& s) { s.impacts.pop_back(); });
  add([](ContactSet& s) { s.impact_triangles.clear(); });
  add([](ContactSet& s) { s.impact_triangles[0].b ^= 8; });
  add([](ContactSet& s) { s.impact_vertices[0].vertex ^= 8; });
  add([](ContactSet& s) { s.impact_edges[0].a ^= 8; });
  add([](ContactSet& s) { s.self_impact_vertices.clear(); });
  add([](ContactSet& s) { s.self_impact_vertices[0].triangle ^= 8; });
  add([](ContactSet& s) { s.self_impact_edges.clear(); });
  add([](ContactSet& s) { s.self_impact_edges[0].b ^= 8; });
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());
}

// As for the lists of frames: the same pair in another list is another answer.
TEST(ChainHash, TellsTheListsOfStepsApart) {
  std::vector<std::uint64_t> hashes;
  const auto add = [&](auto change) {
    ContactSet set;
    change(set);
    set.canonicalize();
    hashes.push_back(chain_hash(17, 3, set));
  };
  add([](ContactSet& s) { s.impact_triangles = {{0, 1, 2, 3}}; });
  add([](ContactSet& s) { s.impact_vertices = {{0, 1, 2, 3}}; });
  add([](ContactSet& s) { s.impact_edges = {{0, 1, 2, 3}}; });
  add([](ContactSet& s) { s.impact_triangles = {{0, 1, 2, 3}}, s.impact_edges = {{0, 1, 2, 3}}; });
  add([](ContactSet& s) { s.impact_vertices = {{0, 1, 2, 3}}, s.impact_edges = {{0, 1, 2, 3}}; });
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());
}

TEST(ChainHash, TimesOfImpactsAreNotHashed) {
  ContactSet set = sample_of_a_step();
  set.impacts[0].time = 0.25;
  EXPECT_EQ(chain_hash(17, 3, set), chain_hash(17, 3, sample_of_a_step()));
}

// The value from before there were lists of steps: results that were kept must stay comparable.
TEST(ChainHash, EmptyListsOfStepsChangeNothing) {
  EXPECT_EQ(chain_hash(17, 3, sample()), 2536664052674956985u);
}

}  // namespace
}  // namespace contactcheck
