#include "reference/process/process_mark.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <utility>

namespace contactcheck::process {
namespace {

std::vector<std::string> variables(ProcessMark& mark) {
  std::vector<std::string> out;
  for (char** variable = mark.environment(); *variable != nullptr; ++variable)
    out.push_back(*variable);
  return out;
}

/// The environment of this process, replaced for a while.
class OtherEnvironment {
 public:
  explicit OtherEnvironment(char** other) : before_(std::exchange(environ, other)) {}
  ~OtherEnvironment() { environ = before_; }
  OtherEnvironment(const OtherEnvironment&) = delete;
  OtherEnvironment& operator=(const OtherEnvironment&) = delete;

 private:
  char** before_;
};

TEST(ProcessMark, StandsBesideTheVariablesThatThereAre) {
  std::string word = "SOME=word";
  char* all[] = {word.data(), nullptr};
  const OtherEnvironment environment(all);
  ProcessMark mark;
  const std::vector<std::string> found = variables(mark);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], "SOME=word");
}

// What a library that calls clearenv() leaves behind.
TEST(ProcessMark, IsAllThereIsWithoutAnEnvironment) {
  const OtherEnvironment environment(nullptr);
  ProcessMark mark;
  EXPECT_EQ(variables(mark).size(), 1u);
}

TEST(ProcessMark, IsAddedToThatOfThisProcess) {
  std::string inherited;
  {
    const OtherEnvironment environment(nullptr);
    ProcessMark outer;
    inherited = variables(outer).front();
  }
  char* all[] = {inherited.data(), nullptr};
  const OtherEnvironment environment(all);
  ProcessMark inner;
  ASSERT_EQ(variables(inner).size(), 1u);
  EXPECT_THAT(variables(inner).front(), testing::StartsWith(inherited + " "));
}

}  // namespace
}  // namespace contactcheck::process
