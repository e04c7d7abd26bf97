#include "reference/scene/random_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "core/types/check.h"

namespace contactcheck::scene {
namespace {

using Corners = std::array<Vec3, 3>;

// In one fixed order, whatever Eigen does.
double dot(const Vec3& a, const Vec3& b) { return a.x() * b.x() + a.y() * b.y() + a.z() * b.z(); }
Vec3 unit(const Vec3& v) { return v / std::sqrt(dot(v, v)); }

Vec3 nudged(Vec3 point, PairRandom& random) {
  for (int k = 0; k < 3; ++k) {
    const int ulps = random.between(-2, 2);
    const double end = std::copysign(std::numeric_limits<double>::infinity(), ulps);
    for (int i = 0; i < std::abs(ulps); ++i) point[k] = std::nextafter(point[k], end);
  }
  return point;
}

/// A proper triangle with its directions, as they come out in double.
struct Base {
  explicit Base(const Corners& corners)
      : t(corners), e1(t[1] - t[0]), e2(t[2] - t[0]), along(unit(e1)), normal(unit(e1.cross(e2))) {
    outward = along.cross(normal);
  }
  Vec3 at(double s, double r) const { return t[0] + s * e1 + r * e2; }

  Corners t;
  Vec3 e1, e2, along, normal;
  Vec3 outward;  // in the plane, off the edge from the first to the second corner
};

class PairMaker {
 public:
  PairMaker(const PairPlace& place, PairRandom& random) : place_(place), random_(random) {}

  HardPair make(PairKind kind) {
    HardPair pair = made(kind);
    shuffle(pair.a);
    shuffle(pair.b);
    if (random_.coin()) std::swap(pair.a, pair.b);
    return pair;
  }

 private:
  HardPair made(PairKind kind) {
    switch (kind) {
      case PairKind::kVertexFace:
        return vertex_face(place_.size);
      case PairKind::kVertexEdge:
        return vertex_edge(place_.size);
      case PairKind::kEdgeEdge:
        return edge_edge(place_.size);
      case PairKind::kVertexVertex:
        return vertex_vertex();
      case PairKind::kSharedEdge:
        return shared_edge();
      case PairKind::kNearCoplanar:
        return near_coplanar();
      case PairKind::kCoplanar:
        return coplanar();
      case PairKind::kSliver:
        return across_edge(false);
      case PairKind::kSegment:
        return segment();
      case PairKind::kPoint:
        return point();
      case PairKind::kMixedScale:
        return mixed_scale();
    }
    CONTACTCHECK_INVARIANT(false, "every kind is made above");
    return {};
  }

  void shuffle(Corners& t) {
    const int turn = random_.below(3);
    if (turn == 1) t = {t[1], t[2], t[0]};
    if (turn == 2) t = {t[2], t[0], t[1]};
    if (random_.coin()) std::swap(t[1], t[2]);
  }

  Vec3 placed(const Vec3& local) const { return place_.center + place_.size * local; }

  Vec3 cube() {
    const double x = random_.between(-1.0, 1.0), y = random_.between(-1.0, 1.0);
    return {x, y, random_.between(-1.0, 1.0)};
  }
  Vec3 whole(int most) {
    const double x = random_.between(-most, most), y = random_.between(-most, most);
    return {x, y, static_cast<double>(random_.between(-most, most))};
  }

  // Half of them anywhere; half with coordinates of few bits, and half of those in a plane across
  // an axis: there, much is exact that is rounded elsewhere.
  Base base() {
    const bool coarse = random_.coin(), flat = coarse && random_.coin();
    const int axis = random_.below(3);
    Corners local;
    Vec3 area = Vec3::Zero();
    while (dot(area, area) < 0.1) {
      for (Vec3& p : local) p = coarse ? Vec3(whole(16) / 16.0) : cube();
      for (Vec3& p : local)
        if (flat) p[axis] = local[0][axis];
      area = (local[1] - local[0]).cross(local[2] - local[0]);
    }
    return Base({placed(local[0]), placed(local[1]), placed(local[2])});
  }

  // Strictly between 0 and 1; half of them eighths.
  double share() {
    return random_.coin() ? random_.between(1, 7) / 8.0 : random_.between(0.05, 0.95);
  }
  Vec3 on_face(const Base& base) {
    const double s = share();
    return base.at(s, share() * (1.0 - s));
  }

