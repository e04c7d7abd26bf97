// What libraries tell of their work, from their table to results.json; and libraries of version 1,
// which tell nothing.
#include <gmock/gmock.h>

#include "tests/reference/plugin/plugin_run.h"

namespace contactcheck::plugin {
namespace {

using nlohmann::json;
using test::PluginRun;
using testing::AllOf;
using testing::HasSubstr;

std::string staged(const std::string& told) {
  return std::string(CONTACTCHECK_STAGED_LIBRARY) + ":told=" + told;
}

TEST(LibraryThatTells, HasStagesWithTheirLossesAndCounters) {
  PluginRun run({"--detector", CONTACTCHECK_STAGED_LIBRARY});
  EXPECT_EQ(run.schema_errors(), "");
  const json row = run.row("staged");
  ASSERT_EQ(row.at("status"), "ok") << row.at("message");
  const json missed = row.at("levels").at("triangle").at("missed");
  ASSERT_GT(missed, 0);
  ASSERT_LT(missed, row.at("levels").at("triangle").at("truth"));
  ASSERT_EQ(row.at("stages").size(), 2u);
  const json all = row.at("stages")[0], even = row.at("stages")[1];
  EXPECT_EQ(all.at("name"), "everything");
  EXPECT_EQ(all.at("unit"), "body pairs");
  EXPECT_EQ(all.at("missed"), 0);
  EXPECT_EQ(all.at("in"), row.at("frames"));
  EXPECT_FALSE(all.contains("visited"));
  EXPECT_EQ(even.at("missed"), missed);
  EXPECT_EQ(even.at("in"), 2 * even.at("out").get<int>());
  EXPECT_EQ(even.at("visited"), 7 * row.at("frames").get<int>());
  EXPECT_EQ(even.at("visited_unit"), "numbers");
  EXPECT_EQ(row.at("counters"), json({{"pairs_looked_at", even.at("out")}}));
}

TEST(LibraryThatTells, OfCellsIsReadThroughOwnersAndLabels) {
  for (const std::string told : {"owners", "labels"}) {
    PluginRun run({"--detector", staged(told)});
    const json row = run.row("staged:told=" + told);
    ASSERT_EQ(row.at("status"), "ok") << row.at("message");
    EXPECT_EQ(row.at("stages").size(), 2u) << told;
  }
}

TEST(LibraryThatTells, HasAClockOfItsOwnBesideOurs) {
  PluginRun run({"--detector", CONTACTCHECK_STAGED_LIBRARY, "--detector", staged("no-clock")},
                {"--processes", "1"});
  EXPECT_EQ(run.schema_errors(), "");
  for (const char* part : {"playback", "cold"}) {
    EXPECT_EQ(run.row("staged").at("time_ms").at(part).at("self_reported"), 0.5);
    EXPECT_FALSE(run.row("staged:told=no-clock").at("time_ms").at(part).contains("self_reported"))
        << "it did not measure every frame";
  }
  EXPECT_THAT(run.outcome().out, HasSubstr(" (own 0.500)"));
}

struct Told {
  std::string told, sentence;
  std::vector<std::string> flags = {"--no-timing"};
};

TEST(LibraryThatTells, WhatCannotBeSoIsItsError) {
  const std::vector<std::string> timed = {"--processes", "1"};
  for (const Told& t : std::vector<Told>{
           {"trace-fails", "frame 2, phase trace: trace failed: lost the stages"},
           {"no-name", "a stage's name and units must be one line of ASCII"},
           {"two-lines", "a stage's name and units must be one line of ASCII"},
           {"changes", "frame 2, phase trace: trace: the stages or their units are not those"},
           {"many", "gives more than 64 stages"},
           {"wrong-triangle", "stage \"even\" names triangle 1000000 of body \"left\""},
           {"covers-nothing", "stage \"even\" covers what does not exist (99)"},
           {"no-owners", "owners() gave 0 of them for body \"left\""},
           {"wrong-owner", "owners() names cell 1000000 of body \"left\""},
           {"owners-of-nobody", "trace: owners() names body 777 of 2 bodies"},
           {"owners-far-away", "trace: owners() names body 4294967295 of 2 bodies"},
           {"huge-in",
            "stage \"everything\": in is 18446744073709551615; allowed in a frame: up to "
            "10000000000"},
           {"huge-out", "stage \"everything\": out is 18446744073709551615"},
           {"huge-visited", "stage \"even\": visited is 18446744073709551615"},
           {"huge-counter", "counts: pairs_looked_at is 18446744073709551615"},
           {"counter-twice", "counts: gives a counter twice"},
           {"counter-name", "counts: a counter's name must be letters"},
           {"counter-comes", "counts: the counters are not those of the frame before"},
           {"clock-nan", "own_ms gave nan ms", timed},
           {"clock-endless", "own_ms gave inf ms", timed}}) {
    PluginRun run({"--detector", staged(t.told)}, t.flags);
    const json row = run.row("staged:told=" + t.told);
    EXPECT_EQ(row.at("status"), "error") << t.told;
    EXPECT_THAT(row.at("message").get<std::string>(), HasSubstr(t.sentence)) << t.told;
  }
}

TEST(LibraryThatTells, InStructuresOfAnotherSizeIsRefused) {
  const test::Environment size("CONTACTCHECK_STAGE_SIZE", "1");
  test::expect_refusal(PluginRun({"--detector", CONTACTCHECK_STAGED_LIBRARY}),
                       {"gives contactcheck_stage a size of", "here it has"});
}

TEST(LibraryOfVersion1, RunsAsItDid) {
  PluginRun run({"--detector", CONTACTCHECK_VERSION_1_LIBRARY}, {"--processes", "1"});
  const json row = run.row("version-1");
  ASSERT_EQ(row.at("status"), "ok") << row.at("message");
  EXPECT_EQ(row.at("levels").at("triangle").at("reported"), 0);
  EXPECT_EQ(row.at("stages"), json::array());
  EXPECT_FALSE(row.at("time_ms").at("cold").contains("self_reported"));
}

// The list of known defects is one of libraries.
TEST(LibraryThatTells, ErrorOfADetectorFromOutsideIsNoUnknownDefect) {
  PluginRun run({"--detector", staged("many")});
  EXPECT_EQ(run.outcome().exit_code, 3);
  EXPECT_FALSE(run.results().contains("known_defects"));
  EXPECT_THAT(run.outcome().out, testing::Not(HasSubstr("known defects")));
}

// ---- contactcheck list ----------------------------------------------------------------------

TEST(ListOfOwnDetectors, ShowsWhatALibraryDeclares) {
  const test::Outcome list = test::contactcheck_program(
      {"list", "--detector", CONTACTCHECK_STAGED_LIBRARY, "--detector", "fcl-aabb"});
  ASSERT_EQ(list.exit_code, 0) << list.err;
  EXPECT_THAT(list.out, AllOf(HasSubstr("\nstaged\n  tells of its work\n  from        library \""),
                              HasSubstr("  version     2.5\n"),
                              HasSubstr("  claims      triangle\n  questions   triangles\n"),
                              HasSubstr("  given       deformed vertices and lattice nodes\n"),
                              HasSubstr("  options     told=truth\n")));
  EXPECT_THAT(list.out, HasSubstr("\nfcl-aabb\n"));
  EXPECT_THAT(list.out, testing::Not(HasSubstr("Suites")));
  EXPECT_THAT(list.out, testing::Not(HasSubstr("\nembree\n")));
}

TEST(ListOfOwnDetectors, ShowsWhatIsNamedTwiceOnceAndTheOptionsGiven) {
  const test::Outcome list = test::contactcheck_program(
      {"list", "--detector", "ffd-aabb:cell=3", "--detector", "fcl-aabb", "--detector", "fcl-aabb",
       "--detector", staged("owners"), "--detector", staged("owners")});
  ASSERT_EQ(list.exit_code, 0) << list.err;
  for (const std::string once : {"\nfcl-aabb\n", "\nffd-aabb:cell=3\n", "\nstaged:told=owners\n"}) {
    EXPECT_NE(list.out.find(once), std::string::npos) << once;
    EXPECT_EQ(list.out.find(once), list.out.rfind(once)) << once;
  }
  EXPECT_THAT(list.out, AllOf(HasSubstr(" cell=3 ("), HasSubstr("; default 1)"),
                              HasSubstr(" told=owners\n")));
}

// A ':' begins the options, unless the file's own name has it.
TEST(ListOfOwnDetectors, FindsALibraryWhoseNameHasAColon) {
  const test::Scratch scratch;
  const std::filesystem::path folder = scratch.folder() / "lib:1";
  std::filesystem::create_directory(folder);
  const std::string file = (folder / "mine:a=1.so").string();
  std::filesystem::copy_file(CONTACTCHECK_STAGED_LIBRARY, file);
  for (const std::string options : {"", ":told=owners"}) {
    const test::Outcome list = test::contactcheck_program({"list", "--detector", file + options});
    EXPECT_EQ(list.exit_code, 0) << list.err;
    EXPECT_THAT(list.out, HasSubstr("\nstaged" + options + "\n"));
  }
  const test::Outcome none =
      test::contactcheck_program({"list", "--detector", file + "x:told=owners"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("lib\" does not exist"));
}

TEST(ListOfOwnDetectors, ShowsWhatACommandDeclares) {
  const test::Outcome list =
      test::contactcheck_program({"list", "--detector-cmd", test::misbehaving_command("none")});
  ASSERT_EQ(list.exit_code, 0) << list.err;
  EXPECT_THAT(list.out, AllOf(HasSubstr("  from        command \""), HasSubstr("  claims ")));
}

TEST(ListOfOwnDetectors, RefusesWhatCannotBeUsedInOneSentence) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"list", "--detector", CONTACTCHECK_NO_PLUGIN},
                                             {"list", "--detector", staged("boredom")},
                                             {"list", "--detector", "no-such-detector"},
                                             {"list", "--detector-cmd", "exit 3"}}) {
    const test::Outcome list = test::contactcheck_program(words);
    EXPECT_EQ(list.exit_code, 2) << words.back();
    EXPECT_EQ(list.out, "") << words.back();
    EXPECT_THAT(list.err, testing::StartsWith("contactcheck: ")) << words.back();
  }
}

}  // namespace
}  // namespace contactcheck::plugin
