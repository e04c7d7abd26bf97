#include "reference/scene/random_pairs.h"

#include <algorithm>
#include <cmath>

#include "core/types/check.h"

namespace contactcheck {
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
  const int apart = random.coin() ? kNearest : random.between(kNearest, kFarthest);
  regime.spacing = std::ldexp(regime.size, apart);
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

}  // namespace contactcheck
