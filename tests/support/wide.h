// A floating-point type of 113 bits, for judging doubles in tests.
#pragma once

namespace contactcheck::test {

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Wide;
#else
typedef long double Wide;  // 113 bits on arm64
#endif

inline Wide magnitude(Wide x) { return x < 0 ? -x : x; }

}  // namespace contactcheck::test
