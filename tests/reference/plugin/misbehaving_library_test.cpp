// What a library that misbehaves comes to: a sentence before anything runs, or a row of its own.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/reference/plugin/plugin_fault.h"
#include "tests/support/files.h"

namespace contactcheck::plugin {
namespace {

using test::kLeakingLong;
using test::kLittleMemory;
using test::kShortCalls;
using test::misbehaving_library;
using test::PluginRun;
using Fault = test::PluginFault;
using testing::AllOf;
using testing::HasSubstr;

// ---- when it is loaded: the run is refused --------------------------------------------------

class LibraryAtLoad : public testing::TestWithParam<Fault> {};

TEST_P(LibraryAtLoad, IsRefusedWithOneSentence) {
  const test::Environment fault("CONTACTCHECK_PLUGIN_FAULT", GetParam().name);
  const PluginRun run({"--detector", CONTACTCHECK_MISBEHAVING_LIBRARY}, GetParam().flags);
  std::vector<std::string> pieces = GetParam().pieces;
  pieces.push_back("library \"" CONTACTCHECK_MISBEHAVING_LIBRARY "\"");
  test::expect_refusal(run, pieces);
}

INSTANTIATE_TEST_SUITE_P(
    All, LibraryAtLoad,
    testing::Values(
        Fault{"version", {"version 99", "this program speaks versions 1 to 3"}},
        Fault{"size", {"contactcheck_body a size of", "here it has"}},
        Fault{"no-table", {"cannot be used: it gave no table from contactcheck_plugin_entry()"}},
        Fault{"no-function", {"lacks one of its functions"}}, Fault{"no-id", {"has no id"}},
        Fault{"bad-id", {"id is \"two words\"", "it must be"}},
        Fault{"built-in-id", {"\"ffd-lazy\"", "another detector's name"}},
        Fault{"library-id", {"\"fcl-mine\"", "kept for fcl"}},
        Fault{"no-question", {"answers no question"}},
        Fault{"bad-default", {"option fault is \"nonsense\"", "allowed: none, "}},
        Fault{"crash", {"ended in signal 11"}}, Fault{"exit", {"ended in exit code "}},
        Fault{"hang", {"said nothing for 1.5 s (time limit)"}, "", {"--call-limit", "1.5"}},
        Fault{"memory", {"took more than 400 MiB (memory limit)"}, "", {"--memory-limit", "400"}}),
    test::name_of_test);

TEST(LibraryAtLoad, OfNoSuchFileIsRefused) {
  test::expect_refusal(PluginRun({"--detector", "./no-such-library.so"}),
                       {"no-such-library.so\" does not exist"});
}

TEST(LibraryAtLoad, ThatIsAPipeIsRefusedAndNotWaitedFor) {
  const test::Scratch scratch;
  const std::string pipe = (scratch.folder() / "mine.so").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  test::expect_refusal(PluginRun({"--detector", pipe}),
                       {pipe + "\" is a pipe, not a regular file"});
}

TEST(LibraryAtLoad, ThatIsNoLibraryIsRefused) {
  test::expect_refusal(PluginRun({"--detector", CONTACTCHECK_MISBEHAVING_COMMAND}),
                       {"cannot be loaded"});
}

TEST(LibraryAtLoad, ThatIsNoPluginIsRefused) {
  test::expect_refusal(PluginRun({"--detector", CONTACTCHECK_NO_PLUGIN}),
                       {"is no detector: it has no function contactcheck_plugin_entry"});
}

TEST(LibraryAtLoad, UnknownOptionsAndValuesAreRefused) {
  const std::string library = CONTACTCHECK_MISBEHAVING_LIBRARY;
  test::expect_refusal(PluginRun({"--detector", library + ":colour=red"}),
                       {"unknown option \"colour\"", "misbehaving knows fault"});
  test::expect_refusal(PluginRun({"--detector", misbehaving_library("boredom")}),
                       {"option fault is \"boredom\"", "allowed: none"});
}

// ---- while it works: its row says so, and the others' are as they were ----------------------

class LibraryAtWork : public testing::TestWithParam<Fault> {};

TEST_P(LibraryAtWork, GetsARowAndDisturbsNobody) {
  PluginRun run({"--detector", misbehaving_library(GetParam().name), "--detector", "fcl-aabb"},
                GetParam().flags);
  test::expect_row_and_nobody_disturbed(run, "misbehaving:fault=" + GetParam().name, GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    All, LibraryAtWork,
    testing::Values(
        Fault{"create-fails", {"create failed: no licence for this machine"}},
        Fault{"unknown-level", {"declares levels that do not exist"}},
        Fault{"no-question", {"it answers no question"}},
        Fault{"exact-later", {"declares another \"exact\" after prepare than before"}},
        Fault{"nodes-later", {"declares another \"needs_vertices\" after prepare"}},
        Fault{"refuses", {"bodies without a licence"}, "refused"},
        Fault{"crash", {"frame 2", "signal 11"}}, Fault{"exit", {"frame 2", "exit code "}},
        Fault{"hang", {"frame 2", "no progress for 1.5 s"}, "error", kShortCalls},
        Fault{"fails", {"frame 2", "update failed: xxx"}},
        Fault{"strange-status", {"frame 2", "update failed"}},
        Fault{"memory", {"frame 2", "memory limit"}, "error", kLittleMemory},
        Fault{"leaks", {"frame", "phase", "more than 400 MiB resident"}, "error", kLeakingLong},
        Fault{"crash-when-destroyed", {"phase destroy", "signal 11"}},
        Fault{"no-such-body", {"frame 2: the answer names body 7 of 2 bodies"}},
        Fault{"no-such-triangle", {"frame 2: the answer names triangle 1000000"}},
        Fault{"endless-answer", {"frame 2", "memory limit"}, "error", kLittleMemory},
        Fault{"nan-depth", {"frame 2: the answer holds a depth or normal"}},
        Fault{"null-items", {"frame 2"}}),
    test::name_of_test);

// Its times would be those of another answer.
TEST(LibraryAtWork, AnswersThatItDoesNotGiveWhileItIsTimedAreAnError) {
  const test::Scratch scratch;
  const test::Environment folder("CONTACTCHECK_PLUGIN_FOLDER", scratch.folder().string());
  const std::string fault = "lies-in-the-first-process";
  PluginRun run({"--detector", misbehaving_library(fault), "--detector", "fcl-aabb"},
                {"--processes", "1"});
  test::expect_row_and_nobody_disturbed(
      run, "misbehaving:fault=" + fault,
      {fault,
       {"frame 0",
        "it answered 0 pairs of triangles and not the 1 that were judged (while timed)"}});
  EXPECT_FALSE(run.row("misbehaving:fault=" + fault).contains("time_ms"));
  EXPECT_TRUE(run.row("fcl-aabb").contains("time_ms"));
}

TEST(LibraryAtWork, DiesInItsSecondPassAndTheOthersKeepTheirTimes) {
  for (const Fault& fault :
       {Fault{"aborts-in-its-second-pass",
              {"scene tiny, frame 2, phase update: signal 6 (Aborted)"}},
        Fault{"leaves-in-its-second-pass", {"scene tiny, frame 2, phase update: exit code 0"}}}) {
    const test::Scratch scratch;
    const test::Environment folder("CONTACTCHECK_PLUGIN_FOLDER", scratch.folder().string());
    const std::string name = "misbehaving:fault=" + fault.name;
    PluginRun run({"--detector", misbehaving_library(fault.name), "--detector", "fcl-aabb"},
                  {"--processes", "3"});
    test::expect_row_and_nobody_disturbed(run, name, fault);
    EXPECT_FALSE(run.row(name).contains("time_ms")) << fault.name;
    EXPECT_EQ(run.row("fcl-aabb").at("time_ms").at("passes"), 3) << fault.name;
    EXPECT_EQ(test::names_in(scratch.folder()).size(), 4u)
        << fault.name << ": processes of judging, of the first pass and of half the second";
    EXPECT_EQ(run.schema_errors(), "");
  }
}

// 2 ms of work for every frame that it does not remember: in a pass it remembers none.
TEST(LibraryAtWork, GainsNothingByRemembering) {
  for (const std::string fault :
       {"works", "remembers-frames", "remembers-nodes", "remembers-in-a-file"}) {
    PluginRun run({"--detector", misbehaving_library(fault), "--detector", "fcl-aabb"},
                  {"--processes", "2"});
    const auto row = run.row("misbehaving:fault=" + fault);
    ASSERT_EQ(row.at("status"), "ok") << fault << row.at("message");
    EXPECT_EQ(row.at("time_ms").at("passes"), 2) << fault;
    for (const char* regime : {"playback", "cold"})
      for (const char* time : {"frame", "cpu"})
        EXPECT_GE(row.at("time_ms").at(regime).at(time).get<double>(), 2.0)
            << fault << " " << regime << " " << time;
    EXPECT_GE(row.at("time_ms").at("playback").at("first_frame").get<double>(), 2.0) << fault;
  }
}

TEST(LibraryAtWork, WorkInABackgroundThreadIsAnError) {
  const std::string fault = "works-in-a-thread";
  PluginRun run({"--detector", misbehaving_library(fault), "--detector", "fcl-aabb"},
                {"--processes", "1"});
  test::expect_row_and_nobody_disturbed(run, "misbehaving:fault=" + fault,
                                        {fault, {"it has used ", " ms of CPU time ", " of calls"}});
}

TEST(LibraryAtWork, MayTakeItsScaleFromTheBodies) {
  PluginRun run({"--detector", misbehaving_library("scale-later")});
  const auto row = run.row("misbehaving:fault=scale-later");
  EXPECT_EQ(row.at("status"), "ok") << row.at("message");
  EXPECT_EQ(row.at("semantics").at("scale"), 2.0);
}

TEST(LibraryAtWork, LiesAreSpuriousAndSilenceIsMissed) {
  PluginRun run({"--detector", misbehaving_library("lies"), "--detector",
                 misbehaving_library("repeats"), "--detector", "fcl-aabb"});
  EXPECT_EQ(run.outcome().exit_code, 0) << run.outcome().err;
  const auto truth = run.row("fcl-aabb").at("levels").at("triangle").at("truth");
  ASSERT_GT(truth.get<int>(), 1);
  for (const char* name : {"misbehaving:fault=lies", "misbehaving:fault=repeats"}) {
    const auto level = run.row(name).at("levels").at("triangle");
    EXPECT_EQ(level.at("reported"), 1) << "a repeat is no second contact";
    EXPECT_EQ(level.at("missed").get<int>() + level.at("hit").get<int>(), truth);
    EXPECT_EQ(level.at("spurious").get<int>() + level.at("hit").get<int>(), 1);
  }
}

TEST(LibraryAtWork, WhatItPrintsIsANote) {
  PluginRun run({"--detector", misbehaving_library("prints")});
  EXPECT_EQ(run.outcome().exit_code, 0) << run.outcome().err;
  EXPECT_THAT(run.row("misbehaving:fault=prints").at("notes").dump(),
              HasSubstr("garbage on standard output"));
  EXPECT_THAT(run.outcome().out, testing::Not(HasSubstr("\ngarbage"))) << "not among our lines";
  EXPECT_THAT(run.outcome().out,
              HasSubstr("\n  misbehaving:fault=prints: wrote to standard output: "
                        "\"garbage on standard output\"\n"));
}

}  // namespace
}  // namespace contactcheck::plugin
