#include "reference/queries/query_report.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace contactcheck::queries {
namespace {

using Json = nlohmann::json;

/// Truth, reported, hit, missed, spurious, and the first lines of the last two.
ImpactScore counts(const std::array<std::uint64_t, 5>& n, std::optional<std::size_t> first_missed,
                   std::optional<std::size_t> first_spurious) {
  ImpactScore score;
  score.truth = n[0];
  score.reported = n[1];
  score.hit = n[2];
  score.missed = n[3];
  score.spurious = n[4];
  score.first_missed = first_missed;
  score.first_spurious = first_spurious;
  return score;
}

/// Two detectors, one of them right, on queries of two sizes.
FileScore score_by_hand() {
  DetectorScore exact;
  exact.detector = "exact";
  exact.queries = 1234;
  exact.score = counts({700, 700, 700, 0, 0}, std::nullopt, std::nullopt);
  exact.times = {700, 0, 3, 2, 1e-13, 2e-13, 4.5e-13, 0, 0, 2e-14};
  exact.cost = {0.254, 1.5, 9.875, 123.4, 801};
  exact.decades = {
      {-2, counts({600, 600, 600, 0, 0}, std::nullopt, std::nullopt), 4.5e-13, 2e-14, 0, 0, 0},
      {0, counts({100, 100, 100, 0, 0}, std::nullopt, std::nullopt), 0, 0, 0, 0, 0}};
  DetectorScore single;
  single.detector = "single";
  single.precision = Precision::kSingle;
  single.queries = 1234;
  single.refused = 34;
  single.score = counts({690, 500, 400, 290, 100}, 9, 17);
  single.score_fed = counts({500, 500, 499, 1, 1}, 25, 33);
  single.cost = {0.1, 0.2, 0.3, 12, 17};
  single.errors = 10;
  single.first_error = 41;
  single.first_error_is = "a time of nan";
  single.tolerance = {0.5, 0.25};
  single.decades = {{std::nullopt, counts({0, 1, 0, 0, 1}, std::nullopt, 17), 0, 0, 0, 0, 0},
                    {-2, counts({600, 410, 311, 289, 99}, 9, 49), 0, 0, 0, 0, 0},
                    {0, counts({90, 89, 89, 1, 0}, 57, std::nullopt), 0, 0, 0, 0, 0}};
  FileScore file;
  file.name = "some/vf.csv";
  file.queries = 1234;
  file.contacts = 700;
  file.starts_in_contact = 12;
  file.not_doubles = 34;
  file.file_truths = 1234;
  file.file_wrong = 3;
  file.wrong_lines = {1, 9, 801};
  file.decades = {{std::nullopt, 1, 0}, {-2, 600, 600}, {0, 100, 100}};
  file.oracle = {5, 25, 250, 1000.4, 9};
  file.detectors = {exact, single};
  return file;
}

TEST(QueryText, HasARowForEachDetectorAndSize) {
  EXPECT_EQ(text_of(score_by_hand()),
            R"(some/vf.csv: vertex-face, 1234 queries, 700 contacts (12 at the start)
  the file's own truth: 3 of 1234 wrong, at lines 1, 9, 801
  34 queries with coordinates that are no doubles: judged, and no detector asked
  detector                         missed  spurious    early     late  median us  mean us  99 % us  worst us  at line
  exact                                 0         0  4.5e-13  2.0e-14       0.25     1.50     9.88       123      801
  single (34 refused) (10 errors)     290       100        -        -       0.10     0.20     0.30     12.00       17
    as given (500 contacts)             1         1
  (oracle)                                                                  5.00    25.00      250      1000        9
  first of single: missed at line 9, spurious at line 17, error at line 41 (a time of nan)

  missed / spurious by longest edge, m  contacts    single
  0 (points)                                   0     0 / 1
  1e-2 to 1e-1                               600  289 / 99
  1e0 to 1e1                                 100     1 / 0
)");
}

TEST(QueryText, OfOneQueryWithNothingWrongIsShort) {
  FileScore file;
  file.name = "ee.csv";
  file.kind = ImpactKind::edge_edge;
  file.queries = file.contacts = file.file_truths = 1;
  file.oracle = {1, 1, 1, 1, 1};
  DetectorScore exact;
  exact.detector = "exact";
  exact.queries = 1;
  exact.score = counts({1, 1, 1, 0, 0}, std::nullopt, std::nullopt);
  exact.times.timed = 1;
  exact.cost = {1, 1, 1, 1, 1};
  exact.decades = {{0, exact.score, 0, 0, 0, 0, 0}};
  file.detectors = {exact};
  EXPECT_EQ(text_of(file), R"(ee.csv: edge-edge, 1 query, 1 contact
  the file's own truth: all 1 right
  detector  missed  spurious  early  late  median us  mean us  99 % us  worst us  at line
  exact          0         0      0     0       1.00     1.00     1.00      1.00        1
  (oracle)                                      1.00     1.00     1.00      1.00        1
)");
}

TEST(QueryText, OfWhatWasAllRefusedHasNoNumbers) {
  FileScore file = score_by_hand();
  file.detectors.resize(1);
  file.detectors[0] = {};
  file.detectors[0].detector = "exact";
  file.detectors[0].queries = file.detectors[0].refused = 8;
  EXPECT_NE(text_of(file).find("\n  exact (all refused)       -         -      -     -          -"
                               "        -        -         -        -\n"),
            std::string::npos)
      << text_of(file);
}

TEST(QueryText, SaysNothingOfATruthThatTheFileHasNot) {
  FileScore file = score_by_hand();
  file.file_truths = file.file_wrong = file.starts_in_contact = file.not_doubles = 0;
  const std::string text = text_of(file);
  EXPECT_EQ(text.find("truth"), std::string::npos) << text;
  EXPECT_EQ(text.find("at the start"), std::string::npos) << text;
  EXPECT_EQ(text.find("doubles"), std::string::npos) << text;
}

TEST(QueryText, ShowsSizesOfAllDetectorsThatAreWrong) {
  FileScore file = score_by_hand();
  file.detectors[0].score.missed = 5;
  file.detectors[0].decades[1].score.missed = 5;
  std::swap(file.detectors[0], file.detectors[1]);
  const std::string text = text_of(file);
  const std::size_t begin = text.find("  missed / spurious by");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_EQ(text.substr(begin),
            R"(  missed / spurious by longest edge, m  contacts    single  exact
  0 (points)                                   0     0 / 1      -
  1e-2 to 1e-1                               600  289 / 99  0 / 0
  1e0 to 1e1                                 100     1 / 0  5 / 0
)");
}

TEST(QueryText, HasAColumnOfNearOnesWhereThereAreSome) {
  FileScore file = score_by_hand();
  file.detectors[1].refused = file.detectors[1].errors = 0;
  file.detectors[1].score.near = 7;
  file.detectors[1].score.near_max = 1.25e-6;
  file.detectors[1].score_fed->undecided = 2;
  const std::string text = text_of(file);
  const std::size_t begin = text.find("  detector");
  EXPECT_EQ(
      text.substr(begin, text.find("  (oracle)") - begin),
      R"(  detector                   missed  spurious           near    early     late  median us  mean us  99 % us  worst us  at line
  exact                           0         0              0  4.5e-13  2.0e-14       0.25     1.50     9.88       123      801
  single                        290       100  7 (1.3e-06 m)        -        -       0.10     0.20     0.30     12.00       17
    as given (500 contacts)       1         1        0 + 2 ?
)");
}

TEST(QueryText, SaysWhereADetectorFailedAndWhy) {
  FileScore file = score_by_hand();
  file.detectors.resize(1);
  file.detectors[0].failure = "ended in signal 11 (Segmentation fault)";
  file.detectors[0].failed_at = 801;
  const std::string text = text_of(file);
  EXPECT_NE(text.find("\n  exact (failed after 1234)  "), std::string::npos) << text;
  EXPECT_NE(text.find("\n  exact failed at line 801 and was asked no more: ended in signal 11 "
                      "(Segmentation fault)\n"),
            std::string::npos)
      << text;
}

TEST(QueryText, OfAFamilyHasARowForEachValue) {
  QueryFamily family;
  family.id = "small-vf";
  family.title = "a vertex falls onto a triangle";
  family.parameter = "edge, m";
  family.values = {1, 0.001};
  FileScore right, wrong = score_by_hand();
  right.queries = right.contacts = 1;
  right.detectors.resize(2);
  right.detectors[0].detector = "exact";
  right.detectors[1].detector = "single";
  right.detectors[1].times.early_max = right.detectors[1].times.late_max = 9e-7;
  wrong.detectors[1].times.early_max = 0.25;
  wrong.detectors[1].times.late_max = 1;
  EXPECT_EQ(text_of(family, {right, wrong}), R"(small-vf: a vertex falls onto a triangle
  edge, m  queries  contacts  exact                                                                        single
  1              1         1     ok                                                                            ok
  0.001       1234       700     ok  290 missed, 100 spurious, early 2.5e-01, late 1.0e+00, 10 errors, 34 refused
  single at 0.001, query 41: a time of nan
)");
}

TEST(QueryText, OfAFamilySaysWhereAndWhyADetectorFirstFailed) {
  QueryFamily family;
  family.id = "small-vf";
  family.values = {1, 0.1};
  FileScore right = score_by_hand();
  right.detectors.resize(1);
  FileScore failed = right;
  failed.detectors[0].failure = "ended in signal 11";
  failed.detectors[0].failed_at = 17;
  const std::string text = text_of(family, {right, failed});
  EXPECT_NE(text.find("\n  exact at 0.1, query 17: ended in signal 11\n"), std::string::npos)
      << text;
  EXPECT_EQ(text_of(family, {failed, failed}).find("exact at 0.1"), std::string::npos)
      << "the first alone";
}

TEST(QueryText, NamesDetectorsOfAnotherKindAndHitsWithinTheToleranceAtTheStart) {
  FileScore file = score_by_hand();
  file.of_another_kind = {"edges", "more"};
  file.detectors[1].times.near_at_start = 3;
  const std::string text = text_of(file);
  EXPECT_NE(text.find("not asked, since they do not answer vertex-face: edges, more\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("single: 3 contacts reported at t = 0, where"), std::string::npos) << text;
}

TEST(QueryText, SummaryHasTheFirstValueAtWhichADetectorErrs) {
  QueryFamily family;
  family.id = "small-vf";
  family.parameter = "edge, m";
  family.values = {1, 0.1, 0.001};
  QueryFamily edges = family;
  edges.id = "small-ee";
  edges.values = {1};
  FileScore right = score_by_hand();
  right.detectors[0].times = {};
  right.detectors[1] = right.detectors[0];
  right.detectors[1].detector = "single";
  FileScore wrong = right;
  wrong.detectors[1].score.missed = 1;
  FileScore of_edges = right;
  of_edges.detectors.resize(1);
  EXPECT_EQ(summary_of({family, edges}, {right, wrong, wrong, of_edges}),
            R"(First value of each family at which a detector errs (ok: at none; near is no error)
  family    parameter  exact  single
  small-vf    edge, m     ok     0.1
  small-ee    edge, m     ok       -
)");
}

TEST(QueryJson, HasEveryFieldOfAScore) {
  const Json document = Json::parse(json_of({score_by_hand()}));
  EXPECT_EQ(document.at("schema"), "contactcheck-queries/1");
  EXPECT_FALSE(document.at("version").get<std::string>().empty());
  EXPECT_FALSE(document.contains("cap"));
  const Json capped = Json::parse(json_of({}, {0.5, 0.125}));
  EXPECT_EQ(capped.at("cap"), 0.5);
  EXPECT_EQ(capped.at("cap_of_start"), 0.125);
  ASSERT_EQ(document.at("files").size(), 1U);
  const Json& file = document["files"][0];
  Json head = file;
  head.erase("detectors");
  EXPECT_EQ(head, Json::parse(R"({
    "name": "some/vf.csv", "kind": "vertex-face", "queries": 1234, "contacts": 700,
    "starts_in_contact": 12, "not_doubles": 34, "file_truths": 1234, "file_wrong": 3,
    "wrong_lines": [1, 9, 801],
    "decades": [{"decade": null, "queries": 1, "contacts": 0},
                {"decade": -2, "queries": 600, "contacts": 600},
                {"decade": 0, "queries": 100, "contacts": 100}],
    "oracle_microseconds":
      {"median": 5.0, "mean": 25.0, "percentile_99": 250.0, "worst": 1000.4, "worst_line": 9}})"));
  ASSERT_EQ(file.at("detectors").size(), 2U);
  EXPECT_EQ(file["detectors"][0], Json::parse(R"({
    "detector": "exact", "precision": "double", "queries": 1234, "refused": 0,
    "score": {"truth": 700, "reported": 700, "hit": 700, "missed": 0, "spurious": 0, "near": 0,
        "undecided": 0, "near_max": 0.0},
    "time_of_contact": {"timed": 700, "near_at_start": 0, "before": 3, "after": 2, "early_median": 1e-13,
      "early_99": 2e-13, "early_max": 4.5e-13, "late_median": 0.0, "late_99": 0.0,
      "late_max": 2e-14},
    "microseconds":
      {"median": 0.254, "mean": 1.5, "percentile_99": 9.875, "worst": 123.4, "worst_line": 801},
    "errors": 0, "tolerance": {"absolute": 0.0, "of_start": 0.0},
    "decades": [
      {"decade": -2, "score": {"truth": 600, "reported": 600, "hit": 600, "missed": 0, "spurious": 0, "near": 0,
        "undecided": 0, "near_max": 0.0},
       "timed": 0, "early_max": 4.5e-13, "late_max": 2e-14,
       "answered": 0, "micros": 0.0},
      {"decade": 0, "score": {"truth": 100, "reported": 100, "hit": 100, "missed": 0, "spurious": 0, "near": 0,
        "undecided": 0, "near_max": 0.0},
       "timed": 0, "early_max": 0.0, "late_max": 0.0, "answered": 0, "micros": 0.0}]})"));
  EXPECT_EQ(file["detectors"][1], Json::parse(R"({
    "detector": "single", "precision": "single", "queries": 1234, "refused": 34,
    "score": {"truth": 690, "reported": 500, "hit": 400, "missed": 290, "spurious": 100, "near": 0,
        "undecided": 0, "near_max": 0.0,
      "first_missed": 9, "first_spurious": 17},
    "score_fed": {"truth": 500, "reported": 500, "hit": 499, "missed": 1, "spurious": 1, "near": 0,
        "undecided": 0, "near_max": 0.0,
      "first_missed": 25, "first_spurious": 33},
    "time_of_contact": {"timed": 0, "near_at_start": 0, "before": 0, "after": 0, "early_median": 0.0, "early_99": 0.0,
      "early_max": 0.0, "late_median": 0.0, "late_99": 0.0, "late_max": 0.0},
    "microseconds":
      {"median": 0.1, "mean": 0.2, "percentile_99": 0.3, "worst": 12.0, "worst_line": 17},
    "errors": 10, "first_error": 41, "first_error_is": "a time of nan",
    "tolerance": {"absolute": 0.5, "of_start": 0.25},
    "decades": [
      {"decade": null, "score": {"truth": 0, "reported": 1, "hit": 0, "missed": 0, "spurious": 1, "near": 0,
        "undecided": 0, "near_max": 0.0,
        "first_spurious": 17}, "timed": 0, "early_max": 0.0, "late_max": 0.0, "answered": 0, "micros": 0.0},
      {"decade": -2, "score": {"truth": 600, "reported": 410, "hit": 311, "missed": 289,
        "spurious": 99, "near": 0,
        "undecided": 0, "near_max": 0.0, "first_missed": 9, "first_spurious": 49}, "timed": 0, "early_max": 0.0, "late_max": 0.0, "answered": 0, "micros": 0.0},
      {"decade": 0, "score": {"truth": 90, "reported": 89, "hit": 89, "missed": 1, "spurious": 0, "near": 0,
        "undecided": 0, "near_max": 0.0,
        "first_missed": 57}, "timed": 0, "early_max": 0.0, "late_max": 0.0, "answered": 0, "micros": 0.0}]})"));
}

TEST(QueryJson, KeepsFilesInTheirOrderAndEndsWithALine) {
  FileScore first, second;
  first.name = "b/ee.csv";
  first.kind = ImpactKind::edge_edge;
  second.name = "a/vf.csv";
  const std::string text = json_of({first, second});
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(text.rfind("{\n \"schema\": \"contactcheck-queries/1\",", 0), 0U) << text;
  const Json document = Json::parse(text);
  EXPECT_EQ(document["files"][0]["name"], "b/ee.csv");
  EXPECT_EQ(document["files"][0]["kind"], "edge-edge");
  EXPECT_EQ(document["files"][1]["name"], "a/vf.csv");
  EXPECT_TRUE(document["files"][1]["detectors"].empty());
  EXPECT_FALSE(document["files"][1].contains("wrong_lines"));
}

}  // namespace
}  // namespace contactcheck::queries
