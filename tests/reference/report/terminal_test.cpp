#include "reference/report/terminal.h"

#include <gmock/gmock.h>

#include <sstream>

#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using test::sample_results;
using testing::HasSubstr;
using testing::Not;

std::string terminal_of(const nlohmann::ordered_json& results, bool color) {
  return terminal_tables(results::from_json(results), color);
}

TEST(Terminal, IsThisText) {
  EXPECT_EQ(
      terminal_of(sample_results(), false),
      R"(1 of 3 detectors have no missed and no spurious contacts in 1 scene; 1 ended in status error

hello  Two | one bodies meet
  2 bodies, 140 triangles, 60 frames, 13 with contact
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
  vs fcl-aabb  time of fcl-aabb / time of this detector, playback
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
