#include "reference/reproduce/reproduction_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "reference/reproduce/paper_report.h"
#include "reference/reproduce/reproduction.h"
#include "reference/results/results_json.h"
#include "tests/reference/reproduce/sample_run.h"

namespace contactcheck::reproduce {
namespace {

using test::Json;
using test::paper_of_our_methods;
using test::sample_closed_loop;
using test::sample_reproduction_results;

using Rows = std::vector<std::vector<std::string>>;

// Functions, and no matchers: they are compiled once.
void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
}

void expect_not_in(const std::string& text, const std::string& part) {
  EXPECT_EQ(text.find(part), std::string::npos) << part << "\nis in\n" << text;
}

std::string markdown_of(const Json& results) {
  return reproduction_markdown(reproduce(results::from_json(results), paper_of_our_methods()));
}

// As the command writes it.
Json reproduction_of(const Json& results) {
  const PaperTables tables = paper_of_our_methods();
  Json out = reproduce(results::from_json(results), tables);
  out["paper"] = paper_json(tables, check_paper(tables));
  return out;
}

std::string terminal_of(const Json& results) {
  return reproduction_terminal(reproduce(results::from_json(results), paper_of_our_methods()));
}

// Bars that part columns: those that are not written with a backslash.
std::size_t bars(const std::string& line) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '|' && (i == 0 || line[i - 1] != '\\')) ++count;
  return count;
}

// Every line of a table has as many columns as its head.
void expect_tables_whole(const std::string& markdown) {
  std::istringstream lines(markdown);
  std::size_t head = 0, tables = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool in_table = !line.empty() && line.front() == '|';
    if (!in_table) {
      head = 0;
      continue;
    }
    if (head == 0) {
      head = bars(line);
      ++tables;
    }
    EXPECT_EQ(bars(line), head) << line;
    EXPECT_EQ(line.back(), '|') << line;
  }
  EXPECT_GE(tables, 3u) << "counts, times and ratios";
}

TEST(ReproductionMarkdown, BeginsWithTheRunAndItsReadings) {
  const std::string text = markdown_of(sample_reproduction_results());
  EXPECT_TRUE(text.starts_with("# The paper's tables beside ours\n"));
  expect_in(text, "- command: `contactcheck reproduce`\n");
  expect_in(text, "- machine: a cpu, 2 cores, avx2, an os\n- contactcheck 1.2.3\n");
  for (const MethodReading& reading : kReadings)
    expect_in(text, std::string("- `") + reading.id + "`: " + reading.says + "\n");
}

TEST(ReproductionMarkdown, HasTheCountsOfTheScene) {
  const std::string text = markdown_of(sample_reproduction_results());
  expect_in(text,
            "## s\n\nScene `paper-s`, 60 frames, 41 with contact.\n\n"
            "| count | paper | ours | difference |\n|---|--:|--:|--:|\n"
            "| objects | 2 | 2 | +0.00 % |\n| vertices | 20 | 22 | +10.00 % |\n"
            "| triangles | 32 | 32 | +0.00 % |\n| cells | 7 | 6 | -14.29 % |\n");
}

TEST(ReproductionMarkdown, HasTheTimesOfBothAndWhatWasMissed) {
  const std::string text = markdown_of(sample_reproduction_results());
  expect_in(text,
            "| ffd-aabb-sphere | paper, Table 3, box | 10.0 | 1.00 | 40.0 | 4.00 "
            "| 60.0 | - | - | - |\n");
  expect_in(text,
            "| ffd-aabb-sphere | ours, paper | 1.00 | 2.00 | 6.00 | 1.00 | 10.0 "
            "| cell | 3 of 20 | 7 |\n");
}

TEST(ReproductionMarkdown, HasTheRatiosWithTheirRanges) {
  const std::string text = markdown_of(sample_reproduction_results());
  const std::string row = "| ffd-aabb-sphere | ffd-aabb-sphere2 | ";
  expect_in(text, row + "paper, Table 3 | 2.00x | 1.500x | - | - |\n");
  expect_in(text, row +
                      "ours, safe | 1.50x (1.25 to 1.75) | 1.25x (1.12 to 1.38) | yes | "
                      "0, 0 |\n");
  expect_in(text, row +
                      "ours, paper | 3.00x (2.50 to 3.50) | 1.67x (1.50 to 1.83) | no | "
                      "3, 5 |\n");
}

