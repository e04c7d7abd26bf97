// Detectors whose answers are written here, on queries whose truth is known: a vertex over (1, 1)
// that moves along z, and the triangle (0, 0), (4, 0), (0, 4) at z = 0.
#include "reference/queries/query_judge.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>
#include <tuple>

#include "tests/reference/scene/scratch.h"

namespace contactcheck::queries {
namespace {

using test::Scratch;
using test::sentence_of;

constexpr auto kFace = ImpactKind::vertex_triangle;
constexpr auto kEdge = ImpactKind::edge_edge;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A query of the height of the vertex at both ends; `corner`, a fraction, is the length of two
/// edges.
std::string falls(const std::string& from, const std::string& to, const std::string& corner = "4,1",
                  const std::string& truth = "") {
  const std::string end = (truth.empty() ? "" : "," + truth) + "\n";
  const std::string triangle =
      "0,1,0,1,0,1" + end + corner + ",0,1,0,1" + end + "0,1," + corner + ",0,1" + end;
  return "1,1,1,1," + from + end + triangle + "1,1,1,1," + to + end + triangle;
}

/// In contact at t = 1 / n alone.
std::string meets_at_one_nth(int n, const std::string& corner = "4,1") {
  return falls("1,1", std::to_string(1 - n) + ",1", corner);
}
const std::string kMeets = meets_at_one_nth(2), kMisses = falls("1,1", "2,1");

using Answers = std::function<ReportedImpact(const ImpactQuery&)>;
using Feed = std::function<ImpactQuery(const ImpactQuery&)>;

class Written final : public ImpactDetector {
 public:
  Written(Answers answers, Feed feed, ImpactTolerance tolerance)
      : answers_(std::move(answers)), feed_(std::move(feed)), tolerance_(tolerance) {}
  ImpactTolerance tolerance() const override { return tolerance_; }
  ReportedImpact query(const ImpactQuery& query) override { return answers_(query); }
  ImpactQuery fed(const ImpactQuery& query) const override { return feed_ ? feed_(query) : query; }

