#include "tests/support/impact_cases.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <utility>

#include "tests/support/impact_queries.h"
#include "tests/support/range_ends.h"

namespace contactcheck::test {
namespace {

struct Path {
  Vec3 from, to;
};
using Paths = std::array<Path, 4>;
using Contacts = std::vector<ContactTimes>;

constexpr ImpactKind kVertexTriangle = ImpactKind::vertex_triangle;
constexpr ImpactKind kEdgeEdge = ImpactKind::edge_edge;
constexpr double kThird = 1.0 / 3;
/// The error of a third and its like as doubles.
constexpr double kRounded = 0x1p-53;

Path rest(double x, double y, double z) { return {{x, y, z}, {x, y, z}}; }
/// Moves along z alone.
Path fall(double x, double y, double from, double to) { return {{x, y, from}, {x, y, to}}; }

ImpactCase impact(std::string name, ImpactKind kind, const Paths& paths, Contacts contacts,
                  double error = 0) {
  ImpactCase result{std::move(name), {kind, {}, {}}, std::move(contacts), error};
  for (std::size_t i = 0; i < 4; ++i) {
    result.query.start[i] = paths[i].from;
    result.query.end[i] = paths[i].to;
  }
  return result;
}

ImpactCase vf(std::string name, const Path& v, const Path& a, const Path& b, const Path& c,
              Contacts contacts, double error = 0) {
  return impact(std::move(name), kVertexTriangle, {v, a, b, c}, std::move(contacts), error);
}

ImpactCase ee(std::string name, const Path& a0, const Path& a1, const Path& b0, const Path& b1,
              Contacts contacts, double error = 0) {
  return impact(std::move(name), kEdgeEdge, {a0, a1, b0, b1}, std::move(contacts), error);
}

/// A vertex on this path and the triangle (0, 0, 0), (1, 0, 0), (0, 1, 0) at rest.
ImpactCase at_corner(std::string name, const Path& v, Contacts contacts, double error = 0) {
  return vf(std::move(name), v, rest(0, 0, 0), rest(1, 0, 0), rest(0, 1, 0), std::move(contacts),
            error);
}

double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
double below(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }

void append(std::vector<ImpactCase>& to, std::vector<ImpactCase> more) {
  for (ImpactCase& each : more) to.push_back(std::move(each));
}

std::vector<ImpactCase> vertex_and_resting_triangle() {
  const double smallest = kSmallestDouble;
  return {
      at_corner("ThroughTheFace", fall(0.25, 0.25, 1, -1), {{0.5, 0.5}}),
      at_corner("ThroughTheFaceFromBelow", fall(0.25, 0.25, -1, 3), {{0.25, 0.25}}),
      at_corner("ThroughTheFaceAtAThird", fall(0.25, 0.25, 1, -2), {{kThird, kThird}}, kRounded),
      at_corner("BesideTheTriangle", fall(1, 1, 1, -1), {}),
      at_corner("TooShort", fall(0.25, 0.25, 1, 0.5), {}),
      at_corner("Parallel", {{0.25, 0.25, 1}, {0.5, 0.25, 1}}, {}),

      at_corner("ThroughTheLongEdge", fall(0.5, 0.5, 1, -1), {{0.5, 0.5}}),
      at_corner("OneUnitBesideTheLongEdge", fall(0.5, above(0.5), 1, -1), {}),
      at_corner("OneUnitInsideTheLongEdge", fall(0.5, below(0.5), 1, -1), {{0.5, 0.5}}),
      at_corner("ThroughTheEdgeAlongX", fall(0.5, 0, 1, -1), {{0.5, 0.5}}),
      at_corner("TheSmallestDoubleBesideTheEdgeAlongX", fall(0.5, -smallest, 1, -1), {}),
      at_corner("ThroughTheEdgeAlongY", fall(0, 0.5, 1, -1), {{0.5, 0.5}}),
      at_corner("TheSmallestDoubleBesideTheEdgeAlongY", fall(-smallest, 0.5, 1, -1), {}),
      at_corner("ThroughTheCorner", fall(1, 0, 1, -1), {{0.5, 0.5}}),
      at_corner("OneUnitBesideTheCorner", fall(above(1), 0, 1, -1), {}),
      // Through the edge once its places are rounded to Float32, and the other way.
      at_corner("BesideTheEdgeInDoublesAlone", fall(0.5 + 0x1p-30, 0.5 + 0x1p-30, 1, -1), {}),
      vf("InsideTheEdgeInDoublesAlone", fall(0x1.000001051eb85p-1, 0x1.ffffff3333333p-2, 1, -1),
         rest(0, 0, 0), rest(0x1.0000006666666p+0, 0, 0), rest(0, 0x1.0000006666666p+0, 0),
         {{0.5, 0.5}}),

      at_corner("StartsOnTheFace", fall(0.25, 0.25, 0, 1), {{0, 0}}),
      at_corner("StartsOnTheEdge", fall(0.5, 0.5, 0, 1), {{0, 0}}),
      at_corner("StartsOneUnitBesideTheEdge", fall(0.5, above(0.5), 0, 1), {}),
      at_corner("StartsOnTheCorner", fall(0, 1, 0, -1), {{0, 0}}),
      at_corner("StartsTheSmallestDoubleAboveTheFace", fall(0.25, 0.25, smallest, 1), {}),
      at_corner("EndsOnTheFace", fall(0.25, 0.25, 1, 0), {{1, 1}}),
      at_corner("EndsOnTheEdge", fall(0.5, 0.5, -1, 0), {{1, 1}}),
      at_corner("EndsOneUnitBesideTheEdge", fall(above(0.5), 0.5, -1, 0), {}),
      at_corner("EndsTheSmallestDoubleAboveTheFace", fall(0.25, 0.25, 1, smallest), {}),
      at_corner("EndsTheSmallestDoubleBelowTheFace", fall(0.25, 0.25, 1, -smallest),
                {{1 - kRounded, 1 - kRounded}}, kRounded),

      at_corner("RestsOnTheFace", rest(0.25, 0.25, 0), {{0, 1}}),
      at_corner("RestsOnTheEdge", rest(0.5, 0.5, 0), {{0, 1}}),
      at_corner("RestsOneUnitBesideTheEdge", rest(0.5, above(0.5), 0), {}),
      at_corner("RestsAboveTheFace", rest(0.25, 0.25, smallest), {}),
      vf("AllMoveTogetherInContact", {{1, 1, 0}, {5, -6, 2}}, {{0, 0, 0}, {4, -7, 2}},
         {{4, 0, 0}, {8, -7, 2}}, {{0, 4, 0}, {4, -3, 2}}, {{0, 1}}),
      vf("AllMoveTogetherApart", {{3, 3, 0}, {7, -4, 2}}, {{0, 0, 0}, {4, -7, 2}},
         {{4, 0, 0}, {8, -7, 2}}, {{0, 4, 0}, {4, -3, 2}}, {}),

      // Within the plane of the triangle.
      at_corner("SlidesAcross", {{-1, 0.25, 0}, {1, 0.25, 0}}, {{0.5, 0.875}}),
      at_corner("SlidesAlongTheEdge", {{-1, 0, 0}, {3, 0, 0}}, {{0.25, 0.5}}),
      at_corner("SlidesPastTheCorner", {{0, 2, 0}, {2, 0, 0}}, {}),
      at_corner("SlidesOverTheCorner", {{0, 2, 0}, {2, -2, 0}}, {{0.5, 0.5}}),
      at_corner("SlidesToTheCornerAlone", {{-1, 2, 0}, {1, 0, 0}}, {{0.5, 1}}),
      at_corner("TouchesTheCornerSliding", {{-1, 1, 0}, {1, 1, 0}}, {{0.5, 0.5}}),
      at_corner("SlidesTheSmallestDoubleAbove", {{-1, 0.25, smallest}, {1, 0.25, smallest}}, {}),
      at_corner("LeavesTheFaceSliding", {{0.25, 0.25, 0}, {4.25, 0.25, 0}}, {{0, 0.125}}),
  };
}

std::vector<ImpactCase> degenerate_triangles() {
  const double smallest = kSmallestDouble;
  return {
      vf("SegmentMetAlongItsLine", {{-1, 0, 0}, {3, 0, 0}}, rest(0, 0, 0), rest(1, 0, 0),
         rest(1, 0, 0), {{0.25, 0.5}}),
      vf("SegmentCrossed", {{0.5, -1, 0}, {0.5, 1, 0}}, rest(-1, 0, 0), rest(1, 0, 0),
         rest(0.25, 0, 0), {{0.5, 0.5}}),
      vf("SegmentCrossedAtItsEnd", {{1, -1, 2}, {1, 1, -2}}, rest(-1, 0, 0), rest(1, 0, 0),
         rest(0.25, 0, 0), {{0.5, 0.5}}),
      vf("SegmentPassedAtTheSmallestDouble", {{0.5, -1, smallest}, {0.5, 1, smallest}},
         rest(-1, 0, 0), rest(1, 0, 0), rest(0.25, 0, 0), {}),
      vf("SegmentPassedBeyondItsEnd", {{above(1), -1, 0}, {above(1), 1, 0}}, rest(-1, 0, 0),
         rest(1, 0, 0), rest(0.25, 0, 0), {}),
      vf("PointMet", {{-1, 2, 0}, {1, -2, 0}}, rest(0, 0, 0), rest(0, 0, 0), rest(0, 0, 0),
         {{0.5, 0.5}}),
      vf("PointPassed", {{-1, 2, smallest}, {1, -2, smallest}}, rest(0, 0, 0), rest(0, 0, 0),
         rest(0, 0, 0), {}),
      vf("MovingPointMet", {{-1, 2, 0}, {1, -2, 0}}, {{3, 1, 1}, {-3, -1, -1}},
         {{3, 1, 1}, {-3, -1, -1}}, {{3, 1, 1}, {-3, -1, -1}}, {{0.5, 0.5}}),
      vf("FourPointsAreOne", rest(1, 2, 3), rest(1, 2, 3), rest(1, 2, 3), rest(1, 2, 3), {{0, 1}}),

      // A segment or a point at one end.
      vf("EndsAsASegmentOnTheVertex", fall(0.5, 0, 1, 0), rest(0, 0, 0), rest(1, 0, 0),
         {{0, 1, 0}, {0.25, 0, 0}}, {{1, 1}}),
      vf("EndsAsASegmentBesideTheVertex", fall(above(1), 0, 1, 0), rest(0, 0, 0), rest(1, 0, 0),
         {{0, 1, 0}, {0.25, 0, 0}}, {}),
      vf("EndsAsAPointOnTheVertex", fall(0, 0, 1, 0), rest(0, 0, 0), {{1, 0, 0}, {0, 0, 0}},
         {{0, 1, 0}, {0, 0, 0}}, {{1, 1}}),
      vf("EndsAsAPointBesideTheVertex", fall(smallest, 0, 1, 0), rest(0, 0, 0),
         {{1, 0, 0}, {0, 0, 0}}, {{0, 1, 0}, {0, 0, 0}}, {}),
      vf("StartsAsASegmentMetAsATriangle", fall(0.25, 0.25, 1, -1), rest(0, 0, 0), rest(1, 0, 0),
         {{0, 0, 0}, {0, 1, 0}}, {{0.5, 0.5}}),

      // A segment or a point at the time of contact alone.
      vf("FlatAtContact", fall(0.5, 0, 1, -1), rest(-1, 0, 0), rest(1, 0, 0),
         {{0, 1, 0}, {0, -1, 0}}, {{0.5, 0.5}}),
      vf("FlatAtContactOfItsEnd", fall(1, 0, 1, -1), rest(-1, 0, 0), rest(1, 0, 0),
         {{0, 1, 0}, {0, -1, 0}}, {{0.5, 0.5}}),
      vf("FlatBesideTheVertex", fall(1.5, 0, 1, -1), rest(-1, 0, 0), rest(1, 0, 0),
         {{0, 1, 0}, {0, -1, 0}}, {}),
      vf("FlatAtAThird", fall(0.5, 0, 1, -2), rest(-1, 0, 0), rest(1, 0, 0),
         {{0, 1, 0}, {0, -2, 0}}, {{kThird, kThird}}, kRounded),
      vf("FlatAtAThirdBesideTheVertex", fall(above(1), 0, 1, -2), rest(-1, 0, 0), rest(1, 0, 0),
         {{0, 1, 0}, {0, -2, 0}}, {}),
      vf("PointAtContact", fall(0, 0, 1, -1), {{1, 0, 0}, {-1, 0, 0}}, {{0, 1, 0}, {0, -1, 0}},
         {{-1, -1, 0}, {1, 1, 0}}, {{0.5, 0.5}}),
      vf("PointBesideTheVertex", fall(0.25, 0, 1, -1), {{1, 0, 0}, {-1, 0, 0}},
         {{0, 1, 0}, {0, -1, 0}}, {{-1, -1, 0}, {1, 1, 0}}, {}),
      vf("PointAtAThird", fall(0, 0, 1, -2), {{1, 0, 0}, {-2, 0, 0}}, {{0, 1, 0}, {0, -2, 0}},
         {{-1, -1, 0}, {2, 2, 0}}, {{kThird, kThird}}, kRounded),
      vf("PointAtAThirdBesideTheVertex", fall(0x1p-60, 0, 1, -2), {{1, 0, 0}, {-2, 0, 0}},
         {{0, 1, 0}, {0, -2, 0}}, {{-1, -1, 0}, {2, 2, 0}}, {}),
  };
}

std::vector<ImpactCase> edges() {
  const double smallest = kSmallestDouble;
  return {
      ee("EdgesCross", rest(-1, 0, 0), rest(1, 0, 0), fall(0, -1, 1, -1), fall(0, 1, 1, -1),
         {{0.5, 0.5}}),
      ee("EdgesCrossAtAThird", rest(-1, 0, 0), rest(1, 0, 0), fall(0, -1, 1, -2),
         fall(0.5, 1, 1, -2), {{kThird, kThird}}, kRounded),
      ee("EndOfTheFirstEdgeMeetsTheSecond", rest(-1, 0, 0), rest(0, 0, 0), fall(0, -1, 1, -1),
         fall(0, 1, 1, -1), {{0.5, 0.5}}),
      ee("EndOfTheFirstEdgePassesTheSecond", rest(-1, 0, 0), rest(-smallest, 0, 0),
         fall(0, -1, 1, -1), fall(0, 1, 1, -1), {}),
      ee("EndOfTheSecondEdgeMeetsTheFirst", rest(-1, 0, 0), rest(1, 0, 0), fall(0.5, 0, 1, -1),
         fall(0.5, 1, 1, -1), {{0.5, 0.5}}),
      ee("EndOfTheSecondEdgePassesTheFirst", rest(-1, 0, 0), rest(1, 0, 0),
         fall(0.5, smallest, 1, -1), fall(0.5, 1, 1, -1), {}),
      ee("EndsMeet", rest(-1, 0, 0), rest(1, 0, 0), fall(1, 0, 1, -1), fall(2, 1, 1, -1),
         {{0.5, 0.5}}),
      ee("EndsPass", rest(-1, 0, 0), rest(1, 0, 0), fall(above(1), 0, 1, -1), fall(2, 1, 1, -1),
         {}),
      ee("EdgesStartTouching", rest(-1, 0, 0), rest(1, 0, 0), fall(1, 0, 0, -1), fall(1, 1, 0, -1),
         {{0, 0}}),
      ee("EdgesEndTouching", rest(-1, 0, 0), rest(1, 0, 0), fall(0, -1, 1, 0), fall(0, 1, 1, 0),
         {{1, 1}}),
      ee("EdgesEndBeforeTheyTouch", rest(-1, 0, 0), rest(1, 0, 0), fall(0, -1, 1, smallest),
         fall(0, 1, 1, smallest), {}),
      ee("EdgesRestInContact", rest(-1, 0, 0), rest(1, 0, 0), rest(0, -1, 0), rest(0, 1, 0),
         {{0, 1}}),
      ee("EdgesRestApart", rest(-1, 0, 0), rest(1, 0, 0), rest(0, -1, smallest),
         rest(0, 1, smallest), {}),

      ee("ParallelEdgesMeet", rest(0, 0, 0), rest(2, 0, 0), {{1, 1, 0}, {1, -1, 0}},
         {{3, 1, 0}, {3, -1, 0}}, {{0.5, 0.5}}),
      ee("ParallelEdgesMeetAtTheirEnds", rest(0, 0, 0), rest(2, 0, 0), {{2, 1, 0}, {2, -1, 0}},
         {{4, 1, 0}, {4, -1, 0}}, {{0.5, 0.5}}),
      ee("ParallelEdgesPass", rest(0, 0, 0), rest(2, 0, 0), {{above(2), 1, 0}, {above(2), -1, 0}},
         {{4, 1, 0}, {4, -1, 0}}, {}),
      ee("ParallelEdgesPassAtTheSmallestDouble", rest(0, 0, 0), rest(2, 0, 0),
         {{1, 1, smallest}, {1, -1, smallest}}, {{3, 1, smallest}, {3, -1, smallest}}, {}),
      ee("ParallelEdgeInsideTheOther", rest(0, 0, 0), rest(8, 0, 0), {{3, 1, 2}, {3, -1, -2}},
         {{5, 1, 2}, {5, -1, -2}}, {{0.5, 0.5}}),
      ee("OppositeEdgesMeet", rest(0, 0, 0), rest(2, 0, 0), {{3, 1, 0}, {3, -1, 0}},
         {{1, 1, 0}, {1, -1, 0}}, {{0.5, 0.5}}),
      ee("ParallelAtContactAlone", rest(-1, 0, 0), rest(1, 0, 0), {{0, -1, 1}, {0, 1, -1}},
         {{2, 1, 1}, {2, -1, -1}}, {{0.5, 0.5}}),
      ee("ParallelApartAtTheRoot", rest(-1, 0, 0), rest(1, 0, 0), {{2, -1, 1}, {2, 1, -1}},
         {{4, 1, 1}, {4, -1, -1}}, {}),
      ee("ParallelAtAThird", rest(-1, 0, 0), rest(1, 0, 0), {{0, -1, 1}, {0, 2, -2}},
         {{2, 1, 1}, {2, -2, -2}}, {{kThird, kThird}}, kRounded),
      ee("CollinearEdgesSlidePast", rest(0, 0, 0), rest(1, 0, 0), {{-3, 0, 0}, {5, 0, 0}},
         {{-2, 0, 0}, {6, 0, 0}}, {{0.25, 0.5}}),
      ee("CollinearEdgesTouchAtTheEnd", rest(0, 0, 0), rest(1, 0, 0), {{-3, 0, 0}, {-1, 0, 0}},
         {{-2, 0, 0}, {0, 0, 0}}, {{1, 1}}),
      ee("CollinearEdgesOverlapThroughout", rest(0, 0, 0), rest(4, 4, 4), {{1, 1, 1}, {2, 2, 2}},
         {{5, 5, 5}, {8, 8, 8}}, {{0, 1}}),
      ee("CollinearEdgesStayApart", rest(0, 0, 0), rest(1, 2, 3), {{2, 4, 6}, {3, 6, 9}},
         {{5, 10, 15}, {4, 8, 12}}, {}),
      ee("CollinearEdgeTurnsOver", rest(0, 0, 0), rest(1, 0, 0), {{-4, 0, 0}, {4, 0, 0}},
         {{2, 0, 0}, {2, 0, 0}}, {{0, 5.0 / 8}}),

      ee("EdgeAndPoint", rest(-1, 0, 0), rest(1, 0, 0), {{0.5, 1, 2}, {0.5, -1, -2}},
         {{0.5, 1, 2}, {0.5, -1, -2}}, {{0.5, 0.5}}),
      ee("EdgeAndPointBeside", rest(-1, 0, 0), rest(1, 0, 0),
         {{above(1), 1, 2}, {above(1), -1, -2}}, {{above(1), 1, 2}, {above(1), -1, -2}}, {}),
      ee("PointsMeet", {{1, 1, 1}, {-1, -1, -1}}, {{1, 1, 1}, {-1, -1, -1}},
         {{2, -3, 0}, {-2, 3, 0}}, {{2, -3, 0}, {-2, 3, 0}}, {{0.5, 0.5}}),
      ee("PointsPass", {{1, 1, above(1)}, {-1, -1, -1}}, {{1, 1, above(1)}, {-1, -1, -1}},
         {{2, -3, 0}, {-2, 3, 0}}, {{2, -3, 0}, {-2, 3, 0}}, {}),
      ee("EdgeShrinksToAPointAtContact", {{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}},
         fall(0, -1, 1, -1), fall(0, 1, 1, -1), {{0.5, 0.5}}),
      ee("EdgeShrinksToAPointBesideTheOther", {{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}},
         fall(smallest, -1, 1, -1), fall(smallest, 1, 1, -1), {}),
      ee("EdgesShareAnEndThroughout", {{1, 2, 3}, {3, 2, 1}}, {{0, 0, 0}, {5, 5, 5}},
         {{1, 2, 3}, {3, 2, 1}}, {{9, 0, 0}, {0, 0, 9}}, {{0, 1}}),
      ee("CollinearAtOneTimeAlone", {{0, -2, 0}, {0, 2, 0}}, {{1, -1, 0}, {1, 1, 0}},
         rest(-3, 0, 0), rest(0.5, 0, 0), {{0.5, 0.5}}),
  };
}

/// The coplanarity has a double or a triple root, or two that are closer than 2^-41.
std::vector<ImpactCase> close_roots() {
  // The plane z = m x turns about the y axis, and the vertex moves along z = lift, y = 0. With
  // m = x = 3t - 1 the distance is lift - (3t - 1)^2.
  const auto tilting = [](std::string name, double lift, const std::array<Vec3, 3>& corners,
                          Contacts contacts, double y = 0) {
    const auto corner = [&](std::size_t i) {
      const Vec3& p = corners[i];
      return Path{{p.x(), p.y(), -p.x()}, {p.x(), p.y(), 2 * p.x()}};
    };
    return vf(std::move(name), {{-1, y, lift}, {2, y, lift}}, corner(0), corner(1), corner(2),
              std::move(contacts), kRounded);
  };
  const std::array<Vec3, 3> around = {Vec3(-2, -2, 0), Vec3(2, -2, 0), Vec3(0, 2, 0)};
  const std::array<Vec3, 3> right = {Vec3(0, -2, 0), Vec3(0, 2, 0), Vec3(2, 0, 0)};
  const std::array<Vec3, 3> left = {Vec3(0, -2, 0), Vec3(0, 2, 0), Vec3(-2, 0, 0)};
  const std::array<Vec3, 3> narrow = {Vec3(-0x1p-43, -2, 0), Vec3(0x1p-43, -2, 0), Vec3(0, 2, 0)};
  // Half the distance of the roots: 2^-42 / 3, which is less than 2^-43.
  const double lift = 0x1p-84, half = kThird * 0x1p-42;
  const double before = kThird - half, after = kThird + half;
  // The triangle (-1, -1, -1), (1, -1, 1), (0, 1, 0), its x and y times s = 1 - 2t, is met by the
  // vertex (a s, b s, a - s) at a triple root: when the triangle is the segment -1 <= z <= 1.
  const auto triple = [](std::string name, double a, Contacts contacts) {
    return vf(std::move(name), {{a, 5, a - 1}, {-a, -5, a + 1}}, {{-1, -1, -1}, {1, 1, -1}},
              {{1, -1, 1}, {-1, 1, 1}}, {{0, 1, 0}, {0, -1, 0}}, std::move(contacts));
  };
  return {
      tilting("TouchesAndLeaves", 0, around, {{kThird, kThird}}),
      tilting("TouchesAndLeavesAtTheEdge", 0, right, {{kThird, kThird}}),
      tilting("TouchesThePlaneOutside", 0, around, {}, 5),
      tilting("TouchesAlmost", -0x1p-84, around, {}),
      tilting("TwoCloseContacts", lift, around, {{before, before}, {after, after}}),
      tilting("TwoCloseRootsContactAtTheSecond", lift, right, {{after, after}}),
      tilting("TwoCloseRootsContactAtTheFirst", lift, left, {{before, before}}),
      tilting("TwoCloseRootsOnBothSides", lift, narrow, {}),
      tilting("TwoCloseRootsOutside", lift, around, {}, 5),
      triple("TripleRootInContact", 0.5, {{0.5, 0.5}}),
      triple("TripleRootAtTheEnd", 1, {{0.5, 0.5}}),
      triple("TripleRootOutside", above(1), {}),
  };
}

/// All four points stay in one plane, which turns or in which a triangle has close events.
std::vector<ImpactCase> planar() {
  // The triangle above the line y = m x, m = 3t - 1, and the vertex (3t - 1, lift).
  const auto tilting = [](std::string name, double lift, Contacts contacts) {
    return vf(std::move(name), {{-1, lift, 0}, {2, lift, 0}}, {{-2, 2, 0}, {-2, -4, 0}},
              {{2, -2, 0}, {2, 4, 0}}, rest(0, 9, 0), std::move(contacts), kRounded);
  };
  const double half = kThird * 0x1p-42;
  return {
      vf("PlaneTurnsAndTouches", {{-1, 0, 0}, {1, 0, 0}}, rest(0, 0, 0), {{-2, 2, 0}, {-2, -2, 2}},
         {{2, 2, 0}, {2, -2, 2}}, {{0.5, 0.5}}),
      vf("PlaneTurnsBesideTheVertex", {{-1, 0, 0}, {2, 0, 0}}, rest(0, 0, 0),
         {{-2, 2, 0}, {-2, -2, 2}}, {{2, 2, 0}, {2, -2, 2}}, {{kThird, kThird}}, kRounded),
      ee("PlaneTurnsAboutAnEdge", rest(-1, 0, 0), rest(1, 0, 0), {{0, 2, 0}, {0, -2, 2}},
         {{3, 4, 0}, {3, -4, 4}}, {}),
      ee("PlaneTurnsAboutAnEdgeThatIsMet", rest(-1, 0, 0), rest(1, 0, 0), {{-2, 0, 0}, {2, 0, 0}},
         {{3, 4, 0}, {3, -4, 4}}, {{0.25, 0.75}}),
      tilting("TouchesAndLeavesInThePlane", 0, {{kThird, kThird}}),
      tilting("InContactForAMomentInThePlane", 0x1p-84, {{kThird - half, kThird + half}}),
      tilting("TouchesAlmostInThePlane", -0x1p-84, {}),
  };
}

/// The ends of the range of doubles.
std::vector<ImpactCase> extreme_numbers() {
  const double largest = kLargestDouble, smallest = kSmallestDouble;
  const auto scaled_case = [](ImpactCase of, const std::array<int, 3>& exponents) {
    of.query = scaled(of.query, exponents).value();
    return of;
  };
  // A vertex and a triangle, and two edges, in whole numbers.
  const ImpactCase whole_vf =
      vf("VertexTriangle", {{0, 0, 0}, {0, -1, -1}}, {{-1, -1, 1}, {-1, 0, 0}},
         {{1, 0, 0}, {1, 1, -1}}, {{1, 0, -1}, {-1, 0, 0}}, {{0.25, 0.25}});
  const ImpactCase whole_ee = ee("EdgeEdge", {{-1, 1, -1}, {1, 1, 1}}, {{0, 1, 1}, {-1, -1, -1}},
                                 {{1, 1, 1}, {1, -1, 1}}, {{-1, 0, 1}, {0, 0, -1}}, {{0.5, 0.5}});
  std::vector<ImpactCase> result = {
      vf("LargestNumbers", fall(0, 0, largest, -largest), rest(-largest, -largest, 0),
         rest(largest, -largest, 0), rest(0, largest, 0), {{0.5, 0.5}}),
      vf("LargestNumbersAllMove", fall(0, 0, largest, -largest),
         fall(-largest, -largest, -largest, largest), fall(largest, -largest, -largest, largest),
         fall(0, largest, -largest, largest), {{0.5, 0.5}}),
      vf("LargestNumbersOverASmallestOne", fall(0, 0, largest, -largest),
         rest(-largest, -largest, smallest), rest(largest, -largest, smallest),
         rest(0, largest, smallest), {{0.5, 0.5}}),
      vf("OnTheEdgeOfLargestNumbers", fall(0, 0, largest, -largest), rest(0, -largest, 0),
         rest(0, largest, 0), rest(largest, 0, 0), {{0.5, 0.5}}),
      vf("BesideTheEdgeOfLargestNumbers", fall(-smallest, 0, largest, -largest),
         rest(0, -largest, 0), rest(0, largest, 0), rest(largest, 0, 0), {}),
      vf("InsideTheEdgeOfLargestNumbers", fall(smallest, 0, largest, -largest),
         rest(0, -largest, 0), rest(0, largest, 0), rest(largest, 0, 0), {{0.5, 0.5}}),
      ee("EdgesOfLargestNumbers", rest(-largest, 0, 0), rest(largest, 0, 0),
         fall(largest, -largest, largest, -largest), fall(-largest, largest, largest, -largest),
         {{0.5, 0.5}}),
      ee("EdgesOfLargestNumbersPass", rest(-largest, 0, 0), rest(-smallest, 0, 0),
         fall(0, -largest, largest, -largest), fall(0, largest, largest, -largest), {}),
  };
  struct Scale {
    const char* name;
    std::array<int, 3> exponents;
  };
  for (const auto& [name, exponents] :
       {Scale{"Whole", {0, 0, 0}}, Scale{"Subnormal", {-1074, -1074, -1074}},
        Scale{"Huge", {1023, 1023, 1023}}, Scale{"SubnormalXBesideLarge", {-1074, 218, 218}},
        Scale{"SubnormalYBesideLarge", {290, -1070, 290}},
        Scale{"SubnormalZBesideHuge", {300, 300, -1073}},
        Scale{"TinyXBesideLarge", {-1020, 295, 295}}, Scale{"Mixed", {1000, -1000, 0}}})
    for (const ImpactCase* base : {&whole_vf, &whole_ee}) {
      ImpactCase each = scaled_case(*base, exponents);
      each.name += std::string("Of") + name;
      result.push_back(std::move(each));
    }
  return result;
}

Path flat(double x0, double y0, double x1, double y1) { return {{x0, y0, 0}, {x1, y1, 0}}; }

}  // namespace

std::ostream& operator<<(std::ostream& out, const ImpactCase& impact) { return out << impact.name; }

std::vector<ImpactCase> repeated_contacts() {
  constexpr double kFive = 0.5e-5, kFour = 0.5e-4;  // digits
  return {
      vf("ThreeIntervals", flat(0, 2, -3, 0), flat(-8, -2, -3, 3), flat(-49, 50, 41, -33),
         flat(0, 6, 3, -17), {{0.16993, 0.27787}, {0.48082, 0.59708}, {0.74780, 0.89674}}, kFive),
      vf("FourIntervals", flat(-46, -6, -55, 14), flat(-48, -19, -60, 20), flat(-214, 193, 83, -76),
         flat(-1, 188, -97, -274),
         {{0, 0.20044}, {0.31715, 0.43392}, {0.55463, 0.70152}, {0.74401, 1}}, kFive),
      ee("FourIntervalsOfEdges", flat(-26, -11, 25, 10), flat(0, -2, 9, -1), flat(-8, 7, 13, -3),
         flat(3, -3, -9, 0),
         {{0.11111, 0.23717}, {0.44338, 0.46792}, {0.57171, 0.59485}, {0.73278, 0.82609}}, kFive),
      ee("FiveIntervalsOfEdges", flat(-94, -42, -54, 27), flat(18, -41, -415, -148),
         flat(-108, -194, -78, 274), flat(41, 15, -231, -61),
         {{0, 0.19260}, {0.23477, 0.27842}, {0.32072, 0.37430}, {0.41839, 0.51982}, {0.87922, 1}},
         kFive),
      vf("ThreeInstants", rest(0, 0, 0), {{2, 1, -4}, {-9, 3, 3}}, {{3, 5, 3}, {4, 7, -13}},
         {{-1, 0, 1}, {18, -19, 11}}, {{0.02077, 0.02077}, {0.39611, 0.39611}, {0.92742, 0.92742}},
         kFive),
      vf("ThreeOtherInstants", rest(0, 0, 0), {{0, -4, -3}, {-2, -13, 5}}, {{4, 3, 3}, {-4, 2, -6}},
         {{-1, 5, 3}, {2, 3, -4}}, {{0.04875, 0.04875}, {0.40906, 0.40906}, {0.49008, 0.49008}},
         kFive),
      vf("ThreeRationalInstants", {{0, 2, 153932}, {-3, 0, -1280943}},
         {{-8, -2, -5434960}, {-3, 3, 0}}, {{-49, 50, -1428626}, {41, -33, 0}},
         {{0, 6, 0}, {3, -17, 0}}, {{0.25, 0.25}, {0.5, 0.5}, {0.8, 0.8}}, kRounded),
      ee("ThreeInstantsOfEdges", {{3, -3, 0}, {6, 4, 1}}, {{1, -1, -2}, {-2, -11, -1}},
         {{2, -1, -2}, {2, -8, -14}}, {{-4, -4, 2}, {2, -3, 12}},
         {{0.0124, 0.0124}, {0.1657, 0.1657}, {0.6804, 0.6804}}, kFour),
      ee("ThreeRationalInstantsOfEdges", {{-26, -11, 30744013}, {25, 10, -37676430}},
         {{0, -2, -2146695}, {9, -1, 0}}, {{-8, 7, -12372809}, {13, -3, 0}},
         {{3, -3, 0}, {-9, 0, 0}}, {{0.2, 0.2}, {0.45, 0.45}, {0.75, 0.75}}, kRounded),
  };
}

std::vector<ImpactCase> impact_cases() {
  std::vector<ImpactCase> result = repeated_contacts();
  append(result, vertex_and_resting_triangle());
  append(result, degenerate_triangles());
  append(result, edges());
  append(result, close_roots());
  append(result, planar());
  append(result, extreme_numbers());
  return result;
}

std::string wrong_answer(const Impact& answer, const std::vector<ContactTimes>& contacts,
                         double error) {
  if (std::string wrong = inconsistency(answer); !wrong.empty()) return wrong;
  if (answer.contact != !contacts.empty()) return answer.contact ? "spurious" : "missed";
  if (contacts.empty()) return "";
  const double first = contacts.front().first;
  if (answer.starts_in_contact != (first == 0)) return "wrong about t = 0";
  if (answer.earliest > first + error || answer.latest < first - error) return "wrong time";
  return "";
}

}  // namespace contactcheck::test
