// Every check of lifecycle.h, for every detector.
#include "tests/conformance/lifecycle.h"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/conformance/detector_test.h"

namespace contactcheck {
namespace {

using test::LifecycleCheck;
using test::Maker;

using test::Moment;

/// A detector, what it is asked about, and the number of a check.
using Parameter = std::tuple<std::string, Moment, std::size_t>;

const LifecycleCheck& check_of(const Parameter& parameter) {
  return test::lifecycle_checks(std::get<1>(parameter))[std::get<2>(parameter)];
}

class Lifecycle : public ::testing::TestWithParam<Parameter> {};

TEST_P(Lifecycle, ChangesNoAnswer) {
  const auto& [detector, of, number] = GetParam();
  const std::string why = test::absence(detector);
  if (!why.empty()) GTEST_SKIP() << why;
  const LifecycleCheck& check = check_of(GetParam());
  const Maker make = test::maker_of(detector);
  test::expect_as_known(detector, check.name, test::guarded([&] { return check.run(make, of); }));
}

auto every_check(Moment of) {
  return ::testing::Combine(::testing::ValuesIn(test::detector_names(of)), ::testing::Values(of),
                            ::testing::Range(std::size_t{0}, test::lifecycle_checks(of).size()));
}

std::string name_of_test(const ::testing::TestParamInfo<Parameter>& info) {
  return test::test_name(std::get<0>(info.param)) + "__" +
         test::test_name(check_of(info.param).name);
}

INSTANTIATE_TEST_SUITE_P(All, Lifecycle, every_check(Moment::kFrame), name_of_test);
INSTANTIATE_TEST_SUITE_P(Steps, Lifecycle, every_check(Moment::kStep), name_of_test);

}  // namespace
}  // namespace contactcheck
