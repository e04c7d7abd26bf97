#include "reference/report/formats/terminal.h"

#include <gmock/gmock.h>

#include <sstream>

#include "reference/report/tables/lattice_fits.h"
#include "reference/report/tables/random_pairs.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/hard_results.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;
using test::drawn_sample_results;
using test::hard_results;
using test::sample_results;
using testing::HasSubstr;
using testing::Not;

std::string terminal_of(const Json& results, bool color) {
  return terminal_tables(results::from_json(results), color);
}

TEST(Terminal, IsThisText) {
  EXPECT_EQ(
      terminal_of(sample_results(), false),
      R"(1 of 3 detectors has no missed and no spurious contacts in 1 scene; 1 ended in status error

hello  Two | one bodies meet
  2 bodies, 140 triangles, 60 frames, 13 with contact
  vertex not judged: open (body "a", frame 0, edge of vertices 4 and 5)
  detector              level      truth   recall  missed  spurious  hover mm  ms/frame  vs fcl-aabb
  fcl-aabb              triangle  200000        1       0         0         0      2.00        1.00x
  ffd-aabb-sphere2+tri  triangle  200000  0.99999       1         2      2.10     0.500        4.00x
  fcl-obbrss            error  scene hello, frame 7, phase query: signal 11 (Segmentation fault) | core
  embree                absent  not built
  ffd-grid              refused  body "left" has no lattice

  report.md has all columns; --explain says what they mean
)");
}

