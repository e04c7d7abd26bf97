#include "reference/queries/query_families.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <utility>

#include "core/types/check.h"
#include "reference/scene/split_mix.h"

namespace contactcheck::queries {
namespace {

using Queries = std::vector<ImpactQuery>;

constexpr ImpactKind kVertexFace = ImpactKind::vertex_triangle, kEdgeEdge = ImpactKind::edge_edge;
/// Queries of a value where they are drawn.
constexpr std::size_t kDrawn = 100;

/// Numbers for one value of one family.
class Draw {
 public:
  Draw(std::uint64_t family, double value)
      : mix_(scene::SplitMix64::mixed(scene::SplitMix64::mixed(family) +
                                      std::bit_cast<std::uint64_t>(value))) {}

  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(mix_.bits() >> 11) * 0x1p-53);
  }

  /// A rotation up to rounding: three reflections at drawn planes. (Two would be a rotation;
  /// whether a mirror image is judged makes no difference to anything here.)
  std::array<Vec3, 3> axes() {
    std::array<Vec3, 3> out = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    for (int i = 0; i < 3; ++i) {
      const Vec3 normal(between(-1, 1), between(-1, 1), between(0.1, 1));
      const double squared = normal.squaredNorm();
      for (Vec3& axis : out) axis -= normal * (2 * normal.dot(axis) / squared);
    }
    return out;
  }

 private:
  scene::SplitMix64 mix_;
};

/// A query in a drawn position: its points are combinations of three drawn axes, moved by `offset`.
ImpactQuery placed(const ImpactQuery& query, Draw& draw, double offset) {
  const std::array<Vec3, 3> axes = draw.axes();
  const Vec3 origin =
      offset * Vec3(draw.between(0.5, 1), draw.between(0.5, 1), draw.between(0.5, 1));
  ImpactQuery out{query.kind, {}, {}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto at = [&](const Vec3& p) -> Vec3 {
      return origin + p.x() * axes[0] + p.y() * axes[1] + p.z() * axes[2];
    };
    out.start[i] = at(query.start[i]);
    out.end[i] = at(query.end[i]);
  }
  return out;
}

/// The vertex (or the first edge) goes from height `above` to `below` along z, over elements of
/// edge length e in the plane z = 0, at the place (x, y) of theirs; they meet where x, y >= 0 and
/// x + y <= 1 (faces), or |x|, |y| <= 1/2 (edges).
ImpactQuery falling(ImpactKind kind, double e, double x, double y, double above, double below) {
  ImpactQuery query{kind, {}, {}};
  if (kind == kVertexFace) {
    query.start = query.end = {Vec3(x * e, y * e, 0), Vec3(0, 0, 0), Vec3(e, 0, 0), Vec3(0, e, 0)};
    query.start[0].z() = above;
    query.end[0].z() = below;
    return query;
  }
  const double half = 0.5 * e;
  query.start = query.end = {Vec3(x * e, -half - y * e, 0), Vec3(x * e, half - y * e, 0),
                             Vec3(-half, 0, 0), Vec3(half, 0, 0)};
  for (std::size_t i = 0; i < 2; ++i) {
    query.start[i].z() = above;
    query.end[i].z() = below;
  }
  return query;
}

/// A place at which falling elements meet, well inside.
std::array<double, 2> inside(ImpactKind kind, Draw& draw) {
  if (kind == kEdgeEdge) return {draw.between(-0.4, 0.4), draw.between(-0.4, 0.4)};
  const double x = draw.between(0.1, 0.8);
  return {x, draw.between(0.1, 0.9 - x)};
}

/// A place outside by `gap` edges, beside one end or edge.
std::array<double, 2> outside(ImpactKind kind, Draw& draw, double gap) {
  return kind == kEdgeEdge ? std::array{0.5 + gap, draw.between(-0.4, 0.4)}
                           : std::array{draw.between(0.1, 0.9), -gap};
}

/// `count` queries of drawn positions, each made by `make(draw)`.
template <typename Make>
Queries drawn(std::uint64_t family, double value, double offset, const Make& make) {
  Draw draw(family, value);
  Queries out;
  for (std::size_t i = 0; i < kDrawn; ++i) out.push_back(placed(make(draw), draw, offset));
  return out;
}

/// The same along the axes, without rounding.
template <typename Make>
Queries straight(std::uint64_t family, double value, const Make& make) {
  Draw draw(family, value);
  Queries out;
  for (std::size_t i = 0; i < kDrawn; ++i) out.push_back(make(draw));
  return out;
}

