// Pairs of bodies, nearest boxes first: the smallest distance in a scene needs few of them.
#pragma once

#include <vector>

#include "core/types/contact_set.h"
#include "core/types/vec3.h"

namespace contactcheck::oracle {

/// Hands out every pair of bodies once, by the distance of their boxes.
class PairsByGap {
 public:
  struct Entry {
    double gap = 0.0;  ///< not above the distance of any two points of the two boxes
    BodyPair pair;
  };

  /// @pre no box is empty
  explicit PairsByGap(const std::vector<Aabb>& boxes);

  bool empty() const { return heap_.empty(); }
  /// @pre not empty()
  const Entry& nearest() const { return heap_.front(); }
  /// @pre not empty()
  void pop();

 private:
  std::vector<Entry> heap_;  // the nearest first
};

}  // namespace contactcheck::oracle