  Vec3 near(const Vec3& target) { return random_.coin() ? target : nudged(target, random_); }

  // To the side of a unit vector: at least a quarter along it.
  Vec3 away(const Vec3& direction) {
    const Vec3 free = cube();
    return free + (random_.between(0.25, 1.0) - dot(free, direction)) * direction;
  }

  HardPair vertex_face(double size) {
    const Base base = this->base();
    const Vec3 target = on_face(base), side = random_.coin() ? base.normal : Vec3(-base.normal);
    const Vec3 tip = near(target), left = target + size * away(side);
    return {base.t, {tip, left, target + size * away(side)}};
  }

  // The corner's two edges leave on different sides of the plane, both outward.
  HardPair vertex_edge(double size) {
    const Base base = this->base();
    const Vec3 target = base.at(share(), 0.0);
    Corners t = {near(target), target, target};
    for (int i = 1; i <= 2; ++i) {
      const double slant = random_.between(-1.0, 1.0), out = random_.between(0.25, 1.0),
                   up = random_.between(0.25, 1.0) * (i == 1 ? 1.0 : -1.0);
      t[static_cast<std::size_t>(i)] +=
          size * (slant * base.along + out * base.outward + up * base.normal);
    }
    return {base.t, t};
  }

  // Through the plane of the base, across its first edge.
  Vec3 crossing_direction(const Base& base) {
    const double slant = random_.between(-0.5, 0.5), out = random_.between(-0.5, 0.5),
                 up = random_.between(0.25, 1.0);
    return slant * base.along + out * base.outward + up * base.normal;
  }

  HardPair edge_edge(double size) {
    const Base base = this->base();
    const Vec3 target = base.at(share(), 0.0), direction = crossing_direction(base);
    // Across both edges; it points off the base.
    const Vec3 gap = unit(base.along.cross(direction));
    const double back = random_.between(0.25, 1.0), forth = random_.between(0.25, 1.0);
    const Vec3 from = near(target - size * back * direction),
               to = near(target + size * forth * direction);
    return {base.t, {from, to, target + size * away(gap)}};
  }

  HardPair vertex_vertex() {
    const Base base = this->base();
    const Vec3 tip = base.t[0], side = unit(-base.e1 - base.e2),
               left = tip + place_.size * away(side);
    return {base.t, {near(tip), left, tip + place_.size * away(side)}};
  }

  // Both corners common, or both moved: one alone would hold the two together.
  HardPair shared_edge() {
    const Base base = this->base();
    Corners t = {base.t[0], base.t[1], base.t[0] + place_.size * away(base.outward)};
    if (random_.coin()) t = {nudged(t[0], random_), nudged(t[1], random_), t[2]};
    return {base.t, t};
  }

  HardPair near_coplanar() {
    const Base base = this->base();
    Corners t;
    for (Vec3& corner : t) {
      const double s = random_.between(-0.5, 1.25);
      corner = near(base.at(s, random_.between(-0.5, 1.25)));
    }
    return {base.t, t};
  }

  /// A plane that holds its grid points without rounding.
  struct Grid {
    Vec3 origin, p, q;  // local
    Vec3 at(int i, int j) const { return origin + i * p + j * q; }
  };
  Grid grid() {
    Grid out{whole(16) / 16.0, Vec3::Zero(), Vec3::Zero()};
    while (out.p.cross(out.q).isZero(0.0)) {
      out.p = whole(4) / 16.0;
      out.q = whole(4) / 16.0;
    }
    return out;
  }
  // Proper, its corners `step` grid lines apart or a multiple of that.
  Corners on_grid(const Grid& grid, int step, int shift_i, int shift_j) {
    int i[3] = {}, j[3] = {};
    while ((i[1] - i[0]) * (j[2] - j[0]) == (i[2] - i[0]) * (j[1] - j[0]))
      for (int c = 0; c < 3; ++c) {
        i[c] = step * random_.between(-2 / step, 2 / step) + shift_i;
        j[c] = step * random_.between(-2 / step, 2 / step) + shift_j;
      }
    return {placed(grid.at(i[0], j[0])), placed(grid.at(i[1], j[1])), placed(grid.at(i[2], j[2]))};
  }

