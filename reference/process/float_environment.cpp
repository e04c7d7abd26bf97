// Two units compute on x86-64: SSE (doubles) and x87 (long double). glibc's fegetround and
// fegetexcept (2.36) read the x87 unit alone, so the control words of both are compared here.
#include "reference/process/float_environment.h"

#include <fenv.h>

#if defined(__x86_64__)
#include <fpu_control.h>
#include <xmmintrin.h>
#define CONTACTCHECK_TWO_UNITS 1
#else
#define CONTACTCHECK_TWO_UNITS 0
#endif

namespace contactcheck::process {
namespace {

// The low six bits of MXCSR are sticky flags: every inexact operation changes them.
constexpr unsigned kFlushToZero = 0x8000u, kDenormalsAreZero = 0x0040u, kRounding = 0x6000u,
                   kMasks = 0x1f80u;
constexpr unsigned kWatched = kFlushToZero | kDenormalsAreZero | kRounding | kMasks;
constexpr unsigned kX87Rounding = 0x0c00u, kX87Precision = 0x0300u, kX87Masks = 0x003fu;
constexpr unsigned kX87Watched = kX87Rounding | kX87Precision | kX87Masks;

struct Changes {
  bool rounding = false, flush = false, denormals = false, precision = false, traps = false;
};

void add(std::string& text, const char* word) {
  if (!text.empty()) text += ", ";
  text += word;
}

std::string words_of(const Changes& c) {
  std::string text;
  if (c.rounding) add(text, "rounding mode");
  if (c.flush) add(text, "flush-to-zero");
  if (c.denormals) add(text, "denormals-are-zero");
  if (c.precision) add(text, "x87 precision");
  if (c.traps) add(text, "traps");
  return text;
}

#if CONTACTCHECK_TWO_UNITS

unsigned sse_word() { return _mm_getcsr() & kWatched; }

unsigned x87_word() {
  fpu_control_t word = 0;
  _FPU_GETCW(word);
  return word & kX87Watched;
}

Changes compare(unsigned sse, unsigned x87) {
  Changes c;
  c.rounding = (sse & kRounding) || (x87 & kX87Rounding);
  c.flush = sse & kFlushToZero;
  c.denormals = sse & kDenormalsAreZero;
  c.precision = x87 & kX87Precision;
  c.traps = (sse & kMasks) || (x87 & kX87Masks);
  return c;
}

void restore(unsigned sse, unsigned x87) {
  // An x87 exception that is pending and no longer masked is raised by the next x87 instruction,
  // loading the control word included.
  __asm__ volatile("fnclex");
  fpu_control_t word = 0;
  _FPU_GETCW(word);
  word = static_cast<fpu_control_t>((word & ~kX87Watched) | x87);
  _FPU_SETCW(word);
  _mm_setcsr((_mm_getcsr() & ~kWatched) | sse);
}

#endif

}  // namespace

#if CONTACTCHECK_TWO_UNITS

FloatEnvironmentGuard::FloatEnvironmentGuard() : first_(sse_word()), second_(x87_word()) {}

std::string FloatEnvironmentGuard::check_and_restore() const {
  const unsigned sse = sse_word() ^ first_, x87 = x87_word() ^ second_;
  if (sse == 0 && x87 == 0) return "";
  restore(first_, second_);
  return words_of(compare(sse, x87));
}

#else

FloatEnvironmentGuard::FloatEnvironmentGuard()
    : first_(static_cast<unsigned>(fegetround())), second_(static_cast<unsigned>(fegetexcept())) {}

std::string FloatEnvironmentGuard::check_and_restore() const {
  const int rounding = static_cast<int>(first_), traps = static_cast<int>(second_);
  Changes c;
  c.rounding = fegetround() != rounding;
  c.traps = fegetexcept() != traps;
  if (c.traps) {
    fedisableexcept(FE_ALL_EXCEPT);
    feenableexcept(traps);
  }
  if (c.rounding) fesetround(rounding);
  return words_of(c);
}

#endif

}  // namespace contactcheck::process
