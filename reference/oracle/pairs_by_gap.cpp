#include "reference/oracle/pairs_by_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace contactcheck::oracle {
namespace {

// The computed distance of two boxes exceeds the true one by less than this share.
constexpr double kGapRounding = 1 - 16 * 0x1p-53;

// Rounded down, also where it is subnormal; no square of it overflows.
double box_gap(const Aabb& a, const Aabb& b) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const Vec3 gap = (a.lo - b.hi).cwiseMax(b.lo - a.hi).cwiseMax(0.0).cwiseMin(kLargest);
  return std::max(0.0, std::nextafter(gap.stableNorm() * kGapRounding, -1.0));
}

// Of equal gaps the first bodies first: the answer does not depend on the heap.
bool farther(const PairsByGap::Entry& x, const PairsByGap::Entry& y) {
  return std::tie(x.gap, x.pair.a, x.pair.b) > std::tie(y.gap, y.pair.a, y.pair.b);
}

}  // namespace

PairsByGap::PairsByGap(const std::vector<Aabb>& boxes) {
  for (std::uint32_t a = 0; a < boxes.size(); ++a)
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
      heap_.push_back({box_gap(boxes[a], boxes[b]), {a, b}});
  std::make_heap(heap_.begin(), heap_.end(), farther);
}

void PairsByGap::pop() {
  std::pop_heap(heap_.begin(), heap_.end(), farther);
  heap_.pop_back();
}

}  // namespace contactcheck::oracle
