// Libraries may leave the processor's floating-point state changed (Embree sets flush-to-zero):
// from then on every result of the process is suspect. Checked after every adapter call.
#pragma once

#include <string>

namespace contactcheck {

/// Remembers rounding mode, flush-to-zero and denormals-are-zero at construction.
class FloatEnvironmentGuard {
 public:
  FloatEnvironmentGuard();
  /// What differs now, as words ("rounding mode", "flush-to-zero", ...), joined; "" when nothing
  /// does. Restores the remembered state.
  std::string check_and_restore() const;

 private:
  int rounding_;
  unsigned control_;
};

}  // namespace contactcheck
