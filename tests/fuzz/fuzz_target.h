// What the fuzz targets share.
//
// A target is one function that takes any bytes. libFuzzer calls it with bytes that it makes up
// (preset `fuzz`), replay_main.cpp with those of the corpus (every build). It ends the process when
// a promise is broken; a sanitizer or an exception that nobody documents ends it as well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

/// 0; or kNotForTheCorpus for bytes that are to be left out of the corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace contactcheck::test {

/// libFuzzer's word for an input that shall not be mutated further.
inline constexpr int kNotForTheCorpus = -1;

/// Ends the process with `promise` when it is broken. Not an exception: no target may catch it.
inline void require(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace contactcheck::test
