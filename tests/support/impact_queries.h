// Seeded queries of moving elements for tests, and changes of a query whose effect on the answer is
// known.
//
// Only the raw 64-bit output of mt19937_64 is used, which the standard fixes: the queries are the
// same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/types/impact.h"

namespace contactcheck::test {

enum class ImpactFamily : std::uint8_t {
  kInSpace,       ///< random in a cube
  kSmallWhole,    ///< whole numbers up to 2
  kOneCrossing,   ///< the elements cross inside both, at a random time, rounded to doubles
  kRoundedTouch,  ///< the same, but through a corner, an end or an edge
  kExactTouch,    ///< an exact touch at t = 0, 1/2 or 1: at corners, on edges, inside, just outside
  kNudgedTouch,   ///< the same, then one coordinate is moved by one unit in the last place
  kNearlyPlanar,  ///< one point stays the same affine combination of the others, up to rounding
  kFallBesideEdge,  ///< along an axis, onto or beside an edge or an end, up to rounding
  kMeetingEnds,     ///< a corner or an end meets another one, or nearly so; differences are rounded
  kFixedPlane,      ///< all in a plane that rests
  kTurningPlane,    ///< all in a plane that turns about a direction
  kFixedCombination,  ///< one point stays the same affine combination of the others
  kPlanarEnds,        ///< in one plane at t = 0 and in another one at t = 1
  kOnLine,            ///< all on a line that rests
  kLinearEnds,        ///< on one line at t = 0 and on another one at t = 1
  kRepeated,          ///< two points are the same, at one end or throughout
  kAtRest,            ///< some points do not move, or none does
  kFarAway,           ///< whole numbers far from the origin
  kFlips,             ///< each coordinate of all points changes sign at once: multiple roots
  kCloseFlips,        ///< the same at times that are closer than 2^-41
  kScaledAxes,        ///< one of the above, each axis times a power of two of its own
  kTinyAxis,          ///< subnormal numbers along one axis, large ones along the others
  kWholeRange,        ///< coordinates over the whole range of doubles; slow to answer exactly
};
inline constexpr int kImpactFamilies = 23;

/// As it is in the enumeration, without the k.
const char* name_of(ImpactFamily family);

ImpactQuery draw_impact_query(std::mt19937_64& random, ImpactFamily family);
/// kWholeRange once in 2000 times, the others equally often.
ImpactFamily draw_impact_family(std::mt19937_64& random);

/// A vertex dips through a turning triangle and comes back. The determinant, z less the height of
/// the plane at x, is (t - time)^2 - square: two roots, the closer the smaller `square` is. From
/// 2^-24 on downwards doubles cannot tell within 2^-41 where these are.
ImpactQuery close_roots(double time, double square);

/// The query backwards in time.
ImpactQuery reversed(const ImpactQuery& query);

/// All queries about the same elements: corners in every order; edges and their ends in every
/// order.
std::vector<ImpactQuery> relabelled(const ImpactQuery& query);

/// All orders of the axes.
std::vector<ImpactQuery> with_axes_permuted(const ImpactQuery& query);

/// Each axis times a power of two; nothing where that rounds.
std::optional<ImpactQuery> scaled(const ImpactQuery& query, const std::array<int, 3>& exponents);

/// Moved by one offset at t = 0 and another one at t = 1; nothing where that rounds.
std::optional<ImpactQuery> translated(const ImpactQuery& query, const Vec3& at_start,
                                      const Vec3& at_end);

/// The steps [0, 1/2] and [1/2, 1]; nothing where a midpoint is not a double.
std::optional<std::array<ImpactQuery, 2>> halves(const ImpactQuery& query);

/// What is wrong with an answer whatever the query is; empty if nothing is.
std::string inconsistency(const Impact& answer);

/// How two answers to one query contradict each other, or what is wrong with one of them; empty if
/// nothing is.
std::string contradiction(const Impact& a, const Impact& b);

/// One line.
std::string text(const Impact& answer);
/// A line for the kind and eight lines of hexadecimal doubles, the four points at t = 0, then at t
/// = 1.
std::string text(const ImpactQuery& query);

}  // namespace contactcheck::test
