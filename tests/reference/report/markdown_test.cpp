#include "reference/report/markdown.h"

#include <gmock/gmock.h>

#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using test::sample_results;
using testing::HasSubstr;
using testing::Not;

std::string markdown_of(const nlohmann::ordered_json& results) {
  return markdown_report(results::from_json(results));
}

TEST(Markdown, IsThisText) {
  EXPECT_EQ(markdown_of(sample_results()),
            R"(# contactcheck report

- command: `contactcheck run hello`
- machine: A CPU, 2 cores, AVX2, Debian 12
- built with g++ 12, Release
- libraries: eigen 3.4.0, fcl 0.7.0
- contactcheck 0.1.0, schema contactcheck-results/2
- timing: 5 passes, each in a fresh process that has judged nothing. A detector whose pass takes over 2 s has 1. Order drawn by seed 1. Cold: 8 frames of each scene after a sweep of 64 MiB

## Summary

Sums over scenes; speed-ups are the smallest and the largest of any scene, in playback.

| detector | scenes | level | truth | recall | missed | spurious | body m/s | hover mm | question | passes | vs fcl-aabb | vs fcl-obbrss | vs embree |
|---|--:|---|--:|--:|--:|--:|--:|--:|---|--:|--:|--:|--:|
| fcl-aabb | 1 | triangle | 200000 | 1 | 0 | 0 | 0/0 | 0 | triangles | 5 | 1.00x | - | - |
| ffd-aabb-sphere2+tri | 1 | triangle | 200000 | 0.99999 | 1 | 2 | 0/2 | 2.10 | triangles | 5 | 4.00x | - | - |
| fcl-obbrss | 0 (1 error) |  | - | - | - | - | - | - |  | - | - | - | - |
| embree | 0 (1 absent) |  | - | - | - | - | - | - |  | - | - | - | - |
| ffd-grid | 0 (1 refused) |  | - | - | - | - | - | - |  | - | - | - | - |

## Speed against error

![Every detector as a point: time per frame against share of errors](plots/speed_error.svg)

Over scene hello. A time is that of mapping, update and query in playback, the mean over all frames but the first. An error is the share of contacts missed or of reports spurious, whichever is worse, at the finest level judged in every scene. On the front: no other that answers the same question is faster without being worse.

| detector | question timed | ms/frame | passes | level | truth | missed | reported | spurious | error | on the front |
|---|---|--:|--:|---|--:|--:|--:|--:|--:|---|
| fcl-aabb | triangles | 2.00 | 5 | triangle | 200000 | 0 | 200000 | 0 | 0 | yes |
| ffd-aabb-sphere2+tri | triangles | 0.500 | 5 | triangle | 200000 | 1 | 200001 | 2 | 0.00001 | yes |

Not in the chart: fcl-obbrss, embree, ffd-grid (ended well in 0 of 1 scenes).

## Errors by detector and stage

![Share of true contacts missed and of reports spurious, a row per detector](plots/who_errs.svg)

![Share of true pairs of triangles lost, stage by stage, a row per detector](plots/stage_losses.svg)

## What the results say

### ffd-aabb-sphere2+tri against FCL and Embree, question `triangles`

Errors are recall / spurious rate at level `triangle`; a speed-up is the reference's time divided by this detector's, in playback. [low, high] is the 95 % interval over 5 passes.

| scene | errors | errors of fcl-aabb | speed-up over fcl-aabb | errors of fcl-obbrss | speed-up over fcl-obbrss | errors of embree | speed-up over embree | passes |
|---|--:|--:|--:|--:|--:|--:|--:|--:|
| hello | 0.99999 / 0.00001 | 1 / 0 | 4.00x [3.50, 4.25] | - | - | - | - | 5 |

## hello

Two | one bodies meet. 60 frames, 13 with contact, size 1.50 m.

| body | mesh | vertices | triangles | cells | solid | notes |
|---|---|--:|--:|--:|---|---|
| left | box | 8 | 12 | 27 | no | 3 boundary-edge \| open |
| right | sphere | 66 | 128 | 26 | yes |  |

True contacts, summed over frames: body 13, triangle 200000, vertex not judged: open.

| detector | level | truth | recall | missed | spurious | body m/s | hover mm | late | question | ms/frame | passes | vs fcl-aabb | vs fcl-obbrss | vs embree |
|---|---|--:|--:|--:|--:|--:|--:|--:|---|--:|--:|--:|--:|--:|
| fcl-aabb | triangle | 200000 | 1 | 0 | 0 | 0/0 | 0 | 0 | triangles | 2.00 | 5 | 1.00x | - | - |
| ffd-aabb-sphere2+tri | triangle | 200000 | 0.99999 | 1 | 2 | 0/2 | 2.10 | -1 | triangles | 0.500 | 5 | 4.00x | - | - |
| fcl-obbrss | error | scene hello, frame 7, phase query: signal 11 (Segmentation fault) \| core |  |  |  |  |  |  |  |  |  |  |  |  |
| embree | absent | not built |  |  |  |  |  |  |  |  |  |  |  |  |
| ffd-grid | refused | body "left" has no lattice |  |  |  |  |  |  |  |  |  |  |  |  |

Every level judged (sums over frames):

| detector | level | truth for | truth | reported | missed | spurious | recall | spurious rate |
|---|---|---|--:|--:|--:|--:|--:|--:|
| fcl-aabb | body | doubles | 13 | 13 | 0 | 0 | 1 | 0 |
| fcl-aabb | triangle | doubles | 200000 | 200000 | 0 | 0 | 1 | 0 |
| ffd-aabb-sphere2+tri | body | doubles | 13 | 15 | 0 | 2 | 1 | 0.13334 |
| ffd-aabb-sphere2+tri | triangle | doubles | 200000 | 200001 | 1 | 2 | 0.99999 | 0.00001 |

Which stage lost which true triangle pairs (sums over frames):

| detector | stage | unit | in | out | visited | missed |
|---|---|---|--:|--:|--:|--:|
| ffd-aabb-sphere2+tri | hash | cell pairs | 900 | 30 | - | 1 |

Times in milliseconds per frame (playback unless said, means over passes):

| detector | question | prepare | map | update | query | frame | contact frame | first frame | own clock | CPU time | frame, cold | frames | passes | prepared, MiB | memory, MiB |
|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|
| fcl-aabb | triangles | 12.0 | 0.250 | 0.500 | 1.25 | 2.00 | 3.00 | 4.00 | - | 2.25 | 3.00 | 60 | 5 | 0.500 | 1.00 |
| ffd-aabb-sphere2+tri | triangles | 8.00 | - | 0.125 | 0.375 | 0.500 | - | 1.00 | - | 0.500 | 0.750 | 60 | 5 | 0.250 | 0.500 |

[low, high] is the 95 % interval over 5 passes.

Speed-ups: time of the reference / time of the detector on the same question, frames and passes:

| detector | its options | question | reference | its options | playback | cold | contact frames, playback | without map, playback | passes |
|---|---|---|---|---|--:|--:|--:|--:|--:|
| ffd-aabb-sphere2+tri | - | triangles | fcl-aabb | - | 4.00x [3.50, 4.25] | 4.00x [3.00, 5.00] | - | - | 5 |

Disagreements with the truth (first of each kind):

- ffd-aabb-sphere2+tri: first missed at level triangle in frame 17: `cases/0001.json`

## How to read the result table

- **detector**: as given to --detector
- **level**: finest level judged
- **truth**: true contacts at that level, over all frames
- **recall**: hit / truth, cut, not rounded
- **missed**: true contacts not reported
- **spurious**: reported, not true
- **body m/s**: pairs of bodies missed / spurious, over all frames
- **hover mm**: largest true distance at the moment contact is first reported
- **late**: frames reported after (+) or before (-) the truth, worst episode
- **question**: question of the next columns
- **ms/frame**: map + update + query in playback, without the first frame; (own ...): update + query by its own clock
- **passes**: timed passes through the frames, each in a fresh process
- **vs fcl-aabb**: time of fcl-aabb / time of this detector, playback
- **vs fcl-obbrss**: time of fcl-obbrss / time of this detector, playback
- **vs embree**: time of embree / time of this detector, playback
)");
}