  HardPair coplanar() {
    const Grid plane = grid();
    const Corners t = on_grid(plane, 1, 0, 0);
    const int shift_i = random_.between(-3, 3), shift_j = random_.between(-3, 3);
    return {t, on_grid(plane, 1, shift_i, shift_j)};
  }

  // A segment across an edge of the base, or a sliver along such a segment.
  HardPair across_edge(bool degenerate) {
    const Base base = this->base();
    const Vec3 target = base.at(share(), 0.0), direction = crossing_direction(base);
    const double back = random_.between(0.25, 1.0), forth = random_.between(0.25, 1.0);
    const Vec3 from = near(target - place_.size * back * direction),
               to = near(target + place_.size * forth * direction);
    return {base.t, {from, to, degenerate ? from : nudged(from + share() * (to - from), random_)}};
  }

  HardPair segment() {
    const int variant = random_.below(4);
    if (variant == 0) return across_edge(true);
    if (variant == 1) {
      HardPair pair = vertex_face(place_.size);
      pair.b[2] = pair.b[1];
      return pair;
    }
    HardPair pair = coplanar();
    pair.b[2] = pair.b[random_.coin() ? 0 : 1];
    if (variant == 3) pair.a[2] = pair.a[0];
    return pair;
  }

  // On a corner, an edge or the face: exactly, for sides and halves of a coarse grid.
  HardPair point() {
    const Base base(on_grid(grid(), 2, 0, 0));
    const int where = random_.below(3);
    const Vec3 target = where == 0   ? base.t[0]
                        : where == 1 ? base.at(0.5, 0.0)
                                     : base.at(0.25, 0.5);
    const Vec3 p = near(target);
    return {base.t, {p, p, p}};
  }

  HardPair mixed_scale() {
    const double size = std::ldexp(place_.size, -random_.between(10, 40));
    const int where = random_.below(3);
    return where == 0 ? vertex_face(size) : where == 1 ? vertex_edge(size) : edge_edge(size);
  }

  const PairPlace& place_;
  PairRandom& random_;
};

}  // namespace

const char* name_of(PairKind kind) {
  constexpr const char* kNames[kPairKinds] = {
      "vertex-face", "vertex-edge", "edge-edge", "vertex-vertex", "shared-edge", "near-coplanar",
      "coplanar",    "sliver",      "segment",   "point",         "mixed-scale"};
  return kNames[static_cast<std::size_t>(kind)];
}

HardPair make_hard_pair(PairKind kind, const PairPlace& place, PairRandom& random) {
  return PairMaker(place, random).make(kind);
}

namespace {

// Nodes per axis of the lattice, and triangles: two in every block of three by two nodes, so that
// none is degenerate at rest and all nodes are used.
constexpr std::size_t kLines = 12;
constexpr std::size_t kSlotsX = kLines / 3 * 2, kSlotsY = kLines / 2, kSlotsZ = kLines;
static_assert(RandomPairs::kSlots == kSlotsX * kSlotsY * kSlotsZ);

std::array<std::size_t, 3> place_of(std::size_t slot) {
  return {slot % kSlotsX, slot / kSlotsX % kSlotsY, slot / kSlotsX / kSlotsY};
}

Triangle triangle_of(std::size_t slot) {
  const auto [x, y, z] = place_of(slot);
  const auto node = [&](std::size_t dx, std::size_t dy) {
    return static_cast<std::uint32_t>((z * kLines + 2 * y + dy) * kLines + x / 2 * 3 + dx);
  };
  if (x % 2 == 0) return {node(0, 0), node(1, 0), node(0, 1)};
  return {node(2, 1), node(1, 1), node(2, 0)};
}

std::vector<Triangle> all_triangles() {
  std::vector<Triangle> out;
  for (std::size_t slot = 0; slot < RandomPairs::kSlots; ++slot) out.push_back(triangle_of(slot));
  return out;
}

bool strictly_inside(const Aabb& box, const std::array<Vec3, 3>& corners) {
  return std::all_of(corners.begin(), corners.end(), [&](const Vec3& c) {
    return (box.lo.array() < c.array()).all() && (c.array() < box.hi.array()).all();
  });
}

}  // namespace

/// Powers of two and their multiples by small whole numbers: no sum of them is rounded.
struct RandomPairs::Regime {
  double size = 1.0, spacing = 16.0;
  Vec3 origin = Vec3::Zero();

