#pragma once

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <string>

namespace contactcheck::test {

/// Gone, or dead and only waiting for somebody to ask for its status.
inline bool is_dead(int process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  const std::string stat{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t name_end = stat.rfind(')');
  return name_end == std::string::npos || stat.compare(name_end + 2, 1, "Z") == 0;
}

/// Waits for its death, 10 seconds at most.
inline bool dies(int process) {
  for (int i = 0; i < 1000 && !is_dead(process); ++i) usleep(10'000);
  return is_dead(process);
}

}  // namespace contactcheck::test
