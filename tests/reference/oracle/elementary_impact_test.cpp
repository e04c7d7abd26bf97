#include "reference/oracle/elementary_impact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "core/narrow/impact.h"
#include "tests/support/impact_cases.h"
#include "tests/support/impact_queries.h"

namespace contactcheck::test {
namespace {

using oracle::elementary_impact;
using oracle::RationalImpactQuery;

std::vector<ContactTimes> last_contact_first(const std::vector<ContactTimes>& contacts) {
  std::vector<ContactTimes> result;
  for (auto times = contacts.rbegin(); times != contacts.rend(); ++times)
    result.push_back({1 - times->last, 1 - times->first});
  return result;
}

class ElementaryImpactCases : public ::testing::TestWithParam<ImpactCase> {};

TEST_P(ElementaryImpactCases, FirstContactInBothDirectionsOfTime) {
  const auto& [name, query, contacts, error] = GetParam();
  for (const ImpactQuery& same : relabelled(query)) {
    const Impact forward = elementary_impact(same), back = elementary_impact(reversed(same));
    EXPECT_EQ(wrong_answer(forward, contacts, error), "") << text(forward) << '\n' << text(same);
    EXPECT_EQ(wrong_answer(back, last_contact_first(contacts), error), "")
        << "backwards: " << text(back) << '\n'
        << text(same);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ElementaryImpactCases, ::testing::ValuesIn(impact_cases()),
                         [](const auto& each) { return each.param.name; });

/// The answers of both tests in core and the oracle's. Whether there is a contact.
bool compare(const ImpactQuery& query) {
  const Impact truth = elementary_impact(query);
  const Impact found = find_impact(query), exact = find_impact_exact(query);
  EXPECT_EQ(contradiction(found, truth), "")
      << "find_impact: " << text(found) << "\noracle: " << text(truth) << '\n'
      << text(query);
  EXPECT_EQ(contradiction(exact, truth), "")
      << "find_impact_exact: " << text(exact) << "\noracle: " << text(truth) << '\n'
      << text(query);
  return truth.contact;
}

void compare_family(ImpactFamily family, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  int contacts = 0;
  for (int i = 0; i < count; ++i) contacts += compare(draw_impact_query(random, family));
  // Of all other families some queries have a contact and some have none.
  EXPECT_GT(contacts, 0);
  EXPECT_TRUE(family == ImpactFamily::kOneCrossing || contacts < count);
}

class ImpactFamilies : public ::testing::TestWithParam<int> {};

TEST_P(ImpactFamilies, CoreAnswersAsTheOracle) {
  const auto family = static_cast<ImpactFamily>(GetParam());
  const bool slow = family == ImpactFamily::kWholeRange;
  compare_family(family, slow ? 25 : 300, 81);
}

INSTANTIATE_TEST_SUITE_P(All, ImpactFamilies, ::testing::Range(0, kImpactFamilies),
                         [](const auto& each) {
                           return name_of(static_cast<ImpactFamily>(each.param));
                         });

// Where doubles guess a root wrong within 2^-41, or see none.
TEST(ElementaryImpact, CoreAnswersAsTheOracleAtCloseRoots) {
  int contacts = 0, queries = 0;
  for (int bits = 10; bits < 60; ++bits)
    for (int i = 1; i < 20; ++i, ++queries)
      for (const double sign : {1.0, -1.0})
        contacts += compare(close_roots(i / 29.0, sign * std::ldexp(1.0, -bits)));
  EXPECT_GT(contacts, queries / 2);
  EXPECT_LT(contacts, 3 * queries / 2);
}

RationalImpactQuery rational(const ImpactQuery& query) {
  RationalImpactQuery result;
  result.kind = query.kind;
  for (std::size_t point = 0; point < 4; ++point)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.start[point][axis] = query.start[point][static_cast<int>(axis)];
      result.end[point][axis] = query.end[point][static_cast<int>(axis)];
    }
  return result;
}

TEST(ElementaryImpact, OfRationalsIsThatOfTheSameDoubles) {
  std::mt19937_64 random(82);
  for (int i = 0; i < 600; ++i) {
    const ImpactQuery query = draw_impact_query(random, static_cast<ImpactFamily>(i % 18));
    const Impact doubles = elementary_impact(query), rationals = elementary_impact(rational(query));
    EXPECT_EQ(doubles.contact, rationals.contact);
    EXPECT_EQ(doubles.starts_in_contact, rationals.starts_in_contact);
    EXPECT_EQ(doubles.earliest, rationals.earliest);
    EXPECT_EQ(doubles.latest, rationals.latest);
  }
}

TEST(ElementaryImpact, ScalingByAnyRationalKeepsTheAnswer) {
  std::mt19937_64 random(83);
  const mpq_class factor(22, 7);
  for (int i = 0; i < 300; ++i) {
    const ImpactQuery query = draw_impact_query(random, static_cast<ImpactFamily>(i % 16));
    RationalImpactQuery scaled_query = rational(query);
    for (auto* points : {&scaled_query.start, &scaled_query.end})
      for (auto& point : *points)
        for (mpq_class& value : point) value *= factor;
    EXPECT_EQ(contradiction(elementary_impact(query), elementary_impact(scaled_query)), "");
  }
}

using RationalPoint = std::array<mpq_class, 3>;

/// A vertex that falls onto the triangle (0, 0, 0), (1, 0, 0), (0, 1, 0).
RationalImpactQuery falling(const mpq_class& x, const mpq_class& y, const mpq_class& from,
                            const mpq_class& to) {
  RationalImpactQuery query;
  query.start = {RationalPoint{x, y, from}, RationalPoint{0, 0, 0}, RationalPoint{1, 0, 0},
                 RationalPoint{0, 1, 0}};
  query.end = query.start;
  query.end[0][2] = to;
  return query;
}

/// Whether an exact time lies in the interval of the answer.
bool holds(const Impact& answer, const mpq_class& time) {
  return answer.contact && mpq_class(answer.earliest) <= time && time <= mpq_class(answer.latest);
}

TEST(ElementaryImpact, OfRationalsThatAreNoDoubles) {
  const mpq_class third(1, 3), tiny(mpz_class(1), mpz_class("1000000000000000000000000000000"));
  // On the long edge, x + y = 1, and beside it.
  const Impact on_edge = elementary_impact(falling(third, 2 * third, 1, -2));
  EXPECT_TRUE(holds(on_edge, third)) << text(on_edge);
  EXPECT_FALSE(elementary_impact(falling(third, 2 * third + tiny, 1, -2)).contact);
  EXPECT_FALSE(elementary_impact(falling(-tiny, third, 1, -2)).contact);
  EXPECT_TRUE(holds(elementary_impact(falling(tiny, third, 1, -2)), third));
  // At t = 0 and t = 1 alone, and not quite.
  EXPECT_TRUE(elementary_impact(falling(third, third, 0, 1)).starts_in_contact);
  EXPECT_FALSE(elementary_impact(falling(third, third, tiny, 1)).contact);
  EXPECT_TRUE(holds(elementary_impact(falling(third, third, third, 0)), 1));
  EXPECT_FALSE(elementary_impact(falling(third, third, third, tiny)).contact);
  const Impact just_before_the_end = elementary_impact(falling(third, third, third, -tiny));
  EXPECT_TRUE(holds(just_before_the_end, third / (third + tiny)));
}

TEST(ElementaryImpact, OfRationalTimes) {
  for (int denominator = 2; denominator < 40; ++denominator)
    for (int numerator = 1; numerator < denominator; ++numerator) {
      mpq_class time(numerator, denominator);
      time.canonicalize();
      const Impact answer =
          elementary_impact(falling(mpq_class(1, 7), mpq_class(2, 7), time, time - 1));
      EXPECT_TRUE(holds(answer, time)) << time << ' ' << text(answer);
      EXPECT_EQ(inconsistency(answer), "");
    }
}

TEST(ElementaryImpact, OfEdgesThatCrossAtRationals) {
  const mpq_class third(1, 3), seventh(1, 7),
      tiny(mpz_class(1), mpz_class("1000000000000000000000"));
  RationalImpactQuery query;
  query.kind = ImpactKind::edge_edge;
  // The second edge ends on the first one, at 1/7, at t = 1/3.
  query.start = {RationalPoint{0, 0, 0}, RationalPoint{third, 0, 0}, RationalPoint{seventh, 0, 1},
                 RationalPoint{seventh, 1, 1}};
  query.end = query.start;
  query.end[2][2] = query.end[3][2] = -2;
  EXPECT_TRUE(holds(elementary_impact(query), third));
  query.start[2][1] = query.end[2][1] = tiny;
  EXPECT_FALSE(elementary_impact(query).contact);
}

}  // namespace
}  // namespace contactcheck::test
