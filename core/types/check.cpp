#include "core/types/check.h"

#include <cstdio>
#include <cstdlib>

namespace contactcheck {

void invariant_failed(const char* expression, const char* file, int line,
                      const std::string& message) {
  std::fprintf(stderr, "%s:%d: broken invariant: %s %s\n", file, line, expression, message.c_str());
  std::abort();
}

}  // namespace contactcheck
