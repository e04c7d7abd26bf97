// The instruction sets of this machine, one after the other.
#pragma once

#include "core/types/vector_targets.h"

#include <hwy/targets.h>

#include <cstdint>
#include <vector>

namespace contactcheck::test {

// Chooses one instruction set for the time of a scope.
class ScopedTarget {
 public:
  explicit ScopedTarget(std::int64_t target) { choose(target); }
  ~ScopedTarget() { choose(0); }
  ScopedTarget(const ScopedTarget&) = delete;
  ScopedTarget& operator=(const ScopedTarget&) = delete;

 private:
  static void choose(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

inline std::vector<std::int64_t> compiled_targets() {
  std::vector<std::int64_t> out;
  const std::int64_t all = hwy::SupportedTargets() & HWY_TARGETS;
  for (int bit = 0; bit < 63; ++bit)
    if (all & (std::int64_t{1} << bit)) out.push_back(std::int64_t{1} << bit);
  return out;
}

}  // namespace contactcheck::test