TEST(Markdown, BarsAndLineBreaksDoNotEndACell) {
  auto results = sample_results();
  results["runs"][2]["message"] = "one | two\nthree";
  EXPECT_THAT(markdown_of(results), HasSubstr("| error | one \\| two three |"));
}

TEST(Markdown, ScenesWithoutTimesOrDisagreementsHaveNoEmptyTables) {
  auto results = sample_results();
  results["disagreements"] = nlohmann::ordered_json::array();
  for (auto& run : results["runs"])
    if (run["status"] == "ok") {
      run["time_ms"] = {{"prepare", 1.0}};
      run.erase("speedup");
      run["stages"] = nlohmann::ordered_json::array();
    }
  const std::string text = markdown_of(results);
  EXPECT_THAT(text, Not(HasSubstr("Times in milliseconds")));
  EXPECT_THAT(text, Not(HasSubstr("Which stage lost")));
  EXPECT_THAT(text, Not(HasSubstr("Disagreements with")));
}

// Two detectors of the paper's first claim, with these gaps.
nlohmann::ordered_json hovering(nlohmann::ordered_json grid, nlohmann::ordered_json aabb) {
  auto results = sample_results();
  auto run = results["runs"][0];
  results["runs"] = nlohmann::ordered_json::array();
  run["detector"] = "ffd-grid";
  run["geometry"]["hover_gap_max"] = std::move(grid);
  results["runs"].push_back(run);
  run["detector"] = "ffd-aabb";
  run["geometry"]["hover_gap_max"] = std::move(aabb);
  results["runs"].push_back(run);
  return results;
}

