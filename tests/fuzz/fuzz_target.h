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
#include <map>
#include <string>

namespace contactcheck::test {

/// libFuzzer's word for an input that shall not be mutated further.
inline constexpr int kNotForTheCorpus = -1;

/// Ends the process with `promise` when it is broken. Not an exception: no target may catch it.
inline void require(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

/// 0; or kNotForTheCorpus for bytes that are to be left out of the corpus.
using FuzzTarget = int (*)(const std::uint8_t* data, std::size_t size);

/// Those that are linked into this program, by name.
inline std::map<std::string, FuzzTarget>& fuzz_targets() {
  static std::map<std::string, FuzzTarget> targets;
  return targets;
}

}  // namespace contactcheck::test

// CONTACTCHECK_FUZZ_TARGET(name) { statements on data and size }, in no namespace. A program has
// one function of libFuzzer's name; the replay has all targets.
#ifdef CONTACTCHECK_REPLAY
#define CONTACTCHECK_FUZZ_TARGET(name)                                       \
  static int fuzz_##name(const std::uint8_t* data, std::size_t size);        \
  static const bool registered_##name =                                      \
      contactcheck::test::fuzz_targets().emplace(#name, fuzz_##name).second; \
  static int fuzz_##name([[maybe_unused]] const std::uint8_t* data, std::size_t size)
#else
#define CONTACTCHECK_FUZZ_TARGET(name) \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
#endif
