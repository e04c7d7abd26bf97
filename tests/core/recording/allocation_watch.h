// The largest single allocation of the program since the last reset, to show that a damaged count
// is refused before it is believed.
#pragma once

#include <cstddef>

namespace contactcheck {

void reset_largest_allocation();
std::size_t largest_allocation();  ///< bytes

}  // namespace contactcheck
