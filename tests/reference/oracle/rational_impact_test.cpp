// Two exact answers to queries of moving elements that share no code: the oracle's, and brute force
// in rational arithmetic, which judges whole steps (tests/odd/odd_steps.cpp).
#include "tests/odd/rational_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "reference/oracle/elementary_impact.h"
#include "tests/support/impact_queries.h"

namespace contactcheck::test {
namespace {

/// What is wrong with the oracle's answer; empty if nothing is.
std::string fault(const Impact& impact, const std::vector<ExactTime>& times) {
  if (impact.contact != !times.empty()) return "another answer";
  if (!impact.contact) return "";
  const auto any = [&](auto&& is_so) { return std::any_of(times.begin(), times.end(), is_so); };
  const bool at_start = any([](const ExactTime& t) { return t.compared(0) == 0; });
  if (impact.starts_in_contact != at_start) return "not as it starts";
  if (any([&](const ExactTime& t) { return t.compared(impact.earliest) < 0; })) return "late";
  if (!any([&](const ExactTime& t) { return t.compared(impact.latest) <= 0; })) return "early";
  return "";
}

TEST(RationalImpact, OracleAgreesOnOddQueries) {
  std::mt19937_64 random(911);
  int contacts = 0, several = 0;
  for (int i = 0; i < 4000; ++i) {
    const ImpactFamily family = draw_impact_family(random);
    if (family == ImpactFamily::kWholeRange) continue;  // numbers of thousands of digits
    const ImpactQuery query = draw_impact_query(random, family);
    const std::vector<ExactTime> times = times_of_contact(query);
    ASSERT_EQ(fault(oracle::elementary_impact(query), times), "") << name_of(family) << "\n"
                                                                  << text(query);
    contacts += !times.empty();
    several += times.size() > 1;
  }
  EXPECT_GT(contacts, 1000);
  EXPECT_GT(several, 100);
}

// The same elements meet backwards, and the first time is 1 less the last one.
TEST(RationalImpact, OracleBackwardsGivesTheLastTime) {
  std::mt19937_64 random(912);
  int contacts = 0;
  for (int i = 0; i < 1500; ++i) {
    const ImpactFamily family = draw_impact_family(random);
    if (family == ImpactFamily::kWholeRange) continue;
    const ImpactQuery query = draw_impact_query(random, family);
    const std::vector<ExactTime> times = times_of_contact(query);
    const Impact back = oracle::elementary_impact(reversed(query));
    ASSERT_EQ(back.contact, !times.empty()) << text(query);
    if (!back.contact) continue;
    ++contacts;
    const mpq_class last = 1 - mpq_class(back.earliest), before = 1 - mpq_class(back.latest);
    bool reached = false;
    for (const ExactTime& t : times) {
      ASSERT_LE(t.compared(last), 0) << text(query);
      reached = reached || t.compared(before) >= 0;
    }
    ASSERT_TRUE(reached) << text(query);
  }
  EXPECT_GT(contacts, 400);
}

}  // namespace
}  // namespace contactcheck::test