TEST(Terminal, ExplainsTheColumnsShownWhereAskedTo) {
  const std::string text = terminal_tables(results::from_json(sample_results()), false, true);
  EXPECT_THAT(
      text,
      testing::EndsWith(
          R"(  timing: 5 passes, each in a fresh process that has judged nothing. A detector whose pass takes over 2 s has 1. Order drawn by seed 1. Cold: 8 frames of each scene after a sweep of 64 MiB

  detector     as given to --detector
  level        finest level judged
  truth        true contacts at that level, over all frames
  recall       hit / truth, cut, not rounded
  missed       true contacts not reported
  spurious     reported, not true
  hover mm     largest true distance at the moment contact is first reported
  ms/frame     map + update + query in playback, without the first frame; (own ...): update + query by its own clock
  vs fcl-aabb  time of fcl-aabb / time of this detector, same question, playback
)"));
  EXPECT_THAT(text, Not(HasSubstr("--explain")));
}

// Messages apart.
TEST(Terminal, LinesOfATableHaveAtMostAHundredCharacters) {
  std::istringstream lines(terminal_of(sample_results(), false));
  for (std::string line; std::getline(lines, line);)
    if (line.find("  error  ") == std::string::npos) {
      EXPECT_LE(line.size(), 100u) << line;
    }
}

TEST(Terminal, LeavesOutColumnsWithoutAValue) {
  auto results = sample_results();
  for (auto& run : results["runs"])
    for (const char* key : {"time_ms", "speedup"}) run.erase(key);
  const std::string text = terminal_of(results, false);
  EXPECT_THAT(text, HasSubstr("  body m/s  hover mm  late\n"));
  EXPECT_THAT(text, Not(HasSubstr("ms/frame")));
  EXPECT_THAT(text, Not(HasSubstr("question")));
}

TEST(Terminal, NamesQuestionsWhereRowsDifferInThem) {
  auto results = sample_results();
  EXPECT_THAT(terminal_of(results, false), Not(HasSubstr("question")));
  results["runs"][1]["time_ms"]["question"] = "body";
  const std::string text = terminal_of(results, false);
  EXPECT_THAT(text, HasSubstr("  question   ms/frame  "));
  EXPECT_THAT(text, HasSubstr("  triangles      2.00  "));
  EXPECT_THAT(text, HasSubstr("  body          0.500  "));
}

TEST(Terminal, SaysOnceWhatThreeRowsShare) {
  auto results = sample_results();
  const auto refused = results["runs"].back();
  for (const char* detector : {"ffd-aabb", "ffd-aabb-sphere"}) {
    results["runs"].push_back(refused);
    results["runs"].back()["detector"] = detector;
  }
  const std::string text = terminal_of(results, false);
  EXPECT_THAT(text, HasSubstr("\n  3 detectors           refused  body \"left\" has no lattice\n"));
  EXPECT_THAT(text, Not(HasSubstr("ffd-grid")));
}

TEST(Terminal, ShowsADetectorsOwnClockBesideOurs) {
  auto results = sample_results();
  results["runs"][1]["time_ms"]["playback"]["self_reported"] = 0.375;
  const std::string text = terminal_of(results, false);
  EXPECT_THAT(text, HasSubstr("  0.500 (own 0.375)  "));
  EXPECT_THAT(text, HasSubstr("  2.00  ")) << "one without a clock has none";
}

// The row shows the finest level alone, which is right.
TEST(Terminal, NamesErrorsAtLevelsThatTheTableDoesNotShow) {
  auto results = sample_results();
  results["runs"][0]["levels"]["body"]["missed"] = 3;
  EXPECT_THAT(terminal_of(results, false),
              HasSubstr("\n  fcl-aabb at level body: 3 missed, 0 spurious\n"));
  EXPECT_THAT(terminal_of(sample_results(), false), Not(HasSubstr(" at level body")));
}

TEST(Terminal, NotesOfDetectorsFromOutsideFollowTheTable) {
  auto results = sample_results();
  results["runs"][1]["notes"] = {"a and b exchanged"};
  EXPECT_THAT(terminal_of(results, false), Not(HasSubstr("exchanged")));
  results["plugins"] = {{{"detector", "ffd-aabb-sphere2+tri"},
                         {"kind", "command"},
                         {"source", "python3 mine.py"},
                         {"content", "0x0123456789abcdef"},
                         {"version", ""}}};
  EXPECT_THAT(terminal_of(results, false),
              HasSubstr("\n  ffd-aabb-sphere2+tri: a and b exchanged\n"));
}

TEST(Terminal, PaintsMissesSpuriousAndFailuresAlone) {
  const std::string text = terminal_of(sample_results(), true);
  EXPECT_THAT(text, HasSubstr("\x1b[31merror\x1b[0m"));
  EXPECT_THAT(text, HasSubstr("\x1b[31m     1\x1b[0m"));       // one missed
  EXPECT_THAT(text, HasSubstr("\x1b[31m       2\x1b[0m"));     // two spurious
  EXPECT_THAT(text, Not(HasSubstr("\x1b[31m     0\x1b[0m")));  // none missed
  EXPECT_THAT(text, Not(HasSubstr("\x1b[31mmissed\x1b[0m")));  // a title
}

TEST(Terminal, WithoutColourHasNoEscapes) {
  EXPECT_THAT(terminal_of(sample_results(), false), Not(HasSubstr("\x1b")));
}

TEST(Terminal, SummarizesOnlySeveralScenes) {
  auto results = sample_results();
  EXPECT_THAT(terminal_of(results, false), Not(HasSubstr("all scenes")));
  auto scene = results["scenes"][0];
  scene["id"] = "again";
  results["scenes"].push_back(scene);
  EXPECT_THAT(terminal_of(results, false), HasSubstr("all scenes"));
}

TEST(Terminal, ShowsGoalsOfSuitesThatHaveThemAlone) {
  Json results = sample_results();
  EXPECT_THAT(terminal_of(results, false), Not(HasSubstr("goals")));
  results["goals"] = Json::parse(R"([
    {"goal": "wide", "scene": "t", "detector": "e", "part": "playback", "over": "d",
     "at_most": 1.4, "measured": null, "why": "e: not here", "met": null}])");
  EXPECT_THAT(terminal_of(results, false), HasSubstr("not measured: e: not here"));
}

TEST(Terminal, ShowsKnownDefectsThatSurprise) {
  Json results = hard_results();
  EXPECT_THAT(terminal_of(results, false), Not(HasSubstr("known defects")));
  results["known_defects"] = Json::parse(R"({"defects": [], "readings": [],
    "changed": [{"detector": "skin", "scene": "one", "kind": "missed", "values": ["1e-3"],
                 "was": [1], "is": [1000000]}],
    "not_shown": [{"detector": "skin", "scene": "one", "kind": "missed", "values": ["0"],
                   "was": [12]}],
    "unlisted": [{"detector": "skin", "scene": "one", "kind": "spurious",
                  "values": ["1e-9", "1e-3"], "is": [4, 5]}]})");
  EXPECT_THAT(
      terminal_of(results, false),
      HasSubstr("count changed (listed -> shown):\n  skin  one  missed  1e-3: 1 -> 1,000,000\n"
                "listed, not shown:\n  skin  one  missed  0: 12\n"
                "shown, not listed:\n  skin  one  spurious  1e-9: 4; 1e-3: 5\n"));
}

