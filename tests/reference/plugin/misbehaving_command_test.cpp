// What a command that misbehaves comes to: a sentence before anything runs, or a row of its own.
#include <gmock/gmock.h>

#include "tests/reference/plugin/plugin_fault.h"
#include "tests/reference/process/is_dead.h"

namespace contactcheck::plugin {
namespace {

using test::kLeakingLong;
using test::kLittleMemory;
using test::kShortCalls;
using test::misbehaving_command;
using test::PluginRun;
using Fault = test::PluginFault;
using testing::HasSubstr;

// ---- when it is greeted: the run is refused -------------------------------------------------

class CommandAtHello : public testing::TestWithParam<Fault> {};

TEST_P(CommandAtHello, IsRefusedWithOneSentence) {
  const PluginRun run({"--detector-cmd", misbehaving_command(GetParam().name)}, GetParam().flags);
  std::vector<std::string> pieces = GetParam().pieces;
  pieces.push_back("command \"");
  pieces.push_back(GetParam().name);
  test::expect_refusal(run, pieces);
}

INSTANTIATE_TEST_SUITE_P(
    All, CommandAtHello,
    testing::Values(
        Fault{"no-answer", {"said nothing for 1.5 s (time limit)"}, "", {"--call-limit", "1.5"}},
        Fault{"ends-at-once", {"the command ended with exit code 3"}},
        Fault{"raises-at-once", {"exit code 1", "ValueError: no such model"}},
        Fault{"garbage", {"where its message \"hello\" was due", "standard error"}},
        Fault{"not-utf8", {"line 1"}},
        Fault{"version-2", {"protocol is \"contactcheck-pipe/2\"", "contactcheck-pipe/1"}},
        Fault{"bad-id", {"id is \"a:b\"", "it must be"}},
        Fault{"built-in-id", {"calls itself \"fcl-aabb\"", "another detector's name"}},
        Fault{"unknown-level", {"semantics.levels[0] is \"voxel\"", "one of body"}},
        Fault{"no-semantics", {"semantics is missing"}},
        Fault{"endless-line", {"a line of more than 1024 KiB"}},
        Fault{"eats-memory-at-once",
              {"more than 400 MiB (memory limit)"},
              "",
              {"--memory-limit", "400"}}),
    test::name_of_test);

TEST(CommandAtHello, ThatIsNotThereIsRefused) {
  test::expect_refusal(PluginRun({"--detector-cmd", "./no-such-command --fast"}),
                       {"command \"./no-such-command --fast\"", "exit code 127", "not found"});
}

TEST(CommandAtHello, TwoOfOneNameAreRefused) {
  test::expect_refusal(PluginRun({"--detector-cmd", misbehaving_command("none"), "--detector-cmd",
                                  misbehaving_command("lies")}),
                       {"lies\" calls itself \"misbehaving\", which is another detector's name; "
                        "change the id that it declares"});
}

// ---- while it works: its row says so, and the others' are as they were ----------------------

class CommandAtWork : public testing::TestWithParam<Fault> {};

TEST_P(CommandAtWork, GetsARowAndDisturbsNobody) {
  PluginRun run({"--detector-cmd", misbehaving_command(GetParam().name), "--detector", "fcl-aabb"},
                GetParam().flags);
  test::expect_row_and_nobody_disturbed(run, "misbehaving", GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    All, CommandAtWork,
    testing::Values(
        Fault{"exits-in-frame", {"frame 2", "the command ended with exit code 0"}},
        Fault{"raises-in-frame", {"frame 2", "ZeroDivisionError: division by zero in a frame"}},
        Fault{"kills-itself", {"frame 2", "ended with signal 9 (Killed)"}},
        Fault{"hangs-in-frame", {"frame 2", "no progress for 1.5 s"}, "error", kShortCalls},
        Fault{"floods", {"frame 2", "a line of more than 1024 KiB"}},
        Fault{"floods-errors", {"frame 2", "more than 64 MiB to standard error"}},
        Fault{"eats-memory", {"frame 2", "more than 400 MiB resident"}, "error", kLittleMemory},
        Fault{"eats-memory-in-a-child", {"frame 2", "more than 400 MiB"}, "error", kLittleMemory},
        Fault{"leaks", {"more than 400 MiB resident"}, "error", kLeakingLong},
        Fault{"closes-its-output", {"frame 2", "closed its standard output"}},
        Fault{"half-a-line", {"frame 2", "ended with exit code 0"}},
        Fault{"exact-later", {"declares another \"exact\" after prepare than before"}},
        Fault{"wrong-message", {"message is \"ready\"; it must be \"done\""}},
        Fault{"talks-too-much", {"message is \"done\"; it must be \"contacts\""}},
        Fault{"reports-an-error", {"frame 2", "the solver did not converge"}},
        Fault{"refuses", {"only convex bodies, please"}, "refused"},
        Fault{"negative-time", {"ms is -1"}},
        Fault{"no-such-body", {"frame 2: the answer names body 9 of 2 bodies"}},
        Fault{"no-such-triangle", {"frame 2: the answer names triangle 1000000"}},
        Fault{"with-itself", {"frame 2: the answer names body \"right\" in contact with itself"}},
        Fault{"counts-disagree", {"lists of 32 bytes together and says 16"}},
        Fault{"too-many", {"triangles is 1e+12", "whole number from 0 to 16777216"}},
        Fault{"half-a-message", {"frame 2", "ended with exit code 0"}},
        Fault{"nan-depth", {"frame 2: the answer holds a depth or normal"}}),
    test::name_of_test);

TEST(CommandAtWork, LiesAreSpuriousAndSilenceIsMissed) {
  PluginRun run({"--detector-cmd", misbehaving_command("lies")});
  EXPECT_EQ(run.outcome().exit_code, 0) << run.outcome().err;
  const auto level = run.row("misbehaving").at("levels").at("triangle");
  EXPECT_EQ(level.at("reported"), 1);
  EXPECT_EQ(level.at("hit").get<int>() + level.at("missed").get<int>(), level.at("truth"));
}

// 40 ms of CPU time a frame. A child that has ended is counted in whole ticks of user and of system
// time, of 10 ms each over all frames.
TEST(CommandAtWork, WorkOfAChildDuringACallIsCpuTime) {
  PluginRun run({"--detector-cmd", misbehaving_command("works-in-a-child")}, {"--processes", "1"});
  const auto row = run.row("misbehaving");
  ASSERT_EQ(row.at("status"), "ok") << row.at("message");
  for (const char* regime : {"playback", "cold"}) {
    const auto& times = row.at("time_ms").at(regime);
    EXPECT_GE(times.at("frame").get<double>(), 39.0) << regime;
    EXPECT_GE(times.at("cpu").get<double>(), 30.0) << regime;
    EXPECT_EQ(times.at("taken"), 0.0) << regime << ": it has waited for the command";
  }
}

TEST(CommandAtWork, MayTakeItsScaleFromTheBodies) {
  PluginRun run({"--detector-cmd", misbehaving_command("scale-later")});
  const auto row = run.row("misbehaving");
  EXPECT_EQ(row.at("status"), "ok") << row.at("message");
  EXPECT_EQ(row.at("semantics").at("scale"), 2.0);
}

TEST(CommandAtWork, OfAnotherNameThanItHadIsAnError) {
  PluginRun run({"--detector-cmd", misbehaving_command("renamed")});
  EXPECT_EQ(run.outcome().exit_code, 3) << run.outcome().err;
  EXPECT_THAT(run.results().at("runs").at(0).at("message").get<std::string>(),
              HasSubstr("when the run began it was \"renamed-"));
}

TEST(CommandAtWork, ThatDoesNotLeaveIsEnded) {
  PluginRun run({"--detector-cmd", misbehaving_command("stays")});
  EXPECT_EQ(run.outcome().exit_code, 0) << run.outcome().err;
  EXPECT_EQ(run.row("misbehaving").at("status"), "ok");
}

TEST(CommandAtWork, ItsChildrenEndWithTheWorker) {
  PluginRun run({"--detector-cmd", misbehaving_command("leaves-a-child")});
  EXPECT_EQ(run.outcome().exit_code, 0) << run.outcome().err;
  const std::string notes = run.row("misbehaving").at("notes").dump();
  const std::size_t number = notes.find("child ");
  ASSERT_NE(number, std::string::npos) << notes;
  EXPECT_TRUE(test::dies(std::atoi(notes.c_str() + number + 6)));
}

}  // namespace
}  // namespace contactcheck::plugin
