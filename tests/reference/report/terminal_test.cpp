#include "reference/report/terminal.h"

#include <gmock/gmock.h>

#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck {
namespace {

using test::sample_results;
using testing::HasSubstr;
using testing::Not;

std::string terminal_of(const nlohmann::ordered_json& results, bool color) {
  return terminal_tables(results::from_json(results), color);
}

TEST(Terminal, IsThisText) {
  EXPECT_EQ(terminal_of(sample_results(), false),
            R"(hello  Two | one bodies meet
  2 bodies, 140 triangles, 60 frames, 13 with contact
  detector              level      truth   recall  missed  spurious  body m/s  hover mm  late  ms/frame  question   vs fcl-aabb  vs fcl-obbrss  vs embree
  fcl-aabb              triangle  200000        1       0         0       0/0         0     0      2.00  triangles        1.00x              -          -
  ffd-aabb-sphere2+tri  triangle  200000  0.99999       1         2       0/2      2.10    -1     0.500  triangles        4.00x              -          -
  fcl-obbrss            error  scene hello, frame 7, phase query: signal 11 (Segmentation fault) | core
  embree                absent  not built
  ffd-grid              refused  body "left" has no lattice

  level          finest level judged
  truth          true contacts at that level, over all frames
  recall         hit / truth, cut, not rounded
  missed         true contacts not reported
  spurious       reported, not true
  body m/s       pairs of bodies missed / spurious, over all frames
  hover mm       largest true distance at the moment contact is first reported
  late           frames reported after (+) or before (-) the truth, worst episode
  ms/frame       map + update + query, cold median, own question; (own ...): update + query by its own clock
  question       question in which the next columns compare
  vs fcl-aabb    time of fcl-aabb / time of this detector, cold
  vs fcl-obbrss  time of fcl-obbrss / time of this detector, cold
  vs embree      time of embree / time of this detector, cold
)");
}

TEST(Terminal, ShowsADetectorsOwnClockBesideOurs) {
  auto results = sample_results();
  results["runs"][1]["time_ms"]["cold"]["self_reported"] = 0.375;
  const std::string text = terminal_of(results, false);
  EXPECT_THAT(text, HasSubstr("  0.500 (own 0.375)  triangles"));
  EXPECT_THAT(text, HasSubstr("  2.00  triangles")) << "one without a clock has none";
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
}  // namespace contactcheck
