// Every check of lifecycle.h, for every detector.
#include "tests/conformance/lifecycle.h"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/conformance/detector_test.h"

namespace contactcheck {
namespace {

using test::LifecycleCheck;

class Lifecycle : public ::testing::TestWithParam<std::tuple<std::string, std::size_t>> {};

TEST_P(Lifecycle, ChangesNoAnswer) {
  const std::string& detector = std::get<0>(GetParam());
  const LifecycleCheck& check = test::lifecycle_checks()[std::get<1>(GetParam())];
  if (!test::absence(detector).empty()) GTEST_SKIP() << test::absence(detector);
  test::expect_as_known(detector, check.name,
                        test::guarded([&] { return check.run(test::maker_of(detector)); }));
}

INSTANTIATE_TEST_SUITE_P(
    All, Lifecycle,
    ::testing::Combine(::testing::ValuesIn(test::detector_names()),
                       ::testing::Range(std::size_t{0}, test::lifecycle_checks().size())),
    [](const auto& parameter) {
      const LifecycleCheck& check = test::lifecycle_checks()[std::get<1>(parameter.param)];
      return test::test_name(std::get<0>(parameter.param)) + "__" + test::test_name(check.name);
    });

}  // namespace
}  // namespace contactcheck
