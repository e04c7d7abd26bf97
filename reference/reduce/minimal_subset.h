// Delta debugging: the fewest items that still show something.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace contactcheck {

/// Numbers of items, ascending; what is asked of a subset. Must answer the same to the same.
using ShowsSubset = std::function<bool(const std::vector<std::size_t>&)>;

/// A subset of `items` that shows and of which no single item can be left out. The same items and
/// answers give the same subset. Where `may_go_on` turns false, the best so far.
/// @pre `items` shows
std::vector<std::size_t> minimal_subset(std::vector<std::size_t> items, const ShowsSubset& shows,
                                        const std::function<bool()>& may_go_on);

}  // namespace contactcheck
