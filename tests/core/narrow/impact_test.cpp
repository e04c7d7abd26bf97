#include "core/narrow/impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/impact_cases.h"
#include "tests/support/impact_queries.h"
#include "tests/support/range_ends.h"

namespace contactcheck::test {
namespace {

/// Both ways to an answer.
void expect_contacts(const ImpactQuery& query, const std::vector<ContactTimes>& contacts,
                     double error) {
  const Impact found = find_impact(query), exact = find_impact_exact(query);
  EXPECT_EQ(wrong_answer(found, contacts, error), "") << "find_impact: " << text(found) << '\n'
                                                      << text(query);
  EXPECT_EQ(wrong_answer(exact, contacts, error), "")
      << "find_impact_exact: " << text(exact) << '\n'
      << text(query);
}

std::vector<ContactTimes> backwards(const std::vector<ContactTimes>& contacts) {
  std::vector<ContactTimes> result;
  for (auto times = contacts.rbegin(); times != contacts.rend(); ++times)
    result.push_back({1 - times->last, 1 - times->first});
  return result;
}

class ImpactCases : public ::testing::TestWithParam<ImpactCase> {
 protected:
  /// The contacts of a query that differs from the case's in nothing that matters, in both
  /// directions of time.
  static void expect_the_same(const ImpactQuery& query) {
    expect_contacts(query, GetParam().contacts, GetParam().error);
    expect_contacts(reversed(query), backwards(GetParam().contacts), GetParam().error);
  }
};

TEST_P(ImpactCases, FirstContactInBothDirectionsOfTime) { expect_the_same(GetParam().query); }

TEST_P(ImpactCases, OrderOfPointsDoesNotMatter) {
  for (const ImpactQuery& query : relabelled(GetParam().query)) expect_the_same(query);
}

TEST_P(ImpactCases, OrderOfAxesDoesNotMatter) {
  for (const ImpactQuery& query : with_axes_permuted(GetParam().query)) expect_the_same(query);
}

TEST_P(ImpactCases, PowersOfTwoDoNotMatter) {
  for (const std::array<int, 3>& exponents : {std::array{40, 40, 40},
                                              {-300, -300, -300},
                                              {280, 280, 280},
                                              {900, 900, 900},
                                              {1, -600, 77}})
    if (const auto query = scaled(GetParam().query, exponents)) expect_the_same(*query);
}

INSTANTIATE_TEST_SUITE_P(All, ImpactCases, ::testing::ValuesIn(impact_cases()),
                         [](const auto& each) { return each.param.name; });

/// The step [from, to] alone. @pre multiples of 1/1024; whole numbers below 2^40
ImpactQuery part_of_step(const ImpactQuery& query, double from, double to) {
  ImpactQuery part = query;
  for (std::size_t i = 0; i < 4; ++i) {
    part.start[i] = (1 - from) * query.start[i] + from * query.end[i];
    part.end[i] = (1 - to) * query.start[i] + to * query.end[i];
  }
  return part;
}

class RepeatedContacts : public ::testing::TestWithParam<ImpactCase> {};

TEST_P(RepeatedContacts, EachOneIsTheFirstAfterTheOneBefore) {
  const auto& [name, query, contacts, error] = GetParam();
  const auto between = [](double a, double b) { return std::round(512 * (a + b)) / 1024; };
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double from = i == 0 ? 0.0 : between(contacts[i - 1].last, contacts[i].first);
    const double to =
        i + 1 == contacts.size() ? 1.0 : between(contacts[i].last, contacts[i + 1].first);
    const auto in_part = [&](double time) { return (time - from) / (to - from); };
    const std::vector<ContactTimes> times = {
        {in_part(contacts[i].first), in_part(contacts[i].last)}};
    const ImpactQuery part = part_of_step(query, from, to);
    const double rounded = error / (to - from) + 0x1p-50;
    expect_contacts(part, times, rounded);
    expect_contacts(reversed(part), backwards(times), rounded);
  }
}

INSTANTIATE_TEST_SUITE_P(All, RepeatedContacts, ::testing::ValuesIn(repeated_contacts()),
                         [](const auto& each) { return each.param.name; });

TEST(Impact, IntervalOfAnExactTimeHoldsIt) {
  for (int k = 1; k < 64; ++k) {
    ImpactQuery query;
    const double time = k / 64.0;
    query.start = {Vec3(0.25, 0.25, time), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    query.end = query.start;
    query.end[0].z() = time - 1;
    expect_contacts(query, {{time, time}}, 0);
  }
}

// Each axis has a factor s = 1 - (1 + m) t in the coordinates of all four points, so the
// coplanarity is the product of the three factors. At the root of one, the elements are those of
// the start projected along its axis; where roots coincide, projected along all of their axes.
struct Flips {
  ImpactKind kind;
  std::array<std::array<int, 3>, 4> places;  ///< at t = 0
  std::array<double, 3> factors;             ///< m per axis
};

int determinant(const std::array<std::array<int, 3>, 4>& p) {
  std::array<std::array<int, 3>, 3> q;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) q[i][axis] = p[i + 1][axis] - p[0][axis];
  return q[0][0] * (q[1][1] * q[2][2] - q[1][2] * q[2][1]) -
         q[0][1] * (q[1][0] * q[2][2] - q[1][2] * q[2][0]) +
         q[0][2] * (q[1][0] * q[2][1] - q[1][1] * q[2][0]);
}

using FlatPoint = std::array<int, 2>;

int turn(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  const int twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return (twice_area > 0) - (twice_area < 0);
}

bool on_flat_segment(const FlatPoint& p, const FlatPoint& a, const FlatPoint& b) {
  return turn(a, b, p) == 0 && std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) &&
         std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}