TEST(Markdown, SaysWhichScenesWereTakenOver) {
  auto results = sample_results();
  results["resumed"] = nlohmann::ordered_json::array();
  EXPECT_EQ(markdown_of(results), markdown_of(sample_results())) << "none";
  results["resumed"] = {"hello", "world"};
  EXPECT_THAT(
      markdown_of(results),
      HasSubstr("\n\nTaken over from an earlier run that was interrupted (`--resume`), with "
                "the times measured then: hello, world.\n\n## Summary"));
}

TEST(Markdown, SaysWhereTheClaimAboutHoverHolds) {
  EXPECT_THAT(markdown_of(hovering(0.02, 0.01)), HasSubstr("| hello | 20.0 | 10.0 | holds |"));
  EXPECT_THAT(markdown_of(hovering(0.01, 0.02)),
              HasSubstr("| hello | 10.0 | 20.0 | does not hold |"));
  EXPECT_THAT(markdown_of(hovering(0.01, 0.01)), HasSubstr("| hello | 10.0 | 10.0 | equal |"));
  EXPECT_THAT(markdown_of(hovering(0.01, nullptr)), HasSubstr("| hello | 10.0 | - | no episode |"));
}

TEST(Markdown, ScenesWithoutContactSayNothingAboutHover) {
  auto results = hovering(0.02, 0.01);
  results["scenes"][0]["contact_frames"] = 0;
  EXPECT_THAT(markdown_of(results), Not(HasSubstr("the paper's claim")));
}

TEST(Markdown, NeverShowsANumberThatIsNone) {
  const std::string text = markdown_of(sample_results());
  EXPECT_THAT(text, Not(testing::ContainsRegex("[Nn]a[Nn]|null|[^a-z]inf[^a-z]")));
}

}  // namespace
}  // namespace contactcheck::report