  Vec3 center(std::size_t slot) const {
    const auto [x, y, z] = place_of(slot);
    // About the origin: coordinates of all exponents, and of both signs in one triangle.
    constexpr std::size_t kMiddleX = kSlotsX / 2, kMiddleY = kSlotsY / 2, kMiddleZ = kSlotsZ / 2;
    const Vec3 steps(static_cast<double>(x) - kMiddleX, static_cast<double>(y) - kMiddleY,
                     static_cast<double>(z) - kMiddleZ);
    return origin + spacing * steps;
  }
  Aabb box(std::size_t slot) const {
    Aabb out;
    out.extend(center(slot) - Vec3::Constant(0.5 * spacing));
    out.extend(center(slot) + Vec3::Constant(0.5 * spacing));
    return out;
  }
};

RandomPairs::RandomPairs(PairSpec spec)
    : spec_(spec), on_nodes_(make_node_shape(kLines * kLines * kLines, all_triangles())) {
  CONTACTCHECK_INVARIANT(spec.count >= 1 && spec.count <= kMostPairs, "a number of pairs");
}

std::size_t RandomPairs::frames() const { return (spec_.count + kSlots - 1) / kSlots; }

std::size_t RandomPairs::pairs_of_frame(std::size_t frame) const {
  return std::min<std::size_t>(kSlots, spec_.count - frame * kSlots);
}

PairKind RandomPairs::kind_of(std::size_t frame, std::size_t slot) {
  return static_cast<PairKind>((frame + slot) % kPairKinds);
}

// Streams with odd numbers belong to frames, with even ones to pairs.
RandomPairs::Regime RandomPairs::regime_of(std::size_t frame) const {
  constexpr int kNearest = 4, kFarthest = 24, kMostSteps = 16, kScales = 30;
  PairRandom random(spec_.seed, 2 * frame + 1);
  Regime regime;
  regime.size = std::ldexp(1.0, random.between(-kScales, kScales));
  const int exponent = random.coin() ? kNearest : random.between(kNearest, kFarthest);
  regime.spacing = std::ldexp(regime.size, exponent);
  for (int k = 0; k < 3; ++k) {
    const double far = std::ldexp(regime.spacing, random.between(0, kMostSteps));
    if (random.coin()) regime.origin[k] = random.coin() ? far : -far;
  }
  return regime;
}

HardPair RandomPairs::pair_in(const Regime& regime, std::size_t frame, std::size_t slot) const {
  const Vec3 center = regime.center(slot);
  if (slot >= pairs_of_frame(frame)) {
    const Vec3 left = center - Vec3::Constant(regime.size),
               right = center + Vec3::Constant(regime.size);
    return {{left, left, left}, {right, right, right}};
  }
  PairRandom random(spec_.seed, 2 * (frame * kSlots + slot));
  HardPair pair = make_hard_pair(kind_of(frame, slot), {center, regime.size}, random);
  const Aabb box = regime.box(slot);
  CONTACTCHECK_INVARIANT(strictly_inside(box, pair.a) && strictly_inside(box, pair.b),
                         "a pair lies in its slot");
  return pair;
}

HardPair RandomPairs::pair(std::size_t frame, std::size_t slot) const {
  return pair_in(regime_of(frame), frame, slot);
}

Aabb RandomPairs::slot_box(std::size_t frame, std::size_t slot) const {
  return regime_of(frame).box(slot);
}

std::vector<std::vector<Vec3>> RandomPairs::nodes(std::size_t frame) const {
  const Regime regime = regime_of(frame);
  std::array<std::vector<Vec3>, 2> vertices;
  for (auto& body : vertices) body.resize(kLines * kLines * kLines);
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    const HardPair pair = pair_in(regime, frame, slot);
    const Triangle corners = triangle_of(slot);
    for (std::size_t c = 0; c < 3; ++c) {
      vertices[0][corners[c]] = pair.a[c];
      vertices[1][corners[c]] = pair.b[c];
    }
  }
  return {on_nodes_.nodes_for(vertices[0]), on_nodes_.nodes_for(vertices[1])};
}

}  // namespace contactcheck::scene
