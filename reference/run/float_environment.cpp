#include "reference/run/float_environment.h"

#include <cfenv>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace contactcheck {
namespace {

constexpr unsigned kFlushToZero = 0x8000u, kDenormalsAreZero = 0x0040u, kRounding = 0x6000u;
// Exception masks are not looked at; the sticky exception flags (low six bits) change with every
// inexact operation. Rounding is watched here too: glibc's fegetround reads the x87 unit alone, and
// doubles are computed by SSE.
constexpr unsigned kWatched = kFlushToZero | kDenormalsAreZero | kRounding;

unsigned control_word() {
#if defined(__SSE__)
  return _mm_getcsr() & kWatched;
#else
  return 0;
#endif
}

void set_control_word(unsigned watched) {
#if defined(__SSE__)
  _mm_setcsr((_mm_getcsr() & ~kWatched) | watched);
#else
  (void)watched;
#endif
}

void add(std::string& text, const char* word) {
  if (!text.empty()) text += ", ";
  text += word;
}

}  // namespace

FloatEnvironmentGuard::FloatEnvironmentGuard()
    : rounding_(std::fegetround()), control_(control_word()) {}

std::string FloatEnvironmentGuard::check_and_restore() const {
  std::string changed;
  const unsigned now = control_word();
  if (std::fegetround() != rounding_ || ((now ^ control_) & kRounding))
    add(changed, "rounding mode");
  if ((now ^ control_) & kFlushToZero) add(changed, "flush-to-zero");
  if ((now ^ control_) & kDenormalsAreZero) add(changed, "denormals-are-zero");
  if (!changed.empty()) {
    std::fesetround(rounding_);
    set_control_word(control_);
  }
  return changed;
}

}  // namespace contactcheck
