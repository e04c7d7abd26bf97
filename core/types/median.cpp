#include "core/types/median.h"

#include <algorithm>
#include <cstddef>

#include "core/types/check.h"

namespace contactcheck {

double median(std::vector<double> values) {
  CONTACTCHECK_INVARIANT(!values.empty(), "a median of something");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace contactcheck
