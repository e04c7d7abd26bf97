// `contactcheck init`: what it writes runs as it is, by the commands that it prints.
#include <gmock/gmock.h>

#include "tests/reference/cli/program.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using test::contactcheck_program;
using test::Outcome;
using testing::HasSubstr;

class InitCommand : public testing::Test {
 protected:
  std::string folder() const { return (scratch_.folder() / "my own").string(); }

  // What stands after "next:", with C compilers that warn.
  static std::string script(const std::string& out) {
    const std::size_t at = out.find("\nnext:\n");
    return "set -e\ncc() { command cc -Wall -Wextra -Werror \"$@\"; }\n" + out.substr(at + 7);
  }
  void expect_green(const std::string& language) const {
    const Outcome init = contactcheck_program({"init", folder(), "--language", language});
    ASSERT_EQ(init.exit_code, 0) << init.err;
    const Outcome next = test::run_program("/bin/bash", {"-c", script(init.out)});
    EXPECT_EQ(next.exit_code, 0) << next.out << next.err;
    EXPECT_THAT(next.out, HasSubstr("All 2 detectors have no missed and no spurious contacts"));
    EXPECT_THAT(next.out, HasSubstr("gate: green"));
    const std::string workflow =
        test::text_of(fs::path(folder()) / ".github/workflows/contactcheck.yml");
    EXPECT_THAT(workflow, testing::Not(HasSubstr("BUILD")));
    EXPECT_THAT(workflow, testing::Not(HasSubstr("DETECTOR")));
  }

  const test::Scratch scratch_;
};

TEST_F(InitCommand, InPythonRunsAsItIs) { expect_green("python"); }

TEST_F(InitCommand, InCAndCppRunsAsItIs) {
  expect_green("c");
  fs::remove_all(folder());
  expect_green("c++");
}

TEST_F(InitCommand, WritesOverNothing) {
  fs::create_directory(folder());
  EXPECT_EQ(contactcheck_program({"init", folder()}).exit_code, 0) << "it was empty";
  const Outcome again = contactcheck_program({"init", folder()});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_EQ(again.err,
            "contactcheck: \"" + folder() + "\" is there already and is not written over\n");
}

TEST_F(InitCommand, RefusesOtherLanguages) {
  const Outcome outcome = contactcheck_program({"init", folder(), "--language", "cobol"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "contactcheck: --language: \"cobol\" is not one of python, c, c++\n");
  EXPECT_FALSE(fs::exists(folder()));
}

}  // namespace
}  // namespace contactcheck::cli