std::vector<double> powers_of_ten(int from, int to, int by = 1) {
  std::vector<double> out;
  for (int exponent = from; by > 0 ? exponent <= to : exponent >= to; exponent += by) {
    double value = 1;
    for (int i = 0; i < std::abs(exponent); ++i) value *= 10;
    out.push_back(exponent < 0 ? 1 / value : value);
  }
  return out;
}

/// Both kinds of a family whose queries fall.
template <typename Make>
void add_falling(std::vector<QueryFamily>& all, const std::string& name, const std::string& verb,
                 const std::string& manner, const std::string& parameter,
                 const std::vector<double>& values, const Make& make) {
  for (const ImpactKind kind : {kVertexFace, kEdgeEdge}) {
    const std::uint64_t number = all.size();
    const bool faces = kind == kVertexFace;
    all.push_back(
        {name + (faces ? "-vf" : "-ee"),
         (faces ? "a vertex " : "an edge ") + verb + (faces ? " a triangle" : " an edge") + manner,
         parameter, values, kind, [=](double value) { return make(kind, number, value); }});
  }
}

/// A query of whole numbers times `unit`: x,y,z of its four points at t = 0, then at t = 1.
ImpactQuery whole(ImpactKind kind, const std::string& numbers, double unit) {
  ImpactQuery query{kind, {}, {}};
  std::istringstream in(numbers);
  for (std::array<Vec3, 4>* places : {&query.start, &query.end})
    for (Vec3& place : *places)
      for (int axis = 0; axis < 3; ++axis) {
        char comma = 0;
        in >> place[axis];
        if (axis < 2) in >> comma;
        place[axis] *= unit;
      }
  CONTACTCHECK_INVARIANT(in && (in >> std::ws).eof(), numbers);
  return query;
}

/// A family of such queries, at four sizes.
void add_whole(std::vector<QueryFamily>& all, const std::string& id, const std::string& title,
               ImpactKind kind, const std::vector<std::string>& queries) {
  all.push_back(
      {id, title, "unit, m", {1, 0x1p-7, 0x1p-14, 0x1p-20}, kind, [kind, queries](double unit) {
         Queries out;
         for (const std::string& numbers : queries) out.push_back(whole(kind, numbers, unit));
         return out;
       }});
}