TEST(Terminal, ShowsHardCasesAsSums) {
  EXPECT_THAT(terminal_of(hard_results(), false), HasSubstr("hard cases"));
  EXPECT_THAT(terminal_of(sample_results(), false), Not(HasSubstr("hard cases")));
}

TEST(Terminal, ShowsManyDrawnScenesAsSumsAlone) {
  EXPECT_THAT(terminal_of(drawn_sample_results(9), false), HasSubstr("drawn-7-2"));
  EXPECT_THAT(terminal_of(drawn_sample_results(10), false), Not(HasSubstr("drawn-7-2")));
}

TEST(Terminal, TellsTheWorstFrameOfTheWorstFit) {
  results::Scene scene;
  scene.fits = {{"cloth", {0.003, 0.0}, {0.006, 0.0}}, {"ball", {0.0, 0.001}, {0.0, 0.007}}};
  EXPECT_EQ(fits_line(scene),
            "judged with lattices fitted to recordings: vertices at most 7.00 mm off (body ball, "
            "frame 1)");
  EXPECT_EQ(fits_line({}), "");
  results::Results results = results::from_json(sample_results());
  EXPECT_THAT(terminal_tables(results, false), Not(HasSubstr("fitted")));
  results.scenes[0].fits = {{"cloth", {0.001}, {0.002}}};
  EXPECT_THAT(
      terminal_tables(results, false),
      HasSubstr(
          "with contact\n  judged with lattices fitted to recordings: vertices at most 2.00 mm"));
}

TEST(Terminal, TellsRandomPairsInALine) {
  results::Results results = results::from_json(sample_results());
  EXPECT_EQ(pairs_line(results.scenes[0]), "");
  results::RandomPairs& pairs = results.scenes[0].pairs.emplace();
  pairs.count = 10'000'000;
  pairs.seed = 7;
  pairs.touching = 5'012'345;
  EXPECT_THAT(terminal_tables(results, false),
              HasSubstr("13 with contact\n  10,000,000 pairs, seed 7, 5,012,345 touch; oracle "
                        "against rational arithmetic: 0 wrong\n  vertex not judged: open"));
}

TEST(Terminal, ExplainsHowSteadyPassesWereBelowTheTables) {
  Json results = sample_results();
  EXPECT_THAT(terminal_tables(results::from_json(results), false, true),
              Not(HasSubstr("beside itself")));
  results["runs"][0]["time_ms"]["passes"] = 10;
  results["runs"][0]["time_ms"]["pass_ms"] = {1.5, 1.0, 3.0, 2.0, 0.3, 0.2, 6.0, 4.0, 1.5, 1.0};
  EXPECT_THAT(terminal_tables(results::from_json(results), false), Not(HasSubstr("beside itself")));
  EXPECT_THAT(terminal_tables(results::from_json(results), false, true),
              testing::ContainsRegex("\n\n  each detector beside itself, over 5 pairs of passes: "
                                     "1.00 lies inside 0 of 1 [^\n]*\n\n"));
}

TEST(Terminal, ColumnsOfOneTableAreAligned) {
  const std::string text = terminal_of(sample_results(), false);
  std::size_t width = 0;
  for (const char* name : {"detector  ", "fcl-aabb  ", "ffd-aabb-sphere2+tri  triangle"}) {
    const std::size_t begin = text.find(std::string("\n  ") + name);
    ASSERT_NE(begin, std::string::npos) << name;
    const std::size_t length = text.find('\n', begin + 1) - begin;
    if (width == 0) width = length;
    EXPECT_EQ(length, width) << name;
  }
}

}  // namespace
}  // namespace contactcheck::report
