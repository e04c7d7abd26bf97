// Source: Zeller & Hildebrandt, Simplifying and Isolating Failure-Inducing Input, IEEE Transactions
// on Software Engineering 28(2), 2002 (the algorithm ddmin).
#include "reference/reduce/minimal_subset.h"

#include <algorithm>

namespace contactcheck {
namespace {

using Items = std::vector<std::size_t>;

/// Part `part` of `parts` nearly equal ones.
struct Span {
  std::size_t from = 0, to = 0;
};
Span part_of(const Items& items, std::size_t part, std::size_t parts) {
  return {items.size() * part / parts, items.size() * (part + 1) / parts};
}

Items inside(const Items& items, Span span) {
  return {items.begin() + static_cast<std::ptrdiff_t>(span.from),
          items.begin() + static_cast<std::ptrdiff_t>(span.to)};
}

Items outside(const Items& items, Span span) {
  Items out = inside(items, {0, span.from});
  out.insert(out.end(), items.begin() + static_cast<std::ptrdiff_t>(span.to), items.end());
  return out;
}

}  // namespace

Items minimal_subset(Items items, const ShowsSubset& shows,
                     const std::function<bool()>& may_go_on) {
  std::size_t parts = 2;
  const auto take_first = [&](auto&& choose) {
    for (std::size_t p = 0; p < parts && may_go_on(); ++p) {
      Items fewer = choose(items, part_of(items, p, parts));
      if (fewer.empty() || fewer.size() == items.size() || !shows(fewer)) continue;
      items = std::move(fewer);
      return true;
    }
    return false;
  };
  while (items.size() >= 2 && may_go_on()) {
    parts = std::min(parts, items.size());
    if (take_first(inside)) {
      parts = 2;
    } else if (parts > 2 && take_first(outside)) {
      parts = std::max<std::size_t>(parts - 1, 2);
    } else if (parts < items.size()) {
      parts *= 2;
    } else {
      break;
    }
  }
  return items;
}

}  // namespace contactcheck
