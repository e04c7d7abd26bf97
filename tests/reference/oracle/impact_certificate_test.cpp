#include "reference/oracle/impact_certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "reference/oracle/elementary_impact.h"
#include "tests/support/impact_cases.h"
#include "tests/support/impact_queries.h"

namespace contactcheck::test {
namespace {

using oracle::elementary_impact;
using oracle::RationalImpactQuery;
using oracle::certify::ApartPiece;
using oracle::certify::certify_impact;
using oracle::certify::Crossing;
using oracle::certify::Direction;
using oracle::certify::ImpactCertificate;
using oracle::certify::Meeting;

using Point = std::array<mpq_class, 3>;

Point place(const ImpactQuery& query, std::size_t point, const mpq_class& time) {
  Point result;
  for (int axis = 0; axis < 3; ++axis) {
    const mpq_class start = query.start[point][axis], end = query.end[point][axis];
    result[static_cast<std::size_t>(axis)] = start + time * (end - start);
  }
  return result;
}

mpq_class along(const Direction& direction, const Point& p) {
  return direction.along[0] * p[0] + direction.along[1] * p[1] + direction.along[2] * p[2];
}

std::size_t size_of_first(ImpactKind kind) { return kind == ImpactKind::vertex_triangle ? 1 : 2; }

bool leads(const Direction& direction, const ImpactQuery& query, const mpq_class& time) {
  std::vector<mpq_class> first, second;
  for (std::size_t i = 0; i < 4; ++i)
    (i < size_of_first(query.kind) ? first : second)
        .push_back(along(direction, place(query, i, time)));
  return *std::min_element(first.begin(), first.end()) >
         *std::max_element(second.begin(), second.end());
}

/// At a rational time; other times are for check.py.
bool is_common_point(const Meeting& meeting, const ImpactQuery& query) {
  std::array<Point, 2> points;
  std::array<mpq_class, 2> sums;
  for (std::size_t i = 0; i < 4; ++i) {
    const mpq_class& weight = meeting.weights[i].x;
    if (weight < 0) return false;
    const std::size_t element = i < size_of_first(query.kind) ? 0 : 1;
    sums[element] += weight;
    const Point p = place(query, i, meeting.time.x);
    for (std::size_t axis = 0; axis < 3; ++axis) points[element][axis] += weight * p[axis];
  }
  return sums[0] == 1 && sums[1] == 1 && points[0] == points[1];
}

/// What a certificate says that is wrong, of what rationals show at single times; else empty.
std::string fault(const ImpactCertificate& proof, const ImpactQuery& query, const Impact& truth) {
  mpq_class reached = 0;
  for (const ApartPiece& piece : proof.apart) {
    if (piece.end <= reached || piece.end > 1) return "the pieces are out of order";
    if (const auto* direction = std::get_if<Direction>(&piece.reason))
      for (const mpq_class& time : {reached, piece.end})
        if (!leads(*direction, query, time)) return "a direction does not separate the elements";
    reached = piece.end;
  }
  if (!truth.contact) {
    if (!std::holds_alternative<std::monostate>(proof.contact)) return "a contact";
    return reached == 1 ? "" : "the pieces end too early";
  }
  if (reached > truth.earliest) return "apart until after the contact";
  if (truth.latest - reached > kImpactTimeWidth * 3 / 2) return "apart until long before";
  if (const auto* crossing = std::get_if<Crossing>(&proof.contact))
    return crossing->start >= truth.earliest && crossing->end <= truth.latest &&
                   crossing->start < crossing->end
               ? ""
               : "crossing at another time";
  const auto* meeting = std::get_if<Meeting>(&proof.contact);
  if (!meeting) return "no contact";
  if (meeting->time.root != 0) return "";
  if (meeting->time.x < truth.earliest || meeting->time.x > truth.latest) return "another time";
  return is_common_point(*meeting, query) ? "" : "no common point";
}

/// Whether there is a proof, which has to be right.
bool has_proof(const ImpactQuery& query, std::size_t most_pieces) {
  const Impact truth = elementary_impact(query);
  const auto proof = certify_impact(query, truth);
  if (!proof) return false;
  EXPECT_EQ(fault(*proof, query, truth), "") << text(truth) << '\n' << text(query);
  EXPECT_LE(proof->apart.size(), most_pieces) << text(query);
  return true;
}

class ImpactCertificateCases : public ::testing::TestWithParam<ImpactCase> {};

TEST_P(ImpactCertificateCases, HasAProofInBothDirectionsOfTime) {
  for (const ImpactQuery& same : relabelled(GetParam().query))
    for (const ImpactQuery& query : {same, reversed(same)})
      EXPECT_TRUE(has_proof(query, 4)) << text(query);
}

TEST_P(ImpactCertificateCases, HasNoProofOfAWrongAnswer) {
  // A search that cannot succeed is cut short: true answers need fewer intervals than this.
  constexpr std::size_t kFewer = 300;
  const ImpactQuery& query = GetParam().query;
  const auto proof = [&](const Impact& answer) { return certify_impact(query, answer, kFewer); };
  const Impact truth = elementary_impact(query);
  EXPECT_TRUE(proof(truth));
  if (!truth.contact) {
    EXPECT_FALSE(proof({true, true, 0, 0}));
    EXPECT_FALSE(proof({true, false, 0.5, 0.5}));
    EXPECT_FALSE(proof({true, false, 0.5, 0.5 + kImpactTimeWidth / 2}));
    EXPECT_FALSE(proof({true, false, 1, 1}));
    return;
  }
  EXPECT_FALSE(proof({}));
  // Much later and much earlier than the first contact.
  if (truth.latest < 0.75) {
    EXPECT_FALSE(proof({true, false, 0.875, 0.875 + kImpactTimeWidth / 2}));
  }
  if (truth.earliest > 0.25) {
    EXPECT_FALSE(proof({true, false, 0.125, 0.125}));
  }
}

INSTANTIATE_TEST_SUITE_P(All, ImpactCertificateCases, ::testing::ValuesIn(impact_cases()),
                         [](const auto& each) { return each.param.name; });

class ImpactCertificateFamilies : public ::testing::TestWithParam<int> {};

TEST_P(ImpactCertificateFamilies, EveryQueryHasAProof) {
  const auto family = static_cast<ImpactFamily>(GetParam());
  const bool slow = family == ImpactFamily::kWholeRange;
  std::mt19937_64 random(91);
  for (int i = 0; i < (slow ? 16 : 300); ++i) {
    const ImpactQuery query = draw_impact_query(random, family);
    EXPECT_TRUE(has_proof(query, 8)) << text(query);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ImpactCertificateFamilies, ::testing::Range(0, kImpactFamilies),
                         [](const auto& each) {
                           return name_of(static_cast<ImpactFamily>(each.param));
                         });

TEST(ImpactCertificate, OfOneFamilyOrAnotherHasEachKindOfProof) {
  std::mt19937_64 random(92);
  std::array<int, 4> pieces{}, contacts{};
  for (int i = 0; i < 400; ++i) {
    const ImpactQuery query =
        draw_impact_query(random, i % 2 == 0 ? ImpactFamily::kFixedPlane : ImpactFamily::kInSpace);
    const auto proof = certify_impact(query, elementary_impact(query));
    ASSERT_TRUE(proof);
    for (const ApartPiece& piece : proof->apart) ++pieces[piece.reason.index()];
    const auto* meeting = std::get_if<Meeting>(&proof->contact);
    ++contacts[meeting && meeting->time.root != 0 ? 3 : proof->contact.index()];
  }
  for (const int reason : {0, 1, 2}) EXPECT_GT(pieces[static_cast<std::size_t>(reason)], 0);
  for (const int count : contacts) EXPECT_GT(count, 0);
}

/// A vertex in the plane of a triangle meets an edge that turns, where 2 t^2 + 5 t = 5.
TEST(ImpactCertificate, NamesAnIrrationalTimeExactly) {
  const ImpactQuery query{ImpactKind::vertex_triangle,
                          {Vec3(1, 2, 0), Vec3(0, 0, 0), Vec3(4, 3, 0), Vec3(4, -9, 0)},
                          {Vec3(2, 2, 0), Vec3(0, 0, 0), Vec3(4, 5, 0), Vec3(4, -9, 0)}};
  const auto proof = certify_impact(query, elementary_impact(query));
  ASSERT_TRUE(proof);
  const auto* meeting = std::get_if<Meeting>(&proof->contact);
  ASSERT_TRUE(meeting);
  EXPECT_EQ(meeting->time.root, 65);
  EXPECT_EQ(meeting->time.x, mpq_class(-5, 4));
  EXPECT_EQ(meeting->time.y, mpq_class(1, 4));
  EXPECT_EQ(meeting->weights[2].x, mpq_class(-1, 16));  // (1 + t) / 4
  EXPECT_EQ(meeting->weights[2].y, mpq_class(1, 16));
}

TEST(ImpactCertificate, GivesUpAtTheLimit) {
  std::mt19937_64 random(93);
  const ImpactQuery query = draw_impact_query(random, ImpactFamily::kRoundedTouch);
  const Impact truth = elementary_impact(query);
  EXPECT_FALSE(certify_impact(query, truth, 0));
  EXPECT_TRUE(certify_impact(query, truth));
}

/// All queries of a file of fixtures/queries.
std::vector<RationalImpactQuery> queries_of(const std::string& name, ImpactKind kind) {
  std::ifstream in(std::string(CONTACTCHECK_FIXTURES) + "/queries/" + name);
  std::vector<RationalImpactQuery> queries;
  std::string line, word;
  for (std::size_t number = 0; std::getline(in, line); ++number) {
    if (number % 8 == 0) queries.push_back({kind, {}, {}});
    auto& point = (number % 8 < 4 ? queries.back().start : queries.back().end)[number % 4];
    std::istringstream words(line);
    for (mpq_class& value : point) {
      std::getline(words, word, ',');
      value.get_num() = word;
      std::getline(words, word, ',');
      value.get_den() = word;
      value.canonicalize();
    }
  }
  return queries;
}

TEST(ImpactCertificate, ProvesAllQueriesOfTheFixtures) {
  const auto unproved = [](const std::string& name, ImpactKind kind) {
    const auto queries = queries_of(name, kind);
    EXPECT_FALSE(queries.empty()) << name;
    return std::count_if(queries.begin(), queries.end(), [](const RationalImpactQuery& query) {
      return !certify_impact(query, elementary_impact(query));
    });
  };
  EXPECT_EQ(unproved("vertex-face/by_hand.csv", ImpactKind::vertex_triangle), 0);
  EXPECT_EQ(unproved("vertex-face/no_doubles.csv", ImpactKind::vertex_triangle), 0);
  EXPECT_EQ(unproved("edge-edge/by_hand.csv", ImpactKind::edge_edge), 0);
}

}  // namespace
}  // namespace contactcheck::test
