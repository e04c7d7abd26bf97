#include "reference/suite/machine.h"

#include <fstream>
#include <string>
#include <thread>

#include "core/deform/mapping.h"

namespace contactcheck::suite {
namespace {

// The value of the first line "KEY<separator>VALUE" of a file.
std::string value_in(const char* file, const std::string& key, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(key, 0) != 0) continue;
    std::string value = line.substr(line.find(separator) + 1);
    const auto begin = value.find_first_not_of(" \t\"");
    const auto end = value.find_last_not_of(" \t\"");
    return begin == std::string::npos ? "" : value.substr(begin, end - begin + 1);
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

results::Machine describe_machine() {
  results::Machine machine;
  machine.cpu = value_in("/proc/cpuinfo", "model name", ':');
  machine.cores = std::thread::hardware_concurrency();
  machine.isa = simd_target();
  machine.os = value_in("/etc/os-release", "PRETTY_NAME", '=');
  machine.compiler = compiler();
  machine.build = CONTACTCHECK_BUILD_TYPE;
  return machine;
}

}  // namespace contactcheck::suite
