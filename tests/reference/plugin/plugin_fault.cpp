#include "tests/reference/plugin/plugin_fault.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace contactcheck::test {

std::string name_of_test(const testing::TestParamInfo<PluginFault>& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

void expect_row_and_nobody_disturbed(PluginRun& run, const std::string& detector,
                                     const PluginFault& fault) {
  const auto row = run.row(detector);
  EXPECT_EQ(row.at("status"), fault.status) << row.at("message");
  EXPECT_EQ(run.outcome().exit_code, fault.status == "error" ? 3 : 0) << run.outcome().err;
  for (const std::string& piece : fault.pieces)
    EXPECT_THAT(row.at("message").get<std::string>(), testing::HasSubstr(piece));
  EXPECT_EQ(run.row("fcl-aabb").at("status"), "ok");
  EXPECT_EQ(run.row("fcl-aabb").at("levels").at("triangle").at("missed"), 0);
}

}  // namespace contactcheck::test
