// What detectors from outside are made to do wrong, and what must come of it.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/reference/plugin/plugin_run.h"

namespace contactcheck::test {

struct PluginFault {
  std::string name;
  std::vector<std::string> pieces;  ///< of the sentence
  std::string status = "error";
  std::vector<std::string> flags = {"--no-timing"};
};

inline void PrintTo(const PluginFault& fault, std::ostream* out) { *out << fault.name; }

/// Limits that a test can wait for, of a call and of memory.
inline const std::vector<std::string> kShortCalls = {"--no-timing", "--call-limit", "1.5"};
inline const std::vector<std::string> kLittleMemory = {"--no-timing", "--memory-limit", "400"};
/// So many frames that one who leaks 16 MiB in each passes the limit early, and would take 3 GiB.
inline const std::vector<std::string> kLeakingLong = {"--no-timing", "--memory-limit", "400",
                                                      "--frames", "200"};

/// The name of a parameterized test.
std::string name_of_test(const testing::TestParamInfo<PluginFault>& test);

/// The row of `detector` has the status and the pieces of `fault`, and that of fcl-aabb, which ran
/// beside it, is as it is without it.
void expect_row_and_nobody_disturbed(PluginRun& run, const std::string& detector,
                                     const PluginFault& fault);

}  // namespace contactcheck::test
