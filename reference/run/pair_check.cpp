#include "reference/run/pair_check.h"

#include <algorithm>
#include <thread>

#include "reference/rational/clipping.h"

namespace contactcheck {
namespace {

rational::TriangleCorners corners_of(const Triangle& triangle, const std::vector<Vec3>& vertices) {
  return {vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]};
}

ElementPair pair_of_slot(std::size_t slot) {
  const auto triangle = static_cast<std::uint32_t>(slot);
  return {0, 1, triangle, triangle};
}

}  // namespace

std::uint64_t PairTally::checked() const {
  std::uint64_t sum = 0;
  for (const Kind& kind : kinds) sum += kind.pairs;
  return sum;
}

std::uint64_t PairTally::touching() const {
  std::uint64_t sum = 0;
  for (const Kind& kind : kinds) sum += kind.touching;
  return sum;
}

PairCheck::PairCheck(const RandomPairs& pairs, unsigned threads)
    : pairs_(pairs),
      threads_(threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency())) {}

// Every thread takes each so-manieth pair: kinds differ in what they cost, neighbours in kind.
std::vector<char> PairCheck::touching_pairs(std::size_t count,
                                            const std::vector<std::vector<Vec3>>& vertices) const {
  const std::vector<Triangle>& triangles = pairs_.shape()->mesh.triangles;
  std::vector<char> touching(count, 0);
  const auto judge_from = [&](std::size_t first) {
    for (std::size_t slot = first; slot < count; slot += threads_)
      touching[slot] = rational::triangles_intersect_by_clipping(
          corners_of(triangles[slot], vertices[0]), corners_of(triangles[slot], vertices[1]));
  };
  std::vector<std::jthread> team;
  for (unsigned t = 1; t < threads_; ++t) team.emplace_back(judge_from, t);
  judge_from(0);
  team.clear();  // waits for them
  return touching;
}

void PairCheck::book(const char* kind, std::size_t frame, const ElementPair& pair) {
  ++tally_.oracle_wrong;
  for (const Disagreement& d : tally_.disagreements)
    if (d.kind == kind) return;
  Disagreement d;
  d.level = name_of(Level::kTriangle);
  d.kind = kind;
  d.frame = frame;
  d.pair = pair;
  tally_.disagreements.push_back(std::move(d));
}

void PairCheck::add_frame(std::size_t frame, const std::vector<std::vector<Vec3>>& vertices,
                          const Truth& truth) {
  const std::vector<ElementPair>& told = truth.surface.triangles;
  const std::size_t count = pairs_.pairs_of_frame(frame);
  const std::vector<char> touching = touching_pairs(count, vertices);
  for (std::size_t slot = 0; slot < count; ++slot) {
    PairTally::Kind& kind =
        tally_.kinds[static_cast<std::size_t>(RandomPairs::kind_of(frame, slot))];
    ++kind.pairs;
    kind.touching += touching[slot] != 0;
    if (touching[slot] && !std::binary_search(told.begin(), told.end(), pair_of_slot(slot)))
      book("missed", frame, pair_of_slot(slot));
  }
  for (const ElementPair& pair : told)
    if (pair != pair_of_slot(pair.a) || pair.a >= count || !touching[pair.a])
      book("spurious", frame, pair);
}

}  // namespace contactcheck