TEST(ReproductionMarkdown, HasTheSentencesTheFrameRateAndTheMeans) {
  const std::string text = markdown_of(sample_reproduction_results());
  expect_in(text, "\n- The collision test of ffd-aabb-sphere takes 1.50 times");
  expect_in(text, "\n- A whole step gains 1.250 and not 1.500");
  expect_in(text,
            "`ffd-aabb-sphere2`: 167 whole steps per second, 3.3 times real "
            "time, on one core.\n");
  expect_in(text, "bounds=safe (1 of the scenes)");
  expect_in(text, "ours 1.50x, the paper's 2.00x\n");
  expect_in(text, "ours 1.250x; the paper's totals give 1.500x");
}

TEST(ReproductionMarkdown, SaysHowMuchCloserTheProposalRests) {
  Json reproduction =
      reproduce(results::from_json(sample_reproduction_results()), paper_of_our_methods());
  expect_not_in(reproduction_markdown(reproduction), "At rest");
  reproduction["scenes"][0]["hover_at_rest"] =
      Json::parse(R"({"ffd-grid": 0.125, "ffd-aabb-sphere2": 0.0625, "factor": 2.0})");
  expect_in(reproduction_markdown(reproduction),
            "At rest `ffd-aabb-sphere2` keeps the surfaces 62.5 mm apart on average, "
            "`ffd-grid` 125 mm: 2.0 times as far.\n");
}

TEST(ReproductionMarkdown, HasTheClosedLoopInMillimetres) {
  Json results = sample_reproduction_results();
  expect_not_in(markdown_of(results), "Closed loop");
  results["runs"][1]["closed_loop"] = sample_closed_loop();
  expect_in(markdown_of(results),
            "| ffd-aabb-sphere2:bounds=safe | 12.3 | 4.50 | - | 0.250 | 0.500 | 3 | "
            "body 1, cell 0.50000 |\n");
}

TEST(ReproductionMarkdown, TablesStayWholeWithBarsAndWithoutReadings) {
  Json results = sample_reproduction_results();
  results["runs"][0]["closed_loop"] = sample_closed_loop();
  results["runs"][1] = Json::parse(
      R"({"scene": "paper-s", "detector": "ffd-aabb-sphere2:bounds=safe", "status": "error",
          "message": "a|b"})");
  results["runs"][2]["closed_loop"]["error"] = "body \"a|b\"\ndiverged";
  const std::string text = markdown_of(results);
  expect_tables_whole(text);
  expect_in(text, "| ffd-aabb-sphere | body \"a\\|b\" diverged |");
  expect_in(text, "| ffd-aabb-sphere2 | ours, safe | - | - | - | - | - | - | - | - |");
  expect_not_in(text, "## Means");  // there is no reading to take a mean of
}

TEST(ReproductionMarkdown, OfNothingIsTheIntroductionAlone) {
  Json results = sample_reproduction_results();
  results["scenes"] = Json::array();
  EXPECT_TRUE(markdown_of(results).ends_with("only ratios compare.\n\n"));
}

TEST(PaperPartOfThePage, OverviewHasARowPerSceneWithThePapersRatiosBesideOurs) {
  const report::TitledTable overview =
      paper_part(reproduction_of(sample_reproduction_results())).overview;
  EXPECT_EQ(overview.title, "Two levels of spheres over one: the paper's ratios beside ours");
  ASSERT_EQ(overview.columns.size(), 9u);
  EXPECT_EQ(overview.columns[1].title, "collision test: paper");
  EXPECT_EQ(overview.columns[6].title, "ours, safe");
  const Rows rows = {{"s", "2.00x", "1.50x (1.25 to 1.75)", "3.00x (2.50 to 3.50)", "-", "1.500x",
                      "1.25x (1.12 to 1.38)", "1.67x (1.50 to 1.83)", "-"}};
  EXPECT_EQ(overview.rows, rows);
}

