// Whether a sanitizer is at work that allocates in glibc's place and reserves many addresses.
#pragma once

namespace contactcheck::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitizerAllocates = true;
#elif defined(__has_feature)
inline constexpr bool kSanitizerAllocates = __has_feature(address_sanitizer) ||
                                            __has_feature(thread_sanitizer) ||
                                            __has_feature(memory_sanitizer);
#else
inline constexpr bool kSanitizerAllocates = false;
#endif

}  // namespace contactcheck::test