std::vector<QueryFamily> make_families() {
  std::vector<QueryFamily> all;
  const std::vector<double> lengths = powers_of_ten(1, -6, -1);

  add_falling(all, "crossing", "crosses", " at one edge length a step", "edge length, m", lengths,
              [](ImpactKind kind, std::uint64_t family, double e) {
                return drawn(family, e, 0, [&](Draw& draw) {
                  const auto [x, y] = inside(kind, draw);
                  const double above = draw.between(0.1, 0.9) * e;
                  return falling(kind, e, x, y, above, above - e);
                });
              });
  add_falling(all, "graze", "just touches the end or edge of", "", "edge length, m", lengths,
              [](ImpactKind kind, std::uint64_t family, double e) {
                // Rounding decides on which side; the oracle says so.
                return drawn(family, e, 0, [&](Draw& draw) {
                  const auto [x, y] = outside(kind, draw, 0);
                  return falling(kind, e, x, y, 0.5 * e, -0.5 * e);
                });
              });
  add_falling(all, "near-miss", "passes 1e-6 edges beside", "", "edge length, m", lengths,
              [](ImpactKind kind, std::uint64_t family, double e) {
                return drawn(family, e, 0, [&](Draw& draw) {
                  const auto [x, y] = outside(kind, draw, 1e-6);
                  return falling(kind, e, x, y, 0.5 * e, -0.5 * e);
                });
              });
  add_falling(all, "gap", "passes beside", " of 10 cm", "gap, edges", powers_of_ten(-1, -16, -3),
              [](ImpactKind kind, std::uint64_t family, double gap) {
                return drawn(family, gap, 0, [&](Draw& draw) {
                  const auto [x, y] = outside(kind, draw, gap);
                  return falling(kind, 0.1, x, y, 0.05, -0.05);
                });
              });
  add_falling(all, "speed", "crosses", " of 10 cm", "motion, edges a step", powers_of_ten(-3, 1),
              [](ImpactKind kind, std::uint64_t family, double speed) {
                return drawn(family, speed, 0, [&](Draw& draw) {
                  const auto [x, y] = inside(kind, draw);
                  const double motion = 0.1 * speed, above = draw.between(0.1, 0.9) * motion;
                  return falling(kind, 0.1, x, y, above, above - motion);
                });
              });
  add_falling(all, "offset", "crosses", " of 10 cm far from the origin", "offset, m",
              powers_of_ten(0, 6, 2), [](ImpactKind kind, std::uint64_t family, double offset) {
                return drawn(family, offset, offset, [&](Draw& draw) {
                  const auto [x, y] = inside(kind, draw);
                  return falling(kind, 0.1, x, y, 0.05, -0.05);
                });
              });
  add_falling(all, "one-axis", "crosses", " straight along an axis", "edge length, m", lengths,
              [](ImpactKind kind, std::uint64_t family, double e) {
                return straight(family, e, [&](Draw& draw) {
                  const auto [x, y] = inside(kind, draw);
                  return falling(kind, e, x, y, 0.5 * e, -0.5 * e);
                });
              });
  add_falling(all, "leaves", "starts in contact with and leaves", "", "edge length, m", lengths,
              [](ImpactKind kind, std::uint64_t family, double e) {
                return straight(family, e, [&](Draw& draw) {
                  const auto [x, y] = inside(kind, draw);
                  return falling(kind, e, x, y, 0, draw.between(0.1, 1) * e);
                });
              });
  add_falling(all, "arrives", "reaches", " at the end of the step", "edge length, m", lengths,
              [](ImpactKind kind, std::uint64_t family, double e) {
                return straight(family, e, [&](Draw& draw) {
                  const auto [x, y] = inside(kind, draw);
                  return falling(kind, e, x, y, draw.between(0.1, 1) * e, 0);
                });
              });
  add_falling(all, "one-unit", "stops one unit in the last place before, at and behind", "",
              "edge length, m", lengths, [](ImpactKind kind, std::uint64_t family, double e) {
                Draw draw(family, e);
                Queries out;
                for (std::size_t i = 0; i < 30; ++i) {
                  const auto [x, y] = inside(kind, draw);
                  for (const double from : {e, std::nextafter(e, 2 * e)})
                    for (const double to : {0.0, 0x1p-1074, -0x1p-1074, 0x1p-60, -0x1p-60})
                      out.push_back(falling(kind, e, x, y, from, to));
                }
                return out;
              });
  add_falling(all, "exponents", "crosses", " at the ends of the range of doubles", "power of two",
              {-1060, -700, -300, 0, 300, 700, 1020},
              [](ImpactKind kind, std::uint64_t, double exponent) {
                Queries out;
                const double e = std::ldexp(1.0, static_cast<int>(exponent));
                out.push_back(falling(kind, e, 0.25, 0.25, 0.5 * e, -0.5 * e));
                out.push_back(falling(kind, e, 0.75, 0.5, 0.5 * e, -0.5 * e));
                return out;
              });

  // The first four reach the largest number of contacts that one query can have: three in space; in
  // a plane four of a vertex and a triangle, five of two edges.
  add_whole(all, "three-instants-vf", "three contacts in space, of a vertex and a triangle",
            kVertexFace,
            {"0,0,0 2,1,-4 3,5,3 -1,0,1  0,0,0 -9,3,3 4,7,-13 18,-19,11",
             "0,0,0 0,-4,-3 4,3,3 -1,5,3  0,0,0 -2,-13,5 -4,2,-6 2,3,-4"});
  add_whole(all, "three-instants-ee", "three contacts in space, of two edges", kEdgeEdge,
            {"3,-3,0 1,-1,-2 2,-1,-2 -4,-4,2  6,4,1 -2,-11,-1 2,-8,-14 2,-3,12"});
  add_whole(all, "intervals-vf",
            "several intervals of contact in a plane, of a vertex and a triangle", kVertexFace,
            {"0,2,0 -8,-2,0 -49,50,0 0,6,0  -3,0,0 -3,3,0 41,-33,0 3,-17,0",
             "-46,-6,0 -48,-19,0 -214,193,0 -1,188,0  -55,14,0 -60,20,0 83,-76,0 -97,-274,0"});
  add_whole(all, "intervals-ee", "several intervals of contact in a plane, of two edges", kEdgeEdge,
            {"-26,-11,0 0,-2,0 -8,7,0 3,-3,0  25,10,0 9,-1,0 13,-3,0 -9,0,0",
             "-94,-42,0 18,-41,0 -108,-194,0 41,15,0  -54,27,0 -415,-148,0 -78,274,0 -231,-61,0"});
  add_whole(all, "turning-plane", "the plane of all four points turns; one touch at half time",
            kVertexFace, {"-1,0,0 0,0,0 -2,2,0 2,2,0  1,0,0 0,0,0 -2,-2,2 2,-2,2"});
  add_whole(all, "double-root",
            "the determinant touches zero: the triangle turns over as the vertex passes",
            kVertexFace,
            {"1,1,2 0,0,0 4,0,0 0,4,0  1,1,-2 0,0,0 4,0,0 4,-4,0",
             "1,0,2 0,-2,0 4,0,0 0,2,0  1,0,-2 0,2,0 4,0,0 0,-2,0"});
  add_whole(all, "triple-root", "all three factors of the determinant are zero at once",
            kVertexFace,
            {"-2,0,0 0,0,0 0,-2,0 0,0,-2  2,0,0 0,0,0 0,2,0 0,0,2",
             "-2,1,1 0,1,1 0,-1,1 0,1,-1  2,1,1 0,1,1 0,3,1 0,1,3"});
  add_whole(all, "collapses", "the triangle is a segment or a point as the vertex reaches it",
            kVertexFace,
            {"1,0,2 0,0,0 4,0,0 2,2,0  1,0,-2 0,0,0 4,0,0 2,-2,0",
             "0,0,2 2,0,0 0,2,0 -2,-2,0  0,0,-2 -2,0,0 0,-2,0 2,2,0"});
  add_whole(all, "degenerate", "the triangle is a segment or a point all along", kVertexFace,
            {"1,0,1 0,0,0 2,0,0 4,0,0  1,0,-1 0,0,0 2,0,0 4,0,0",
             "1,0,1 1,0,0 1,0,0 1,0,0  1,0,-1 1,0,0 1,0,0 1,0,0",
             "-1,0,0 0,0,0 1,0,0 1,0,0  3,0,0 0,0,0 1,0,0 1,0,0",
             "5,0,1 0,0,0 2,0,0 4,0,0  5,0,-1 0,0,0 2,0,0 4,0,0"});
  add_whole(all, "slides",
            "the vertex stays in the triangle's plane and slides to, along or past it", kVertexFace,
            {"-1,0,0 0,0,0 4,0,0 0,4,0  3,0,0 0,0,0 4,0,0 0,4,0",
             "-1,1,0 0,0,0 4,0,0 0,4,0  7,1,0 0,0,0 4,0,0 0,4,0",
             "-1,-1,0 0,0,0 4,0,0 0,4,0  7,-1,0 0,0,0 4,0,0 0,4,0"});
  add_whole(all, "parallel-edges", "parallel edges that meet, pass or lie on one line", kEdgeEdge,
            {"0,0,1 4,0,1 2,0,0 6,0,0  0,0,-1 4,0,-1 2,0,0 6,0,0",
             "0,0,1 4,0,1 5,0,0 9,0,0  0,0,-1 4,0,-1 5,0,0 9,0,0",
             "0,0,0 1,0,0 3,0,0 4,0,0  4,0,0 5,0,0 3,0,0 4,0,0",
             "0,0,1 4,0,1 0,2,0 4,2,0  0,0,-1 4,0,-1 0,2,0 4,2,0"});
  add_whole(all, "no-motion", "nothing moves: in contact, or apart", kVertexFace,
            {"1,1,0 0,0,0 4,0,0 0,4,0  1,1,0 0,0,0 4,0,0 0,4,0",
             "1,1,1 0,0,0 4,0,0 0,4,0  1,1,1 0,0,0 4,0,0 0,4,0"});
  all.push_back(
      {"rests", "a vertex comes to rest on a level triangle that is not at height 0",
       "edge length, m", powers_of_ten(3, -5, -1), kVertexFace, [number = all.size()](double e) {
         return straight(number, e, [e](Draw& draw) {
           const double floor = e * draw.between(0.001, 0.01);
           const auto [x, y] = inside(kVertexFace, draw);
           ImpactQuery query = falling(kVertexFace, e, x, y, e * draw.between(0.1, 1), floor);
           for (auto* const points : {&query.start, &query.end})
             for (std::size_t i = 1; i < 4; ++i) (*points)[i].z() = floor;
           return query;
         });
       }});
  return all;
}

}  // namespace

const std::vector<QueryFamily>& query_families() {
  static const std::vector<QueryFamily> all = make_families();
  return all;
}

}  // namespace contactcheck::queries
