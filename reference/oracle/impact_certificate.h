// Proofs about one query of moving elements that anybody can check with exact arithmetic: the
// pieces of the step in which the elements are apart, and, if they meet, where.
//
// Shares nothing with elementary_impact.h but the type of a query and the time of contact, which
// tells where to look: a wrong answer has no proof, so nothing is written down.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "core/types/impact.h"
#include "reference/oracle/elementary_impact.h"

namespace contactcheck::oracle::certify {

/// x + y * sqrt(root). A rational has y = 0 and root = 0.
struct Surd {
  mpq_class x, y;
  mpz_class root;
};

/// The volume of the four points is of one strict sign: they are never in one plane.
struct Volume {};

/// In the projection along the axis, the line through two corners of one element, `from` and `to`,
/// has all corners of the other element strictly on one side, and its own on the other one or on
/// it.
struct Side {
  std::size_t axis = 0, from = 0, to = 0;
};

/// At both ends of the piece, direction * p > direction * q for all corners p of the first element
/// and q of the second; and so in between, as corners move straight. Whole numbers.
struct Direction {
  std::array<mpz_class, 3> along;
};

/// A part of the step in which the elements are apart. It begins where the previous one ends.
struct ApartPiece {
  mpq_class end;
  std::variant<Volume, Side, Direction> reason;
};

/// The volume has opposite strict signs at both ends, and throughout the interval the projection
/// along the axis shows every common plane from one side, and a common point of the elements once
/// they are in one plane.
struct Crossing {
  mpq_class start, end;
  std::size_t axis = 0;
};

/// A common point: in either element the sum of its corners times their weights, which are not
/// negative and add up to 1.
struct Meeting {
  Surd time;                    ///< fraction of the step
  std::array<Surd, 4> weights;  ///< with the root of `time`, or 0
};

struct ImpactCertificate {
  std::vector<ApartPiece> apart;  ///< from t = 0, ascending; to t = 1 without contact
  /// The proof of a contact, which is at most kImpactTimeWidth after the last piece.
  std::variant<std::monostate, Crossing, Meeting> contact;
};

/// How many intervals the search for pieces may look at, and so many that for a crossing. Enough
/// next to a subnormal number among ordinary ones; a wrong answer takes up to seconds.
inline constexpr std::size_t kMostIntervals = 2500;

/// A proof of `answer`, exact. Nothing if the answer is wrong, or if the limit is reached, as
/// happens with coordinates over the whole range of doubles. @pre finite coordinates
std::optional<ImpactCertificate> certify_impact(const RationalImpactQuery& query,
                                                const Impact& answer,
                                                std::size_t most_intervals = kMostIntervals);
std::optional<ImpactCertificate> certify_impact(const ImpactQuery& query, const Impact& answer,
                                                std::size_t most_intervals = kMostIntervals);

}  // namespace contactcheck::oracle::certify
