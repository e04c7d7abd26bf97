#include "core/narrow/impact_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "core/narrow/impact.h"
#include "tests/support/impact_cases.h"
#include "tests/support/impact_queries.h"

namespace contactcheck::test {
namespace {

/// The filter's answer as one of the exact test.
Impact impact_of(const FilteredImpact& filtered) {
  if (filtered.verdict != FilterVerdict::contact) return {};
  return {true, false, filtered.earliest, filtered.latest};
}

void expect_no_contradiction(const ImpactQuery& query, const FilteredImpact& filtered) {
  if (filtered.verdict == FilterVerdict::undecided) return;
  const Impact exact = find_impact_exact(query);
  EXPECT_EQ(contradiction(impact_of(filtered), exact), "")
      << "filter: " << text(impact_of(filtered)) << "\nexact: " << text(exact) << '\n'
      << text(query);
}

TEST(ImpactFilter, NeverContradictsTheExactTest) {
  std::mt19937_64 random(51);
  int decided = 0;
  for (int family = 0; family < kImpactFamilies - 1; ++family)
    for (int i = 0; i < 300; ++i) {
      const ImpactQuery query = draw_impact_query(random, static_cast<ImpactFamily>(family));
      const FilteredImpact filtered = filter_impact(query);
      decided += filtered.verdict != FilterVerdict::undecided;
      expect_no_contradiction(query, filtered);
    }
  EXPECT_GT(decided, 2000);
}

TEST(ImpactFilter, NeverContradictsTheExactTestOverTheWholeRange) {
  std::mt19937_64 random(52);
  int decided = 0;
  for (int i = 0; i < 40; ++i) {
    const ImpactQuery query = draw_impact_query(random, ImpactFamily::kWholeRange);
    const FilteredImpact filtered = filter_impact(query);
    decided += filtered.verdict != FilterVerdict::undecided;
    expect_no_contradiction(query, filtered);
  }
  EXPECT_EQ(decided, 0);  // some number is too large for its bounds
}

// Where the truth depends on a few units in the last place, a bound that is too small decides, and
// errs.
TEST(ImpactFilter, NeverContradictsTheExactTestOnNearMisses) {
  std::mt19937_64 random(53);
  for (const ImpactFamily family :
       {ImpactFamily::kRoundedTouch, ImpactFamily::kNudgedTouch, ImpactFamily::kNearlyPlanar,
        ImpactFamily::kFallBesideEdge, ImpactFamily::kMeetingEnds}) {
    int decided = 0;
    for (int i = 0; i < 3000; ++i) {
      const ImpactQuery query = draw_impact_query(random, family);
      const FilteredImpact filtered = filter_impact(query);
      decided += filtered.verdict != FilterVerdict::undecided;
      expect_no_contradiction(query, filtered);
    }
    EXPECT_GT(decided, 100) << name_of(family);
    EXPECT_LT(decided, 2900) << name_of(family);
  }
}

// Rounding of subnormal numbers is no part of the bounds, whatever large factors come after it.
TEST(ImpactFilter, NeverContradictsTheExactTestBesideSubnormalNumbers) {
  std::mt19937_64 random(54);
  int contacts = 0;
  for (int i = 0; i < 1500; ++i) {
    const ImpactQuery query = draw_impact_query(random, ImpactFamily::kTinyAxis);
    expect_no_contradiction(query, filter_impact(query));
    contacts += find_impact_exact(query).contact;
  }
  EXPECT_GT(contacts, 50);
}

TEST(ImpactFilter, DecidesPlainCrossings) {
  std::mt19937_64 random(55);
  int contacts = 0, undecided = 0;
  for (int i = 0; i < 2000; ++i) {
    const FilteredImpact filtered =
        filter_impact(draw_impact_query(random, ImpactFamily::kOneCrossing));
    contacts += filtered.verdict == FilterVerdict::contact;
    undecided += filtered.verdict == FilterVerdict::undecided;
  }
  EXPECT_LE(undecided, 30);  // another root is nearby
  EXPECT_GE(contacts, 1970);
}

// Whoever looks for the first of many contacts gets the same answers, and times after the first one
// so far within wider intervals.
TEST(FindImpact, TimesAreCertifiedUpToALimit) {
  std::mt19937_64 random(57);
  std::uniform_real_distribution<double> share(0, 1);
  int certified = 0, wide = 0;
  for (int family = 0; family < kImpactFamilies - 1; ++family)
    for (int i = 0; i < 150; ++i) {
      const ImpactQuery query = draw_impact_query(random, static_cast<ImpactFamily>(family));
      const Impact whole = find_impact(query);
      for (const double until : {-1.0, 0.0, share(random), 1.0, whole.earliest}) {
        const Impact limited = find_impact(query, until);
        ASSERT_EQ(limited.contact, whole.contact) << text(query);
        ASSERT_EQ(limited.starts_in_contact, whole.starts_in_contact) << text(query);
        ASSERT_LE(limited.earliest, whole.latest) << text(query);
        ASSERT_GE(limited.latest, whole.earliest) << text(query);
        if (limited.latest - limited.earliest <= kImpactTimeWidth) {
          certified += limited.contact;
          continue;
        }
        ++wide;
        ASSERT_GT(limited.earliest, until) << text(query);
      }
    }
  EXPECT_GT(certified, 1000);
  EXPECT_GT(wide, 500);
}

TEST(ImpactFilter, DecidesNearlyAllRandomQueries) {
  std::mt19937_64 random(56);
  int contacts = 0, undecided = 0;
  for (int i = 0; i < 4000; ++i) {
    const FilteredImpact filtered =
        filter_impact(draw_impact_query(random, ImpactFamily::kInSpace));
    contacts += filtered.verdict == FilterVerdict::contact;
    undecided += filtered.verdict == FilterVerdict::undecided;
  }
  EXPECT_LE(undecided, 4);
  EXPECT_GT(contacts, 100);
  EXPECT_LT(contacts, 1000);
}

TEST(ImpactFilter, LeavesContactAtTheStartToTheExactTest) {
  for (const ImpactCase& each : impact_cases()) {
    if (each.contacts.empty() || each.contacts.front().first != 0) continue;
    for (const ImpactQuery& query : relabelled(each.query))
      EXPECT_EQ(filter_impact(query).verdict, FilterVerdict::undecided) << each.name;
  }
}

// Exact scaling changes no sign and no rounding, until the bounds are out of their range.
TEST(ImpactFilter, DecidesTheSameAtEveryScaleWithinItsRange) {
  std::mt19937_64 random(57);
  for (int i = 0; i < 200; ++i) {
    const ImpactQuery query = draw_impact_query(random, ImpactFamily::kOneCrossing);
    const FilteredImpact filtered = filter_impact(query);
    for (const int exponent : {-95, -40, 3, 150, 290}) {
      const auto other = scaled(query, {exponent, exponent, exponent});
      ASSERT_TRUE(other);
      const FilteredImpact again = filter_impact(*other);
      EXPECT_EQ(again.verdict, filtered.verdict) << exponent;
      EXPECT_EQ(again.earliest, filtered.earliest) << exponent;
      EXPECT_EQ(again.latest, filtered.latest) << exponent;
    }
    for (const int exponent : {310, 900, -300}) {
      const auto other = scaled(query, {exponent, exponent, exponent});
      ASSERT_TRUE(other);
      EXPECT_EQ(filter_impact(*other).verdict, FilterVerdict::undecided) << exponent;
    }
  }
}

}  // namespace
}  // namespace contactcheck::test
