// Libraries may leave the processor's floating-point state changed (Embree sets flush-to-zero):
// from then on every result of the process is suspect. Checked after every adapter call.
#pragma once

#include <string>

namespace contactcheck::process {

/// Remembers rounding mode, flush-to-zero, denormals-are-zero, precision and which exceptions trap
/// (of SSE and of the x87 unit) at construction. Of the calling thread alone.
class FloatEnvironmentGuard {
 public:
  FloatEnvironmentGuard();
  /// What differs now, as words ("rounding mode", "flush-to-zero", "traps", ...), joined; "" when
  /// nothing does. Restores the remembered state; an exception that is pending does not trap.
  std::string check_and_restore() const;

 private:
  unsigned first_;   ///< watched bits of MXCSR; on other processors the result of fegetround
  unsigned second_;  ///< watched bits of the x87 control word; there, what fegetexcept says
};

}  // namespace contactcheck::process
