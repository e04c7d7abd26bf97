#include "core/types/shortest.h"

#include <charconv>

namespace contactcheck {

std::string shortest(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

}  // namespace contactcheck
