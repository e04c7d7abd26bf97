#include "reference/report/random_pairs.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/markdown.h"
#include "reference/report/terminal.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;
using test::sample_results;
using testing::HasSubstr;
using testing::Not;

results::Results without_pairs() { return results::from_json(sample_results()); }

results::Results with_pairs(int oracle_wrong) {
  Json results = sample_results();
  results["scenes"][0]["pairs"] = {
      {"count", 10000000},
      {"seed", 7},
      {"touching", 5012345},
      {"per_kind",
       {{"vertex-face", {{"pairs", 9999996}, {"touching", 5012344}}},
        {"point", {{"pairs", 4}, {"touching", 1}}},
        {"sliver", {{"pairs", 0}, {"touching", 0}}}}},
      {"rational", {{"checked", 10000000}, {"oracle_wrong", oracle_wrong}}}};
  return results::from_json(results);
}

constexpr const char* kLine =
    "10,000,000 pairs, seed 7, 5,012,345 touch; oracle against rational arithmetic: 0 wrong";

TEST(RandomPairsReport, LineNamesCountSeedAndVerdict) {
  EXPECT_EQ(pairs_line(with_pairs(0).scenes[0]), kLine);
  EXPECT_EQ(pairs_line(without_pairs().scenes[0]), "");
}

TEST(RandomPairsReport, WrongOracleIsSaidLoudly) {
  const std::string line = pairs_line(with_pairs(1234).scenes[0]);
  EXPECT_THAT(line, HasSubstr("1,234 wrong, AN ERROR OF CONTACTCHECK ITSELF"));
}

TEST(RandomPairsReport, TerminalShowsTheLine) {
  EXPECT_THAT(terminal_tables(with_pairs(0), false),
              HasSubstr("13 with contact\n  " + std::string(kLine) + "\n  detector"));
}

TEST(RandomPairsReport, MarkdownShowsTheLineAndTheKinds) {
  const std::string text = markdown_report(with_pairs(0));
  EXPECT_THAT(text, HasSubstr(std::string(kLine) + ".\n"));
  EXPECT_THAT(text, HasSubstr("| vertex-face | 9999996 | 5012344 | 0.501 |"));
  EXPECT_THAT(text, HasSubstr("| point | 4 | 1 | 0.250 |"));
  EXPECT_THAT(text, HasSubstr("| sliver | 0 | 0 | - |"));
  EXPECT_THAT(markdown_report(without_pairs()), Not(HasSubstr("Kinds of pairs")));
}

}  // namespace
}  // namespace contactcheck::report
