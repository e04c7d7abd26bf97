// From the frame of a few bodies in which a detector errs to the fewest triangles and the simplest
// numbers with which it errs in the same way.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "reference/reduce/candidate.h"

namespace contactcheck::reduce {

// Delta debugging: the fewest items that still show something.

/// Tests a subset, given as ascending indices. Must be deterministic.
using ShowsSubset = std::function<bool(const std::vector<std::size_t>&)>;

/// A subset of `items` that passes and from which no single item can be removed. Deterministic.
/// Returns the best so far if `may_go_on` turns false.
/// @pre `items` shows
std::vector<std::size_t> minimal_subset(std::vector<std::size_t> items, const ShowsSubset& shows,
                                        const std::function<bool()>& may_go_on);

/// True if a candidate still shows the defect. Must be deterministic.
using ShowsCandidate = std::function<bool(const CaseCandidate&)>;

struct Reduction {
  CaseCandidate result;  ///< shows
  std::size_t evaluations = 0;
  /// Nothing smaller or simpler was found; else the budget was used up.
  bool complete = false;
};

/// Tries `cells` (the cells of a disagreement alone), then the pair alone, then ever larger
/// surroundings of it, then the whole meshes, each without a lattice and with its vertices as
/// lattice nodes; leaves out meshes, while more than two are left, and triangles until none can go
/// (delta debugging), then makes numbers simpler, and all again until nothing changes. Triangles
/// keep their dimension. The same input and answers give the same result.
///
/// `shows` is asked `budget` times at most. Nothing when no start shows: then it takes the lattice
/// or the rest shape of the scene. @pre without `pair` the defect has no triangles of its own
std::optional<Reduction> reduce(const CaseCandidate& whole, const std::optional<TrianglePair>& pair,
                                const ShowsCandidate& shows, std::size_t budget,
                                const std::vector<CaseCandidate>& cells = {});

}  // namespace contactcheck::reduce
