// The floating-point environment that the oracle's arithmetic was proven for.
#pragma once

#include <cfenv>

namespace contactcheck::oracle {

/// Round to nearest, subnormals kept, no traps; the caller's environment comes back at the end.
/// Some libraries leave flush-to-zero behind (Embree 3.13, seen in 2026), with which CGAL 5.5
/// reports false contacts at scale 1e-104.
class FloatingPointGuard {
 public:
  FloatingPointGuard() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatingPointGuard() { std::fesetenv(&saved_); }
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace contactcheck::oracle
