#include "reference/gate/policy.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "core/types/check.h"
#include "core/types/semantics.h"
#include "reference/scene/catalogue.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::gate {
namespace {

// The policy of one rule "R": `{"rule": "R", ` + rest + `}`, with quotes ' for ".
Policy policy_of(const std::string& rest) {
  std::string rule = "{'rule': 'R', " + rest + "}";
  std::replace(rule.begin(), rule.end(), '\'', '"');
  const test::Scratch scratch;
  return read_policy(
      scratch.write("policy.json", R"({"schema": "contactcheck-policy/1", "id": "p", "title": "t",)"
                                   R"("rules": [)" +
                                       rule + "]}"));
}

TEST(Policy, OfEveryKeyIsRead) {
  const Rule rule = policy_of(
                        "'why': 'because', 'scenes': ['a*', '!ab'], 'detectors': ['d'], "
                        "'measure': 'slowdown', 'question': 'body', 'reference': 'fcl-aabb', "
                        "'part': 'cold', 'at_most': 1.25, 'floor_us': 3.5, 'noise_width': 0.2, "
                        "'noisy': 'fail', 'unjudged': 'fail', 'error': 'pass', "
                        "'refused': 'pass'")
                        .rules.at(0);
  EXPECT_EQ(rule.name, "R");
  EXPECT_EQ(rule.why, "because");
  EXPECT_TRUE(rule.scenes.hold("aa"));
  EXPECT_FALSE(rule.scenes.hold("ab"));
  EXPECT_FALSE(rule.scenes.hold("b"));
  EXPECT_STREQ(rule.measure->name, "slowdown");
  EXPECT_EQ(rule.question, "body");
  EXPECT_EQ(rule.reference, "fcl-aabb");
  EXPECT_EQ(rule.part, "cold");
  EXPECT_EQ(rule.limit, 1.25);
  EXPECT_EQ(rule.floor_us, 3.5);
  EXPECT_EQ(rule.noise_width, 0.2);
  EXPECT_TRUE(rule.noisy_fails);
  EXPECT_TRUE(rule.unjudged_fails);
  EXPECT_FALSE(rule.error_fails);
  EXPECT_FALSE(rule.refused_fails);
  EXPECT_TRUE(needs_baseline(rule));
}

TEST(Policy, ThatSaysNothingLetsNoisePassAndErrorsAndRefusalsFail) {
  const Rule rule =
      policy_of("'scenes': ['*'], 'detectors': ['*'], 'measure': 'missed', 'at_most': 0")
          .rules.at(0);
  EXPECT_FALSE(rule.noisy_fails);
  EXPECT_FALSE(rule.unjudged_fails);
  EXPECT_TRUE(rule.error_fails);
  EXPECT_TRUE(rule.refused_fails);
  EXPECT_EQ(rule.level, "");
  EXPECT_EQ(rule.part, "playback");
  EXPECT_FALSE(needs_baseline(rule));
}

// fixtures/policies/README.md lists them.
TEST(Policy, MayBeAboutTheTimesOfEveryQuestion) {
  for (const Question question : kQuestions) {
    const std::string name = name_of(question);
    const Rule rule = policy_of(
                          "'scenes': ['*'], 'detectors': ['*'], 'measure': 'speedup', "
                          "'question': '" +
                          name + "', 'reference': 'embree', 'at_least': 1")
                          .rules.at(0);
    EXPECT_EQ(rule.question, name);
  }
}

TEST(Policy, TakesAWindowOfSpeedUpsAndRefusesOneWithoutRoom) {
  const auto window = [](const std::string& bounds) {
    return policy_of(
        "'scenes': ['*'], 'detectors': ['embree'], 'measure': 'speedup', 'question': 'triangles', "
        "'reference': 'fcl-aabb', " +
        bounds);
  };
  const Rule rule = window("'at_least': 1, 'at_most': 8").rules.at(0);
  EXPECT_EQ(rule.bound, Bound::kBetween);
  EXPECT_EQ(rule.limit, 1.0);
  EXPECT_EQ(rule.upper, 8.0);
  EXPECT_EQ(window("'at_most': 8").rules.at(0).bound, Bound::kAtMost);
  for (const char* upper : {"2.5", "3"}) {
    try {
      window(std::string("'at_least': 3, 'at_most': ") + upper);
      ADD_FAILURE() << upper;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(std::string("rules[0].at_most is ") + upper +
                                               "; it must be above at_least, which is 3."));
    }
  }
  EXPECT_THROW(policy_of("'scenes': ['*'], 'detectors': ['*'], 'measure': 'missed', "
                         "'at_least': 1, 'at_most': 2"),
               InputError)
      << "of speed-ups alone";
}

TEST(Patterns, StandForNamesWithOptionsToo) {
  const Patterns patterns{{"ffd-*:bounds=safe*", "fcl-[ao]*"}, {"*isa=SSE4"}};
  EXPECT_TRUE(patterns.hold("ffd-aabb:bounds=safe"));
  EXPECT_TRUE(patterns.hold("ffd-aabb:bounds=safe,isa=AVX2"));
  EXPECT_FALSE(patterns.hold("ffd-aabb:bounds=safe,isa=SSE4"));
  EXPECT_FALSE(patterns.hold("ffd-aabb"));
  EXPECT_TRUE(patterns.hold("fcl-obbrss"));
  EXPECT_FALSE(patterns.hold("fcl-collide"));
}

// What is committed can be read, and is found under its id.
TEST(CommittedPolicies, AreRead) {
  std::size_t policies = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(CONTACTCHECK_FIXTURES) + "/policies")) {
    if (entry.path().extension() != ".json") continue;
    const Policy policy = read_policy(entry.path());
    EXPECT_EQ(policy.id, entry.path().stem());
    EXPECT_GT(policy.rules.size(), 3u);
    ++policies;
  }
  EXPECT_GE(policies, 2u);
}

}  // namespace
}  // namespace contactcheck::gate