 private:
  Answers answers_;
  Feed feed_;
  ImpactTolerance tolerance_;
};

QueryDetector detector(const std::string& name, const Answers& answers,
                       const std::vector<ImpactKind>& kinds = {kFace, kEdge},
                       Precision precision = Precision::kDouble, const Feed& feed = {},
                       const ImpactTolerance& tolerance = {}) {
  return {name, precision, kinds,
          [=] { return local_session(std::make_unique<Written>(answers, feed, tolerance)); }};
}

/// Gives these answers, one after the other.
QueryDetector in_turn(std::vector<ReportedImpact> list) {
  auto next = std::make_shared<std::size_t>(0);
  return detector(
      "in-turn", [list = std::move(list), next](const ImpactQuery&) { return list.at((*next)++); });
}

FileScore judged(const std::string& text, const std::vector<QueryDetector>& detectors,
                 ImpactKind kind = kFace, const ImpactTolerance& cap = kNoCap) {
  const Scratch scratch;
  return judge_queries({scratch.write("q.csv", text), kind, std::nullopt}, detectors, cap);
}

DetectorScore score_of(const std::string& text, const QueryDetector& info) {
  return judged(text, {info}).detectors.at(0);
}

void expect_score(const ImpactScore& score, const std::vector<std::uint64_t>& expected) {
  EXPECT_EQ((std::vector{score.truth, score.reported, score.hit, score.missed, score.spurious}),
            expected);
}

TEST(JudgeQueries, SaysWhatTheFileHas) {
  const FileScore score = judged(kMeets + falls("0,1", "1,1") + kMisses + falls("1,3", "-1,3"), {});
  EXPECT_EQ(score.kind, kFace);
  EXPECT_EQ(score.queries, 4U);
  EXPECT_EQ(score.contacts, 3U);
  EXPECT_EQ(score.starts_in_contact, 1U);
  EXPECT_EQ(score.not_doubles, 1U);
  EXPECT_EQ(score.file_truths, 0U);
  EXPECT_TRUE(score.detectors.empty());
  EXPECT_EQ(score.oracle.worst_line % 8, 1U);
}

TEST(JudgeQueries, CountsHitsMissedAndSpuriousAndNamesTheFirst) {
  const DetectorScore score = score_of(
      kMeets + kMisses + kMisses + kMeets + kMeets + kMisses + kMeets,
      in_turn(
          {{true, {}}, {false, {}}, {true, {}}, {false, {}}, {false, {}}, {true, {}}, {true, {}}}));
  EXPECT_EQ(score.detector, "in-turn");
  EXPECT_EQ(score.queries, 7U);
  EXPECT_EQ(score.errors, 0U);
  expect_score(score.score, {4, 4, 2, 2, 2});
  EXPECT_EQ(score.score.first_missed, 25U);
  EXPECT_EQ(score.score.first_spurious, 17U);
  EXPECT_EQ(score.score_fed.has_value(), false);
}

TEST(JudgeQueries, NamesNoLineWhereNothingIsWrong) {
  const DetectorScore score = score_of(kMeets + kMisses, in_turn({{true, {}}, {false, {}}}));
  expect_score(score.score, {1, 1, 1, 0, 0});
  EXPECT_EQ(score.score.first_missed, std::nullopt);
  EXPECT_EQ(score.score.first_spurious, std::nullopt);
  EXPECT_EQ(score.first_error, std::nullopt);
}

TEST(JudgeQueries, AsksEachQueryAsItIsInTheFile) {
  const DetectorScore score =
      score_of(falls("1,1", "-3,1"), detector("echo", [](const ImpactQuery& query) {
                 EXPECT_EQ(query.kind, kFace);
                 EXPECT_EQ(query.start[0], Vec3(1, 1, 1));
                 EXPECT_EQ(query.end[0], Vec3(1, 1, -3));
                 EXPECT_EQ(query.end[3], Vec3(0, 4, 0));
                 return ReportedImpact{true, {}};
               }));
  EXPECT_EQ(score.score.hit, 1U);
}

TEST(JudgeQueries, MeasuresEarlyAndLateTimesOfHits) {
  // True times 1/2, 1/4, 1/4, 1/8, 0, and a contact that is none.
  const DetectorScore score = score_of(
      kMeets + meets_at_one_nth(4) + meets_at_one_nth(4) + meets_at_one_nth(8) +
          falls("0,1", "1,1") + kMisses,
      in_turn(
          {{true, 0.25}, {true, 0.25}, {true, 0.75}, {true, 0.0625}, {true, 0.0}, {true, 0.5}}));
  const TimeErrors& times = score.times;
  EXPECT_EQ(times.timed, 5U);
  EXPECT_EQ(times.before, 2U);
  EXPECT_EQ(times.after, 1U);
  // Sorted: early 0, 0, 0, 1/16, 1/4; late 0, 0, 0, 0, 1/2.
  EXPECT_NEAR(times.early_max, 0.25, kImpactTimeWidth);
  EXPECT_NEAR(times.early_99, 0.0625, kImpactTimeWidth);
  EXPECT_EQ(times.early_median, 0);
  EXPECT_NEAR(times.late_max, 0.5, kImpactTimeWidth);
  EXPECT_EQ(times.late_99, 0);
  EXPECT_EQ(times.late_median, 0);
}

TEST(JudgeQueries, CallsTimesInTheTrueIntervalNeitherEarlyNorLate) {
  const DetectorScore score = score_of(kMeets + falls("1,1", "0,1") + meets_at_one_nth(3),
                                       in_turn({{true, 0.5}, {true, 1.0}, {true, 1.0 / 3}}));
  EXPECT_EQ(score.times.timed, 3U);
  EXPECT_EQ(score.times.before + score.times.after, 0U);
  EXPECT_EQ(score.times.early_max, 0);
  EXPECT_EQ(score.times.late_max, 0);
}

TEST(JudgeQueries, MeasuresNoTimeOfWhatReportsNone) {
  const DetectorScore score = score_of(kMeets + kMeets, in_turn({{true, {}}, {false, 0.5}}));
  EXPECT_EQ(score.times.timed, 0U);
  EXPECT_EQ(score.times.early_max, 0);
}

TEST(JudgeQueries, CountsTimesThatAreNoneAsErrorsAndNothingElse) {
  for (const double time :
       {kNan, -0.1, 1.5, std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(), 0x1.0000000000001p0, -0x1p-1074}) {
    const DetectorScore score =
        score_of(kMeets + kMeets + kMisses + kMeets,
                 in_turn({{true, 0.5}, {true, time}, {true, time}, {true, 0.5}}));
    EXPECT_EQ(score.errors, 2U) << time;
    EXPECT_EQ(score.first_error, 9U);
    EXPECT_EQ(score.first_error_is.rfind("a time of ", 0), 0U) << score.first_error_is;
    EXPECT_EQ(score.queries, 4U);
    expect_score(score.score, {2, 2, 2, 0, 0});
    EXPECT_EQ(score.times.timed, 2U);
    ASSERT_EQ(score.decades.size(), 1U);
    expect_score(score.decades[0].score, {2, 2, 2, 0, 0});
  }
}

TEST(JudgeQueries, PassesOverTheTimeOfNoContact) {
  const DetectorScore score = score_of(kMeets + kMisses, in_turn({{false, kNan}, {false, 7}}));
  EXPECT_EQ(score.errors, 0U);
  expect_score(score.score, {1, 0, 0, 1, 0});
}

/// Reports contact everywhere, with this tolerance of its own and in this answer.
QueryDetector near(const ImpactTolerance& tolerance, std::optional<double> of_answer = {},
                   std::optional<double> time = {}) {
  return detector(
      "near",
      [=](const ImpactQuery&) {
        return ReportedImpact{true, time, of_answer};
      },
      {kFace, kEdge}, Precision::kDouble, {}, tolerance);
}

/// Not nearer than an eighth, half a metre, 2 metres, and a contact; from a height of 4 metres.
const std::string kHeights =
    falls("4,1", "1,8") + falls("4,1", "1,2") + falls("4,1", "2,1") + falls("4,1", "0,1");

struct NearCase {
  ImpactTolerance tolerance, cap;
  std::optional<double> of_answer;
  std::uint64_t near, spurious;
  double near_max;
};

TEST(JudgeQueries, TellsReportsWithinTheToleranceFromSpuriousOnes) {
  const double none = kNoCap.absolute;
  const double below = std::nextafter(0.5, 0.0);
  for (const NearCase& c :
       {NearCase{{0, 0}, kNoCap, {}, 0, 3, 0}, NearCase{{0.5, 0}, kNoCap, {}, 2, 1, 0.5},
        NearCase{{below, 0}, kNoCap, {}, 1, 2, 0.125},
        NearCase{{10, 0}, {below, none}, {}, 1, 2, 0.125}, NearCase{{0, 0.5}, kNoCap, {}, 3, 0, 2},
        NearCase{{0, 0.5}, {none, 0.25}, {}, 2, 1, 0.5},
        NearCase{{0.5, 0.5}, {none, 0}, {}, 0, 3, 0},
        NearCase{{0, 0.5}, {0.5, none}, {}, 2, 1, 0.5}, NearCase{{1e9, 0}, kNoCap, {}, 3, 0, 2},
        NearCase{{0.5, 0}, kNoCap, 0.125, 1, 2, 0.125}, NearCase{{0, 0}, kNoCap, 2.0, 3, 0, 2},
        NearCase{{0, 0}, {0.25, none}, 2.0, 1, 2, 0.125}}) {
    const FileScore file = judged(kHeights, {near(c.tolerance, c.of_answer)}, kFace, c.cap);
    const ImpactScore& score = file.detectors.at(0).score;
    EXPECT_EQ(score.hit, 1U);
    EXPECT_EQ(score.reported, 4U);
    EXPECT_EQ(score.near, c.near) << c.tolerance.absolute << " " << c.tolerance.of_start;
    EXPECT_EQ(score.spurious, c.spurious);
    EXPECT_EQ(score.undecided, 0U);
    EXPECT_NEAR(score.near_max, c.near_max, 1e-12);
  }
}

TEST(JudgeQueries, NamesTheFirstSpuriousReportBehindNearOnes) {
  const DetectorScore score = score_of(kHeights, near({0.5, 0}));
  EXPECT_EQ(score.score.first_spurious, 17U);
}

TEST(JudgeQueries, CountsTolerancesThatAreNoneAsErrors) {
  for (const double tolerance : {kNan, -0x1p-1074, std::numeric_limits<double>::infinity()}) {
    const DetectorScore score = score_of(kHeights, near({}, tolerance));
    EXPECT_EQ(score.errors, 4U) << tolerance;
    EXPECT_EQ(score.first_error_is.rfind("a tolerance of ", 0), 0U) << score.first_error_is;
    EXPECT_EQ(score.score.reported, 0U);
  }
}

TEST(JudgeQueries, CallsAStartWithinTheToleranceNotEarly) {
  // All begin a metre above and meet half way.
  for (const auto& [tolerance, time, near_at_start] :
       {std::tuple{1.0, 0.0, 1U}, {std::nextafter(1.0, 0.0), 0.0, 0U}, {1.0, 0x1p-60, 0U}}) {
    const DetectorScore score = score_of(kMeets, near({tolerance, 0}, {}, time));
    EXPECT_EQ(score.score.hit, 1U);
    EXPECT_EQ(score.times.near_at_start, near_at_start) << tolerance << " " << time;
    EXPECT_EQ(score.times.timed, 1U - near_at_start);
    EXPECT_NEAR(score.times.early_max, near_at_start == 1 ? 0 : 0.5, kImpactTimeWidth);
  }
}

TEST(JudgeQueries, TellsNearFromSpuriousOnWhatItWasFed) {
  // Fed a metre higher: the contact is none any more.
  const Feed higher = [](const ImpactQuery& query) {
    ImpactQuery fed = query;
    fed.start[0].z() += 1;
    fed.end[0].z() += 1;
    return fed;
  };
  const Answers always = [](const ImpactQuery&) { return ReportedImpact{true}; };
  const DetectorScore score =
      score_of(kHeights, detector("fed", always, {kFace}, Precision::kSingle, higher, {1.25, 0}));
  EXPECT_EQ(score.score.near, 2U);
  EXPECT_EQ(score.score.spurious, 1U);
  ASSERT_TRUE(score.score_fed.has_value());
  EXPECT_EQ(score.score_fed->truth, 0U);
  EXPECT_EQ(score.score_fed->near, 2U);
  EXPECT_EQ(score.score_fed->spurious, 2U);
}

TEST(JudgeQueries, AsksNobodyInFloatsAboutWhatNoFloatHolds) {
  const Feed floats = [](const ImpactQuery& query) {
    ImpactQuery fed = query;
    for (auto* const points : {&fed.start, &fed.end})
      for (Vec3& point : *points) point = point.cast<float>().cast<double>();
    return fed;
  };
  auto asked = std::make_shared<int>(0);
  const Answers answers = [asked](const ImpactQuery&) {
    ++*asked;
    return ReportedImpact{true};
  };
  const std::string largest = "340282346638528859811704183484516925440", next = largest + "0";
  const std::string text =
      falls(largest + ",1", "-1,1") + falls(next + ",1", "-1,1") + falls("1,1", "-" + next + ",1");
  const DetectorScore score =
      score_of(text, detector("floats", answers, {kFace}, Precision::kSingle, floats));
  EXPECT_EQ(*asked, 1);
  EXPECT_EQ(score.refused, 2U);
  EXPECT_EQ(score.score_fed.value().hit, 1U);
}

TEST(JudgeQueries, AsksADetectorThatFailedNoMore) {
  auto asked = std::make_shared<int>(0);
  const auto failing = detector("failing", [asked](const ImpactQuery&) -> ReportedImpact {
    if (++*asked == 3) throw std::runtime_error("out of order");
    return {true, 0.5};
  });
  std::string text;
  for (int i = 0; i < 5000; ++i) text += kMeets;
  const DetectorScore score = score_of(text, failing);
  EXPECT_EQ(*asked, 3);
  EXPECT_EQ(score.failure, "out of order");
  EXPECT_EQ(score.failed_at, 17U);
  EXPECT_EQ(score.queries, 2U);
  expect_score(score.score, {2, 2, 2, 0, 0});
}

TEST(JudgeQueries, JudgesSinglePrecisionOnWhatItWasFedAsWell) {
  // Fed: the vertex two metres higher. Then the first query ends above, and the others as they were
  // or in contact: the last one, below the triangle all the time, goes from -1 to 0.
  const Feed higher = [](const ImpactQuery& query) {
    ImpactQuery fed = query;
    fed.start[0].z() += 2;
    fed.end[0].z() += 2;
    return fed;
  };
  const Answers below = [](const ImpactQuery& query) {
    return ReportedImpact{query.end[0].z() < -1, {}};
  };
  const std::string text = kMeets + meets_at_one_nth(4) + kMisses + falls("-3,1", "-2,1");
  const DetectorScore single =
      score_of(text, detector("single", below, {kFace}, Precision::kSingle, higher));
  EXPECT_EQ(single.precision, Precision::kSingle);
  expect_score(single.score, {2, 2, 1, 1, 1});
  EXPECT_EQ(single.score.first_missed, 1U);
  EXPECT_EQ(single.score.first_spurious, 25U);
  ASSERT_TRUE(single.score_fed.has_value());
  expect_score(*single.score_fed, {2, 2, 2, 0, 0});
  EXPECT_EQ(single.score_fed->first_missed, std::nullopt);
  const DetectorScore plain =
      score_of(text, detector("double", below, {kFace}, Precision::kDouble, higher));
  EXPECT_FALSE(plain.score_fed.has_value()) << "a double is fed what it is asked";
  expect_score(plain.score, {2, 2, 1, 1, 1});
}

TEST(JudgeQueries, CountsByTheLongestEdge) {
  // The longest edges are the square root of 2 times 4, 400 and 1/256.
  const std::string small = "1,256", large = "400,1";
  const std::string in_small = "1,1024,1,1024,1,1\n0,1,0,1,0,1\n" + small + ",0,1,0,1\n0,1," +
                               small + ",0,1\n1,1024,1,1024,-1,1\n0,1,0,1,0,1\n" + small +
                               ",0,1,0,1\n0,1," + small + ",0,1\n";
  const std::string point = falls("1,1", "-1,1", "0,1");
  const DetectorScore score = score_of(
      falls("1,1", "-1,1", large) + in_small + kMeets + kMisses + point + in_small,
      in_turn({{true, 0.25}, {false, {}}, {true, 0.75}, {true, {}}, {false, {}}, {true, 0.5}}));
  ASSERT_EQ(score.decades.size(), 4U);
  EXPECT_EQ(score.decades[0].decade, std::nullopt) << "the triangle is a point";
  expect_score(score.decades[0].score, {0, 0, 0, 0, 0});
  EXPECT_EQ(score.decades[1].decade, -3);
  expect_score(score.decades[1].score, {2, 1, 1, 1, 0});
  EXPECT_EQ(score.decades[1].score.first_missed, 9U);
  EXPECT_EQ(score.decades[1].early_max, 0);
  EXPECT_EQ(score.decades[2].decade, 0);
  expect_score(score.decades[2].score, {1, 2, 1, 0, 1});
  EXPECT_NEAR(score.decades[2].late_max, 0.25, kImpactTimeWidth);
  EXPECT_EQ(score.decades[3].decade, 2);
  expect_score(score.decades[3].score, {1, 1, 1, 0, 0});
  EXPECT_NEAR(score.decades[3].early_max, 0.25, kImpactTimeWidth);
}

TEST(JudgeQueries, CountsLengthsBeyondTheLargestDouble) {
  const std::string large = mpz_class((mpz_class(1) << 1024) - (mpz_class(1) << 971)).get_str();
  const std::string edges = "-" + large + ",1,0,1,0,1\n" + large + ",1,0,1,0,1\n";
  const FileScore score = judged(edges + edges + edges + edges, {in_turn({{true, 0.0}})}, kEdge);
  ASSERT_EQ(score.detectors.at(0).decades.size(), 1U);
  EXPECT_EQ(score.detectors[0].decades[0].decade, 308);
}

TEST(JudgeQueries, TakesTheLongerOfTwoEdges) {
  // Edges of 1 and of 30 metres that cross.
  const std::string edges =
      "-1,2,0,1,1,1\n1,2,0,1,1,1\n0,1,-15,1,0,1\n0,1,15,1,0,1\n"
      "-1,2,0,1,-1,1\n1,2,0,1,-1,1\n0,1,-15,1,0,1\n0,1,15,1,0,1\n";
  const FileScore score = judged(edges, {in_turn({{true, 0.5}})}, kEdge);
  EXPECT_EQ(score.contacts, 1U);
  ASSERT_EQ(score.detectors.at(0).decades.size(), 1U);
  EXPECT_EQ(score.detectors[0].decades[0].decade, 1);
}

TEST(JudgeQueries, LeavesOutDetectorsOfTheOtherKind) {
  const Answers never = [](const ImpactQuery&) -> ReportedImpact {
    throw std::logic_error("asked");
  };
  const Answers no = [](const ImpactQuery&) { return ReportedImpact{}; };
  const std::vector<QueryDetector> detectors = {
      detector("edges", never, {kEdge}), detector("both", no), detector("faces", no, {kFace})};
  const FileScore score = judged(kMeets, detectors);
  ASSERT_EQ(score.detectors.size(), 2U);
  EXPECT_EQ(score.of_another_kind, (std::vector<std::string>{"edges"}));
  EXPECT_EQ(score.detectors[0].detector, "both");
  EXPECT_EQ(score.detectors[1].detector, "faces");
}

TEST(JudgeQueries, AsksNobodyWhatIsInNoDoubles) {
  const DetectorScore score =
      score_of(falls("1,3", "-1,3") + kMeets + falls("1,3", "2,3"), in_turn({{false, {}}}));
  EXPECT_EQ(score.queries, 3U);
  EXPECT_EQ(score.refused, 2U);
  expect_score(score.score, {1, 0, 0, 1, 0});
  EXPECT_EQ(score.score.first_missed, 9U);
  EXPECT_EQ(score.cost.worst_line, 9U);
}

TEST(JudgeQueries, CountsWhatADetectorRefusesAndNothingElse) {
  auto asked = std::make_shared<int>(0);
  const DetectorScore score =
      score_of(kMeets + kMeets + kMisses + falls("1,3", "-1,3"),
               detector("refuses", [asked](const ImpactQuery&) -> ReportedImpact {
                 if (++*asked == 1) throw RefusedInput("not this one");
                 return {};
               }));
  EXPECT_EQ(score.queries, 4U);
  EXPECT_EQ(score.refused, 2U);
  EXPECT_EQ(score.errors, 0U);
  expect_score(score.score, {1, 0, 0, 1, 0});
  EXPECT_EQ(score.score.first_missed, 9U);
  EXPECT_NE(score.cost.worst_line, 1U);
}

TEST(JudgeQueries, CountsTruthsOfTheFileAndNamesTheFirstWrongOnes) {
  std::string text;
  for (int i = 0; i < 8; ++i) text += falls("1,1", "-1,1", "4,1", i % 4 == 0 ? "1" : "0");
  const FileScore score = judged(text, {});
  EXPECT_EQ(score.file_truths, 8U);
  EXPECT_EQ(score.file_wrong, 6U);
  EXPECT_EQ(score.wrong_lines, (std::vector<std::size_t>{9, 17, 25, 41, 49})) << "five are named";
}

TEST(JudgeQueries, JudgesTruthsOfQueriesThatAreInNoDoubles) {
  const FileScore score =
      judged(falls("1,3", "-1,3", "4,1", "1") + falls("1,3", "-1,3", "4,1", "0"), {});
  EXPECT_EQ(score.file_truths, 2U);
  EXPECT_EQ(score.wrong_lines, (std::vector<std::size_t>{9}));
}

/// What is said of two queries with these truths beside them.
std::string said_of_truths(const std::string& truths) {
  const Scratch scratch;
  const auto file = scratch.write("q.csv", kMeets + kMisses);
  const auto truth = scratch.write("t.json", truths);
  std::string sentence = sentence_of([&] { judge_queries({file, kFace, truth}, {}); });
  for (const auto& [path, name] : {std::pair{file, "FILE"}, {truth, "TRUTH"}})
    for (std::size_t at; (at = sentence.find(path.string())) != std::string::npos;)
      sentence.replace(at, path.string().size(), name);
  return sentence;
}

TEST(JudgeQueries, NeedsOneTruthForEachQuery) {
  EXPECT_EQ(said_of_truths("[true, false]"), "");
  EXPECT_EQ(said_of_truths("[true]"), "TRUTH: 1 truth, and FILE has more queries");
  EXPECT_EQ(said_of_truths("[]"), "TRUTH: 0 truths, and FILE has more queries");
  EXPECT_EQ(said_of_truths("[true, false, true]"), "TRUTH: 3 truths, and FILE has 2 queries");
}

TEST(JudgeQueries, TakesTheTruthBesideTheFileBeforeThatInIt) {
  const Scratch scratch;
  const auto file = scratch.write("q.csv", falls("1,1", "-1,1", "4,1", "0"));
  EXPECT_EQ(judge_queries({file, kFace, std::nullopt}, {}).file_wrong, 1U);
  EXPECT_EQ(judge_queries({file, kFace, scratch.write("t.json", "[true]")}, {}).file_wrong, 0U);
}

TEST(JudgeQueries, AddsUpOverBlocks) {
  // 5000 queries, more than are read at once. Every third one meets, and its truth says so but for
  // the last. A detector says yes to every second one, at 1/4; another one to all, at 1.
  constexpr std::size_t kQueries = 5000;
  std::string text, truths = "[";
  for (std::size_t i = 0; i < kQueries; ++i) {
    text += i % 3 == 0 ? kMeets : kMisses;
    truths += std::string(i == 0 ? "" : ",") + (i % 3 == 0 && i != 4998 ? "true" : "false");
  }
  const Scratch scratch;
  auto asked = std::make_shared<std::size_t>(0);
  const QueryDetector second = detector("second", [asked](const ImpactQuery&) {
    const std::size_t i = (*asked)++;
    return i % 2 == 0 ? ReportedImpact{true, 0.25} : ReportedImpact{};
  });
  const QueryDetector all = detector("all", [](const ImpactQuery&) {
    return ReportedImpact{true, 1.0};
  });
  const FileScore score = judge_queries(
      {scratch.write("q.csv", text), kFace, scratch.write("t.json", truths + "]")}, {second, all});
  EXPECT_EQ(score.queries, kQueries);
  EXPECT_EQ(score.contacts, 1667U);
  EXPECT_EQ(score.file_truths, kQueries);
  EXPECT_EQ(score.wrong_lines, (std::vector<std::size_t>{4998 * 8 + 1}));
  ASSERT_EQ(score.detectors.size(), 2U);
  const DetectorScore& one = score.detectors[0];
  EXPECT_EQ(one.queries, kQueries);
  expect_score(one.score, {1667, 2500, 834, 833, 1666});
  EXPECT_EQ(one.score.first_missed, 3 * 8 + 1U);
  EXPECT_EQ(one.score.first_spurious, 2 * 8 + 1U);
  EXPECT_EQ(one.times.timed, 834U);
  EXPECT_EQ(one.times.before, 834U);
  EXPECT_NEAR(one.times.early_median, 0.25, 0x1p-25);
  const DetectorScore& two = score.detectors[1];
  expect_score(two.score, {1667, 5000, 1667, 0, 3333});
  EXPECT_EQ(two.times.after, 1667U);
  EXPECT_NEAR(two.times.late_99, 0.5, 0x1p-24);
}

TEST(JudgeQueries, NamesTheFirstWrongAnswerOfALaterBlock) {
  std::string text;
  for (int i = 0; i < 4100; ++i) text += kMisses;
  auto asked = std::make_shared<int>(0);
  const DetectorScore score = score_of(text, detector("late", [asked](const ImpactQuery&) {
                                         return ReportedImpact{++*asked > 4097, kNan};
                                       }));
  EXPECT_EQ(score.errors, 3U);
  EXPECT_EQ(score.first_error, 4097 * 8 + 1U);
}

TEST(JudgeQueries, MeasuresTheCostOfEachQuery) {
  // One of a hundred takes a tenth of a second.
  std::string text;
  for (int i = 0; i < 100; ++i) text += kMisses;
  auto asked = std::make_shared<int>(0);
  const DetectorScore score =
      score_of(text, detector("slow", [asked](const ImpactQuery&) {
                 if (++*asked == 71) std::this_thread::sleep_for(std::chrono::milliseconds(100));
                 return ReportedImpact{};
               }));
  EXPECT_GE(score.cost.worst, 99'000);
  EXPECT_EQ(score.cost.worst_line, 70 * 8 + 1U);
  EXPECT_GE(score.cost.mean, 990);
  EXPECT_LT(score.cost.percentile_99, 99'000);
  EXPECT_LE(score.cost.median, score.cost.percentile_99);
}

TEST(JudgeQueries, NamesTheLineOfABadQueryInALaterBlock) {
  std::string text;
  for (int i = 0; i < 4100; ++i) text += kMisses;
  const std::string sentence = sentence_of([&] { judged(text + "x\n", {}); });
  EXPECT_NE(sentence.find(", line 32801: "), std::string::npos) << sentence;
}

}  // namespace
}  // namespace contactcheck::queries
