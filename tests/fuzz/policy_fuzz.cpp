// Fuzz target: policies of a gate. Whatever is accepted has rules that can be applied and shown.

#include <string>

#include "core/types/check.h"
#include "reference/gate/policy.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

void check_promises(const gate::Policy& policy) {
  require(!policy.id.empty() && !policy.rules.empty(), "a policy has an id and rules");
  for (const gate::Rule& rule : policy.rules) {
    require(rule.measure != nullptr, "a rule looks at a measure");
    require(gate::find_measure(rule.measure->name) == rule.measure, "a measure has its name");
    require(!gate::allowed_text(rule).empty(), "what a rule allows can be shown");
    require(!rule.scenes.wanted.empty(), "a rule is about scenes");
    rule.scenes.hold("bunny-touch");
    rule.detectors.hold("ffd-aabb-sphere2+tri:bounds=paper");
  }
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(policy) {
  using namespace contactcheck;
  static const test::FuzzedFile file("policy.json");
  test::try_file(file, data, size, [](const std::filesystem::path& path) {
    test::check_promises(gate::read_policy(path));
  });
  return 0;
}
