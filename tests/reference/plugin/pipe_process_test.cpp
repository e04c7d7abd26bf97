#include "reference/plugin/pipe_process.h"

#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>

#include "reference/text/shell_word.h"
#include "tests/reference/process/is_dead.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::plugin {
namespace {

using testing::HasSubstr;

std::string complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(PipeProcess, EchoesMoreThanAPipeHolds) {
  PipeProcess process("cat");
  const std::string block(std::size_t{900} << 10, 'x');
  for (int i = 0; i < 8; ++i) {
    process.send(block + "\n");
    EXPECT_EQ(process.receive_line(), block);
  }
  process.send("abc");
  EXPECT_EQ(process.receive(2), "ab");
  EXPECT_EQ(process.receive(1), "c");
}

TEST(PipeProcess, ThatWritesInsteadOfReadingIsNoDeadlock) {
  PipeProcess process("yes");
  const std::string much(std::size_t{64} << 20, 'x');
  EXPECT_EQ(complaint([&] { process.send(much); }),
            "the command wrote more than 1024 KiB that it was not asked for");
}

TEST(PipeProcess, ThatHasEndedIsAnErrorAndNoSignal) {
  PipeProcess process("(exit 7)");
  const std::string much(std::size_t{64} << 20, 'x');
  EXPECT_EQ(complaint([&] { process.send(much); }), "the command ended with exit code 7");
}

TEST(PipeProcess, LastWordsAreTheLastLineOfItsErrors) {
  PipeProcess process("echo first >&2; echo second >&2; exit 1");
  EXPECT_EQ(complaint([&] { process.receive_line(); }),
            "the command ended with exit code 1; its last words: second");
  EXPECT_EQ(process.first_error_line(), "first");
}

TEST(PipeProcess, LastWordsOfPythonSayWhere) {
  PipeProcess process(text::in_shell(CONTACTCHECK_PYTHON3) +
                      " -c \"def answer(): return [][7]\nanswer()\"");
  const std::string said = complaint([&] { process.receive_line(); });
  EXPECT_THAT(said, HasSubstr("IndexError: list index out of range (File \"<string>\", line 1, in "
                              "answer)"));
}

// As Node.js 20 prints it, which is not needed here.
std::string last_words_of(const test::Scratch& scratch, const std::string& errors) {
  PipeProcess process("cat " + text::in_shell(scratch.write("errors", errors).string()) +
                      " >&2; exit 1");
  const std::string said = complaint([&] { process.receive_line(); });
  const std::string begin = "the command ended with exit code 1; its last words: ";
  EXPECT_TRUE(said.starts_with(begin)) << said;
  return said.substr(std::min(begin.size(), said.size()));
}

TEST(PipeProcess, LastWordsOfNodeAreItsErrorAndTheInnermostCall) {
  const test::Scratch scratch;
  const std::string version = "\n\nNode.js v20.20.2\n";
  EXPECT_EQ(last_words_of(scratch,
                          "file:///mine.mjs:7\n  throw new TypeError(\"oops\");\n  ^\n\n"
                          "TypeError: oops\n    at update (file:///mine.mjs:7:9)\n"
                          "    at file:///mine.mjs:9:1" +
                              version),
            "TypeError: oops (update (file:///mine.mjs:7:9))");
  EXPECT_EQ(last_words_of(scratch,
                          "node:internal/loader:1210\n  throw err;\n  ^\n\n"
                          "Error: Cannot find module 'x'\n    at resolve (node:loader:1:2)"
                          " {\n  code: 'MODULE_NOT_FOUND',\n  requireStack: []\n}" +
                              version),
            "Error: Cannot find module 'x' (resolve (node:loader:1:2))");
  EXPECT_EQ(last_words_of(scratch,
                          "[eval]:1\nthrow \"text\"\n^\ntext\n(Use `node --trace-uncaught "
                          "...` to show where the exception was thrown)" +
                              version),
            "text");
  EXPECT_EQ(last_words_of(scratch,
                          "<--- GCs --->\n\nFATAL ERROR: heap limit\n----- stack -----\n"
                          " 1: 0xb80 [node]\n"),
            "FATAL ERROR: heap limit");
}

TEST(PipeProcess, SeesNoDescriptorsButItsThree) {
  PipeProcess process("ls /proc/self/fd | wc -l");
  EXPECT_EQ(std::atoi(process.receive_line().c_str()), 4) << "and the one that ls reads";
}

// 'T' of one that was stopped; 'R', 'S' or 'D' of one that was not.
char state_of(const std::string& process) {
  std::ifstream file("/proc/" + process + "/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  return text.substr(text.rfind(')') + 2, 1)[0];
}

bool becomes(const std::string& process, bool stopped) {
  for (int i = 0; i < 1000; ++i) {
    if ((state_of(process) == 'T') == stopped) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(PipeProcess, IsPausedWithAllOfItsGroup) {
  PipeProcess process("echo $$; sleep 300 & echo $!; while read line; do echo $line; done");
  const std::string shell = process.receive_line(), child = process.receive_line();
  for (int i = 0; i < 3; ++i) {
    process.pause();
    process.pause();
    EXPECT_TRUE(becomes(shell, true) && becomes(child, true));
    if (i == 1) {
      process.resume();
      EXPECT_TRUE(becomes(shell, false) && becomes(child, false));
    }
    process.send("x\n");
    EXPECT_EQ(process.receive_line(), "x");
    EXPECT_TRUE(becomes(child, false));
  }
}

// It must be able to leave by itself. Builtins alone: a shell that is stopped while it starts a
// program waits for that (vfork), and is in another state.
TEST(PipeProcess, EndsPausedAsOtherwise) {
  const test::Scratch scratch;
  const std::string left = (scratch.folder() / "left").string();
  {
    PipeProcess process("echo $$; while read line; do :; done; : >" + text::in_shell(left));
    const std::string shell = process.receive_line();
    process.pause();
    ASSERT_TRUE(becomes(shell, true));
  }
  EXPECT_TRUE(std::filesystem::exists(left));
}

TEST(PipeProcess, EndsWithWhatItHasStarted) {
  int child = 0;
  {
    PipeProcess process("sleep 300 & echo $!; wait");
    child = std::atoi(process.receive_line().c_str());
    ASSERT_GT(child, 0);
    EXPECT_EQ(kill(child, 0), 0);
  }
  EXPECT_TRUE(test::dies(child));
}

// An orphan in a session of its own, in an empty environment.
TEST(PipeProcess, EndsWithWhatHasLeftItsTree) {
  for (const char* then : {"wait; cat", "exit 0"}) {
    int child = 0;
    {
      PipeProcess process(std::string("(env -i setsid sleep 300 >/dev/null 2>&1 & echo $!); ") +
                          then);
      child = std::atoi(process.receive_line().c_str());
      ASSERT_GT(child, 0);
      EXPECT_EQ(kill(child, 0), 0);
    }
    EXPECT_TRUE(test::dies(child)) << then;
  }
}

TEST(PipeProcess, LeavesAloneWhatAnotherHasStarted) {
  PipeProcess other("(setsid sleep 300 >/dev/null 2>&1 & echo $!); cat");
  const int child = std::atoi(other.receive_line().c_str());
  ASSERT_GT(child, 0);
  { PipeProcess process("cat"); }
  EXPECT_FALSE(test::is_dead(child));
}

// Interpreters print much before they name the cause.
TEST(PipeProcess, LastWordsStandBehindMuchElse) {
  PipeProcess process(
      "head -c 200000 /dev/zero | tr '\\0' x >&2; echo >&2; echo cause >&2; exit 1");
  EXPECT_EQ(complaint([&] { process.receive_line(); }),
            "the command ended with exit code 1; its last words: cause");
}

TEST(PipeProcess, ThatAnswersAtOnceKeepsItsLimitsToo) {
  PipeLimits limits;
  limits.errors = std::uint64_t{1} << 20;
  PipeProcess process("while read line; do head -c 65536 /dev/zero >&2; echo $line; done", limits);
  const std::string said = complaint([&] {
    for (int i = 0; i < 2000; ++i) {
      process.send("x\n");
      process.receive_line();
    }
  });
  EXPECT_THAT(said, HasSubstr("more than 1 MiB to standard error"));
}

TEST(PipeProcess, TakesWhatAShellTakes) {
  for (const char* command : {"exec cat", " LC_ALL=C cat", "  cat", "command cat"}) {
    PipeProcess process(command);
    process.send("word\n");
    EXPECT_EQ(process.receive_line(), "word") << command;
  }
}

// What a quoted word contains is no operator: nothing stands between the program and its end.
TEST(PipeProcess, ShellIsGoneWhereItStartsOneProgram) {
  for (const char* command : {"sh -c 'kill -9 $$; cat \"(1)\"'", R"(sh -c "kill -9 \$\$; cat")"}) {
    PipeProcess process(command);
    EXPECT_EQ(complaint([&] { process.receive_line(); }),
              "the command ended with signal 9 (Killed)")
        << command;
  }
}

}  // namespace
}  // namespace contactcheck::plugin
