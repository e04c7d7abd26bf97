// What a detector says it did.
#pragma once

#include <cstdint>
#include <string>

namespace contactcheck {

/// A number of things done, by name: "leaves_mapped".
struct Count {
  std::string name;
  std::uint64_t value = 0;
};

}  // namespace contactcheck
