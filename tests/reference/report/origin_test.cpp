// What the times of a run are worth: how much of them was taken off, and passes beside one another.
#include "reference/report/origin.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reference/report/markdown.h"
#include "reference/report/terminal.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

using PassTimes = std::vector<double>;

// One row per detector.
results::Results timed_rows(const std::vector<PassTimes>& detectors) {
  results::Results out;
  for (const PassTimes& pass_ms : detectors) {
    results::QuestionTimes times;
    times.passes = pass_ms.size();
    times.pass_ms = pass_ms;
    out.runs.emplace_back().times = {times};
  }
  return out;
}

// Ten passes whose ratios, pair by pair, have an interval of this half-width round 1.
PassTimes passes_round_one(double half_width) {
  const double t4 = 2.776;  // Student's t of 5 ratios
  const double ratio = std::exp(std::log(1.0 + half_width) * std::sqrt(5.0) / t4);
  return {ratio, 1.0, 1.0, ratio, 2.0 * ratio, 2.0, 3.0, 3.0 * ratio, 5.0, 5.0};
}

const PassTimes kSlowerFirst = {1.5, 1.0, 3.0, 2.0, 0.3, 0.2, 6.0, 4.0, 1.5, 1.0};

TEST(Steadiness, IsSaidOfFivePairsOfPasses) {
  EXPECT_EQ(steadiness_line({}), "");
  EXPECT_EQ(steadiness_line(timed_rows({{}, PassTimes(9, 1.0)})), "") << "four pairs and one pass";
  EXPECT_EQ(steadiness_line(timed_rows({PassTimes(10, 1.0)})),
            "each detector beside itself, over 5 pairs of passes: 1.00 lies inside 1 of 1 "
            "intervals of 95 %; their median half-width is 0.0 %");
}

TEST(Steadiness, CountsIntervalsThatMissOneAndGivesTheMedianHalfWidth) {
  EXPECT_EQ(steadiness_line(timed_rows(
                {passes_round_one(0.05), kSlowerFirst, PassTimes(9, 1.0), passes_round_one(0.25)})),
            "each detector beside itself, over 5 pairs of passes: 1.00 lies inside 2 of 3 "
            "intervals of 95 %; their median half-width is 5.0 %");
}

TEST(Steadiness, CountsEveryQuestionAndNamesTheFewestPairs) {
  results::Results results = timed_rows({PassTimes(13, 1.0)});
  EXPECT_THAT(steadiness_line(results),
              HasSubstr("over 6 pairs of passes: 1.00 lies inside 1 of 1"));
  results.runs[0].times.push_back(timed_rows({kSlowerFirst}).runs[0].times[0]);
  EXPECT_THAT(steadiness_line(results),
              HasSubstr("over 5 pairs of passes: 1.00 lies inside 1 of 2"));
}

TEST(Steadiness, StandsInReportsAndInTheTerminal) {
  nlohmann::ordered_json json = test::sample_results();
  const auto line_of = [&] { return steadiness_line(results::from_json(json)); };
  EXPECT_EQ(line_of(), "");
  for (const std::string& line : machine_lines(results::from_json(json)))
    EXPECT_THAT(line, Not(HasSubstr("beside itself")));
  EXPECT_THAT(terminal_tables(results::from_json(json), false), Not(HasSubstr("beside itself")));

  json["runs"][0]["time_ms"]["passes"] = 10;
  json["runs"][0]["time_ms"]["pass_ms"] = kSlowerFirst;
  const results::Results results = results::from_json(json);
  const std::string line = line_of();
  EXPECT_THAT(line, HasSubstr("inside 0 of 1 intervals"));
  EXPECT_EQ(machine_lines(results).back(), line);
  EXPECT_THAT(machine_lines(results), Contains(timing_line(results)));
  EXPECT_THAT(terminal_tables(results, false, true), HasSubstr("\n\n  " + line + "\n\n"));
  EXPECT_THAT(markdown_report(results), HasSubstr("- " + line + "\n"));
}

TEST(TimingLine, SaysWhatShareOfTheTimeWasTakenOff) {
  nlohmann::ordered_json json = test::sample_results();
  const auto line_of = [&] { return timing_line(results::from_json(json)); };
  EXPECT_THAT(line_of(), Not(HasSubstr("given to others")));
  json["runs"][1]["time_ms"]["playback"]["taken"] = 0.0;
  EXPECT_THAT(line_of(), Not(HasSubstr("given to others")));
  // Of 2 and 0.5 ms in the two rows, beside which it is.
  json["runs"][0]["time_ms"]["playback"]["taken"] = 0.5;
  EXPECT_THAT(line_of(), HasSubstr(". 16.7 % of the time was given to others by the machine"));
}

}  // namespace
}  // namespace contactcheck::report