/// Whether the elements meet that are projected onto the axes for which `kept` is true.
bool projections_meet(const Flips& flips, const std::array<bool, 3>& kept) {
  std::array<FlatPoint, 4> p{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t axis = 0, coordinate = 0; axis < 3; ++axis)
      if (kept[axis]) p[i][coordinate++] = flips.places[i][axis];
  const auto& [a, b, c, d] = p;
  if (flips.kind == ImpactKind::edge_edge) {
    if (on_flat_segment(a, c, d) || on_flat_segment(b, c, d) || on_flat_segment(c, a, b) ||
        on_flat_segment(d, a, b))
      return true;
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
  }
  if (on_flat_segment(a, b, c) || on_flat_segment(a, c, d) || on_flat_segment(a, d, b)) return true;
  const int side = turn(b, c, a);
  return side != 0 && turn(c, d, a) == side && turn(d, b, a) == side;
}

std::vector<ContactTimes> first_contact(const Flips& flips) {
  std::array<double, 3> by_time = flips.factors;
  std::sort(by_time.rbegin(), by_time.rend());
  for (const double factor : by_time) {
    std::array<bool, 3> kept;
    for (std::size_t axis = 0; axis < 3; ++axis) kept[axis] = flips.factors[axis] != factor;
    if (projections_meet(flips, kept)) return {{1 / (1 + factor), 1 / (1 + factor)}};
  }
  return {};
}

ImpactQuery query_of(const Flips& flips) {
  ImpactQuery query;
  query.kind = flips.kind;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = flips.places[i][axis];
      query.start[i][static_cast<int>(axis)] = from;
      query.end[i][static_cast<int>(axis)] = -flips.factors[axis] * from;
    }
  return query;
}

/// Factors are least + k step for k = 0, 1, 2. Every pattern of roots with and without contact
/// occurs.
void expect_flips(std::uint64_t seed, double least, double step) {
  std::mt19937_64 random(seed);
  std::array<int, 8> patterns{};
  for (int i = 0; i < 200; ++i) {
    Flips flips;
    flips.kind = i % 2 == 0 ? ImpactKind::vertex_triangle : ImpactKind::edge_edge;
    for (auto& place : flips.places)
      for (int& coordinate : place) coordinate = static_cast<int>(random() % 9) - 4;
    for (double& factor : flips.factors) factor = least + step * static_cast<double>(random() % 3);
    if (determinant(flips.places) == 0) continue;  // planar throughout
    std::size_t pattern = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      pattern +=
          projections_meet(flips, {axis != 0, axis != 1, axis != 2}) ? std::size_t{1} << axis : 0;
    ++patterns[pattern];
    expect_contacts(query_of(flips), first_contact(flips), 0x1p-52);
  }
  EXPECT_GT(*std::min_element(patterns.begin(), patterns.end()), 0);
}

TEST(Impact, OfFlipsIsAtTheFirstRootWhoseProjectionsMeet) { expect_flips(21, 2, 1); }
TEST(Impact, OfFlipsAtDyadicTimesIsAtTheFirstRootWhoseProjectionsMeet) { expect_flips(22, 1, 2); }
TEST(Impact, OfRootsInOneIntervalKnowsWhichOnesAreContacts) { expect_flips(23, 2, 0x1p-45); }
TEST(Impact, OfRootsCloseToAHalfKnowsWhichOnesAreContacts) { expect_flips(24, 1, 0x1p-45); }
TEST(Impact, OfRootsAsCloseAsDoublesKnowsWhichOnesAreContacts) { expect_flips(25, 2, 0x1p-49); }

/// The case with its largest numbers next to the largest double, and the smallest one in place of
/// zeros.
/// @pre neither changes the contacts
ImpactCase over_the_whole_range(ImpactCase impact) {
  impact.query = scaled(impact.query, {1021, 1021, 1021}).value();
  for (auto* points : {&impact.query.start, &impact.query.end})
    for (Vec3& point : *points)
      for (double& coordinate : point)
        if (coordinate == 0) coordinate = kSmallestDouble;
  return impact;
}

// The widest integer has 3,498 limbs of the 3,549 that impact_exact.cpp derives.
TEST(Impact, OfCloseRootsOfTheWidestNumbersFits) {
  int tested = 0;
  for (const ImpactCase& each : impact_cases()) {
    if (each.name.rfind("TwoClose", 0) != 0) continue;
    ++tested;
    const auto [name, query, contacts, error] = over_the_whole_range(each);
    EXPECT_EQ(wrong_answer(find_impact_exact(query), contacts, error), "") << name;
    EXPECT_EQ(wrong_answer(find_impact_exact(reversed(query)), backwards(contacts), error), "")
        << name;
  }
  EXPECT_EQ(tested, 5);
}

}  // namespace
}  // namespace contactcheck::test
