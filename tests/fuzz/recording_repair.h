#pragma once

#include <string>

namespace contactcheck::test {

/// The same bytes with the magic, version, size and hashes of a whole recording
/// (fixtures/README.md, "Recordings"), as far as its shapes can be followed: a fuzzer cannot guess
/// a hash, and all that a hash protects would stay untested. @pre at least 40 bytes
std::string repaired_recording(std::string bytes);

}  // namespace contactcheck::test
