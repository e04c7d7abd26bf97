// Relations between the answers to a query and to the same query in other words: backwards in time,
// in another order, scaled, moved, in two halves. They hold whatever the answer is.

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/narrow/impact.h"
#include "tests/support/impact_queries.h"

namespace contactcheck::test {
namespace {

constexpr int kQueriesOfAFamily = 40;

/// Queries of all families but the slow one.
std::vector<ImpactQuery> drawn_queries(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<ImpactQuery> queries;
  for (int family = 0; family < kImpactFamilies - 1; ++family)
    for (int i = 0; i < kQueriesOfAFamily; ++i)
      queries.push_back(draw_impact_query(random, static_cast<ImpactFamily>(family)));
  return queries;
}

/// The query in other words has the same answer.
void expect_same(const ImpactQuery& query, const Impact& answer, const ImpactQuery& other) {
  const Impact again = find_impact(other);
  EXPECT_EQ(contradiction(answer, again), "") << text(answer) << '\n'
                                              << text(query) << text(again) << '\n'
                                              << text(other);
}

TEST(ImpactRelations, OrderOfPointsDoesNotMatter) {
  for (const ImpactQuery& query : drawn_queries(41)) {
    const Impact answer = find_impact(query);
    const std::vector<ImpactQuery> others = relabelled(query);
    expect_same(query, answer, others[1]);
    expect_same(query, answer, others.back());
  }
}

TEST(ImpactRelations, OrderOfAxesDoesNotMatter) {
  for (const ImpactQuery& query : drawn_queries(42)) {
    const Impact answer = find_impact(query);
    const std::vector<ImpactQuery> others = with_axes_permuted(query);
    expect_same(query, answer, others[1]);
    expect_same(query, answer, others[3]);
  }
}

TEST(ImpactRelations, PowersOfTwoDoNotMatter) {
  int scales = 0;
  for (const ImpactQuery& query : drawn_queries(43)) {
    const Impact answer = find_impact(query);
    for (const std::array<int, 3>& exponents : {std::array{-500, -500, -500}, {7, -90, 200}})
      if (const auto other = scaled(query, exponents)) {
        ++scales;
        expect_same(query, answer, *other);
      }
  }
  EXPECT_GT(scales, 34 * kQueriesOfAFamily);
}

TEST(ImpactRelations, CommonMotionsDoNotMatter) {
  int moves = 0;
  for (const ImpactQuery& query : drawn_queries(44))
    for (const auto& [at_start, at_end] :
         {std::array{Vec3(7, 8, -9), Vec3(7, 8, -9)}, {Vec3(100, 0, -30), Vec3(-20, 1000, 0)}})
      if (const auto other = translated(query, at_start, at_end)) {
        ++moves;
        expect_same(query, find_impact(query), *other);
      }
  EXPECT_GT(moves, 20 * kQueriesOfAFamily);
}

TEST(ImpactRelations, ContactBackwardsIsContact) {
  int contacts = 0;
  for (const ImpactQuery& query : drawn_queries(45)) {
    const Impact forward = find_impact(query), back = find_impact(reversed(query));
    EXPECT_EQ(inconsistency(back), "") << text(query);
    EXPECT_EQ(forward.contact, back.contact) << text(query);
    // The first contact is not after the last one.
    EXPECT_TRUE(!forward.contact || forward.earliest <= 1 - back.earliest) << text(query);
    contacts += forward.contact;
  }
  EXPECT_GT(contacts, 5 * kQueriesOfAFamily);
  EXPECT_LT(contacts, 15 * kQueriesOfAFamily);
}

/// The answer for the step from the answers for its halves.
Impact joined(const Impact& first, const Impact& second) {
  if (first.contact) return {true, first.starts_in_contact, first.earliest / 2, first.latest / 2};
  if (!second.contact) return {};
  return {true, false, 0.5 + second.earliest / 2, 0.5 + second.latest / 2};
}

TEST(ImpactRelations, HalvesOfAStepAnswerForTheStep) {
  int halved = 0, in_the_second = 0;
  for (const ImpactQuery& query : drawn_queries(46)) {
    const auto parts = halves(query);
    if (!parts) continue;
    ++halved;
    const Impact whole = find_impact(query);
    const Impact first = find_impact((*parts)[0]), second = find_impact((*parts)[1]);
    EXPECT_EQ(inconsistency(first), "");
    EXPECT_EQ(inconsistency(second), "");
    const Impact both = joined(first, second);
    EXPECT_EQ(contradiction(whole, both), "") << text(whole) << '\n'
                                              << text(both) << '\n'
                                              << text(query);
    in_the_second += both.contact && !first.contact;
  }
  EXPECT_GT(halved, 8 * kQueriesOfAFamily);
  EXPECT_GT(in_the_second, kQueriesOfAFamily);
}

}  // namespace
}  // namespace contactcheck::test