// What the page says of the sample's one scene, and of all scenes.
TEST(PaperPartOfThePage, SentencesAreThoseOfTheMarkdown) {
  const Json reproduction = reproduction_of(sample_reproduction_results());
  const report::PaperPart part = paper_part(reproduction);
  const std::string markdown = reproduction_markdown(reproduction);
  EXPECT_EQ(part.readings.size(), kReadings.size());
  for (const std::string& sentence : part.readings) expect_in(markdown, "- " + sentence + "\n");
  expect_in(markdown, "## " + part.means_title + "\n");
  EXPECT_EQ(part.means.size(), 2u);
  for (const std::string& sentence : part.means) expect_in(markdown, "- " + sentence + "\n");
  ASSERT_EQ(part.scenes.size(), 1u);
  EXPECT_EQ(part.scenes[0].title, "s");
  EXPECT_EQ(part.scenes[0].aside, "`paper-s`, 60 frames, 41 with contact");
  EXPECT_EQ(part.scenes[0].sentences.size(), 3u) << "two where ours falls short, the frame rate";
  for (const std::string& sentence : part.scenes[0].sentences) expect_in(markdown, sentence + "\n");
}

TEST(PaperPartOfThePage, SceneHasItsFourTablesUnderTitles) {
  Json results = sample_reproduction_results();
  results["runs"][1]["closed_loop"] = sample_closed_loop();
  const std::vector<report::TitledTable> tables =
      paper_part(reproduction_of(results)).scenes.at(0).tables;
  ASSERT_EQ(tables.size(), 4u);
  for (const report::TitledTable& table : tables) {
    EXPECT_FALSE(table.title.empty());
    EXPECT_FALSE(table.rows.empty()) << table.title;
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.title;
  }
  EXPECT_EQ(tables[1].title,
            "Milliseconds per whole step, timed in lockstep from the same states, cold");
  const std::vector<std::string> cells = {"cells", "7", "6", "-14.29 %"};
  EXPECT_EQ(tables[2].rows.at(3), cells);
  expect_in(tables[3].text, "Hover at rest is the true distance");
  EXPECT_EQ(tables[3].rows.at(0).back(), "body 1, cell 0.50000");
}

TEST(PaperPartOfThePage, HasThePapersOwnNumbersAndNoMeansOfNothing) {
  Json results = sample_reproduction_results();
  results["scenes"] = Json::array();
  const report::PaperPart part = paper_part(reproduction_of(results));
  EXPECT_EQ(part.checks.rows.size(), check_paper(paper_of_our_methods()).size());
  expect_in(part.own_numbers, "; 0 contradict a claim or cannot be.");
  EXPECT_TRUE(part.means.empty());
  EXPECT_EQ(part.means_title, "");
  EXPECT_TRUE(part.scenes.empty());
  EXPECT_TRUE(part.overview.rows.empty());
}

TEST(PaperPartOfThePage, RefusesWhatIsNoReproduction) {
  const Json whole = reproduction_of(sample_reproduction_results());
  for (const char* key : {"scenes", "means", "paper"}) {
    Json without = whole;
    without.erase(key);
    EXPECT_THROW(paper_part(without), Json::exception) << key;
    without[key] = "a word";
    EXPECT_THROW(paper_part(without), Json::exception) << key;
  }
  Json older = whole;
  older["scenes"][0]["ratios"][1].erase("exact");
  EXPECT_THROW(paper_part(older), Json::exception);
}

TEST(ReproductionTerminal, HasTwoLinesPerScene) {
  EXPECT_EQ(terminal_of(sample_reproduction_results()),
            "  scene      two levels over one        paper               ours, safe              "
            "ours, paper  same contacts at safe\n"
            "  s          collision test            2.000x     1.50x (1.25 to 1.75)     3.00x "
            "(2.50 to 3.50)  yes\n"
            "  s          frames per second         1.500x     1.25x (1.12 to 1.38)     1.67x "
            "(1.50 to 1.83)  yes\n");
}

TEST(ReproductionTerminal, SaysNoWhereContactsDiffer) {
  Json results = sample_reproduction_results();
  results["runs"][1]["contact_hash"] = "0xd";
  EXPECT_TRUE(terminal_of(results).ends_with("  no\n"));
}

TEST(ReproductionTerminal, MissingReadingIsADashAndAMissingHeadlineNoLine) {
  Json results = sample_reproduction_results();
  results["runs"].erase(3);
  expect_in(terminal_of(results), "1.50x (1.25 to 1.75)                        -  yes");
  results["runs"].erase(1);
  const std::string text = terminal_of(results);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

}  // namespace
}  // namespace contactcheck::reproduce
