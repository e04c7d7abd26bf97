#include "reference/queries/query_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>

#include "tests/reference/scene/scratch.h"

namespace contactcheck::queries {
namespace {

using test::Scratch;
using test::sentence_of;

const std::string kOrigin = "0,1,0,1,0,1";

/// `row` eight times, with others in place of some.
std::string query_text(const std::string& row,
                       const std::vector<std::pair<std::size_t, std::string>>& others = {}) {
  std::vector<std::string> rows(8, row);
  for (const auto& [place, other] : others) rows[place] = other;
  std::string text;
  for (const std::string& line : rows) text += line + "\n";
  return text;
}

std::vector<FileQuery> read_all(const std::filesystem::path& file,
                                ImpactKind kind = ImpactKind::vertex_triangle) {
  QueryReader reader(file, kind);
  std::vector<FileQuery> queries;
  for (FileQuery query; reader.next(query);) queries.push_back(query);
  return queries;
}

std::vector<FileQuery> read_text(const std::string& text) {
  const Scratch scratch;
  return read_all(scratch.write("q.csv", text));
}

/// What is said behind the name of the file.
std::string refusal_of(const std::string& text) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.write("q.csv", text);
  const std::string sentence = sentence_of([&] { read_all(file); });
  EXPECT_EQ(sentence.rfind(file.string(), 0), 0U) << sentence;
  return sentence.substr(std::min(sentence.size(), file.string().size()));
}

/// The x of the first point, of a query in which everything else is 0.
FileQuery with_first_x(const std::string& numerator, const std::string& denominator) {
  const auto queries =
      read_text(query_text(kOrigin, {{0, numerator + "," + denominator + ",0,1,0,1"}}));
  EXPECT_EQ(queries.size(), 1U);
  return queries.at(0);
}

/// -1 if it is not in doubles.
double double_of(const std::string& numerator, const std::string& denominator) {
  const FileQuery query = with_first_x(numerator, denominator);
  return query.in_doubles ? query.query.start[0].x() : -1;
}

std::string power_of_two(unsigned exponent) {
  return mpz_class(mpz_class(1) << exponent).get_str();
}

TEST(QueryReader, PutsEachNumberInItsPlace) {
  std::string text;
  for (int row = 0; row < 8; ++row)
    text += std::to_string(3 * row) + ",1," + std::to_string(3 * row + 1) + ",1," +
            std::to_string(3 * row + 2) + ",1\n";
  const auto queries = read_text(text);
  ASSERT_EQ(queries.size(), 1U);
  EXPECT_TRUE(queries[0].in_doubles);
  for (int point = 0; point < 4; ++point)
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(point);
      EXPECT_EQ(queries[0].query.start[i][axis], 3 * point + axis);
      EXPECT_EQ(queries[0].query.end[i][axis], 3 * (point + 4) + axis);
    }
}

TEST(QueryReader, SaysKindAndFirstLineOfEachQuery) {
  const Scratch scratch;
  const auto file = scratch.write("q.csv", query_text(kOrigin) + query_text("1,1,1,1,1,1"));
  for (const ImpactKind kind : {ImpactKind::vertex_triangle, ImpactKind::edge_edge}) {
    const auto queries = read_all(file, kind);
    ASSERT_EQ(queries.size(), 2U);
    EXPECT_EQ(queries[0].line, 1U);
    EXPECT_EQ(queries[1].line, 9U);
    EXPECT_EQ(queries[1].query.kind, kind);
  }
}

TEST(QueryReader, TakesTheTruthFromASeventhColumn) {
  EXPECT_EQ(read_text(query_text(kOrigin)).at(0).truth, std::nullopt);
  const auto queries = read_text(query_text(kOrigin + ",1") + query_text(kOrigin + ",0"));
  ASSERT_EQ(queries.size(), 2U);
  EXPECT_EQ(queries[0].truth, true);
  EXPECT_EQ(queries[1].truth, false);
}

TEST(QueryReader, PassesOverBlanksCarriageReturnsAndTheMissingEndOfTheLastLine) {
  for (const char* row : {"1 , 2 ,0,1,\t0,1", " 1,2,0,1,0,1 ", "1,2,0,1,0,1\r", "1,2,0,1,0,1 \r"})
    EXPECT_EQ(read_text(query_text(row)).at(0).query.end[3].x(), 0.5) << row;
  const auto with_truth = read_text(query_text("1,2,0,1,0,1, 1\r"));
  EXPECT_EQ(with_truth.at(0).truth, true);
  std::string text = query_text("1,2,0,1,0,1");
  text.pop_back();
  EXPECT_EQ(read_text(text).size(), 1U);
}

TEST(QueryReader, PassesOverBlankLinesBetweenQueries) {
  const std::string query = query_text(kOrigin);
  const auto queries = read_text("\n" + query + " \r\n\n" + query + "\n\n");
  ASSERT_EQ(queries.size(), 2U);
  EXPECT_EQ(queries[0].line, 2U);
  EXPECT_EQ(queries[1].line, 12U);
}

TEST(QueryReader, ReadsFractionsOfAnySizeThatAreDoubles) {
  EXPECT_EQ(double_of("3", "4"), 0.75);
  EXPECT_EQ(double_of("-3", "4"), -0.75);
  EXPECT_EQ(double_of("10", "4"), 2.5) << "reducible";
  EXPECT_EQ(double_of("6", "3"), 2) << "reducible to a whole number";
  EXPECT_EQ(double_of("-7", "14"), -0.5);
  EXPECT_EQ(double_of("7", "-14"), -0.5) << "a sign below";
  EXPECT_EQ(double_of("-7", "-14"), 0.5);
  EXPECT_EQ(double_of("0", "5"), 0);
  EXPECT_EQ(double_of(power_of_two(60), "1024"), 0x1p50);
  EXPECT_EQ(double_of(power_of_two(53), "1"), 0x1p53);
  EXPECT_EQ(double_of("9007199254740991", power_of_two(62)), 0x1.fffffffffffffp-10);
  EXPECT_EQ(double_of("18014398509481982", "2"), 0x1.fffffffffffffp52) << "54 bits, but even";
  EXPECT_EQ(double_of(power_of_two(64), power_of_two(64)), 1);
  EXPECT_EQ(double_of("1", power_of_two(63)), 0x1p-63);
}

TEST(QueryReader, ReadsTheLargestAndTheLeastDoubles) {
  EXPECT_EQ(double_of("1", power_of_two(1074)), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(double_of("-3", power_of_two(1074)), -3 * std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(double_of("1", power_of_two(1022)), std::numeric_limits<double>::min());
  const mpz_class largest = (mpz_class(1) << 1024) - (mpz_class(1) << 971);
  EXPECT_EQ(double_of(largest.get_str(), "1"), std::numeric_limits<double>::max());
  EXPECT_EQ(double_of("-" + largest.get_str(), "1"), std::numeric_limits<double>::lowest());
}

TEST(QueryReader, ReadsANegativeZeroAsZero) {
  for (const char* denominator : {"1", "3", "-3"}) {
    const FileQuery query = with_first_x("-0", denominator);
    EXPECT_TRUE(query.in_doubles);
    EXPECT_EQ(query.query.start[0].x(), 0) << denominator;
  }
}

TEST(QueryReader, ReadsLeadingZerosAsDecimalNumbers) {
  EXPECT_EQ(double_of("010", "1"), 10);
  EXPECT_EQ(double_of("012", "03"), 4);
  EXPECT_EQ(double_of("09", "3"), 3);
  EXPECT_EQ(with_first_x("-010", "3").rational.start[0][0], mpq_class(-10, 3));
  EXPECT_EQ(with_first_x("1", "09").rational.start[0][0], mpq_class(1, 9));
}

TEST(QueryReader, KeepsRationalsThatAreNoDoubles) {
  const std::vector<std::pair<std::string, std::string>> fractions = {
      {"1", "3"},
      {"-1", "10"},
      {"9007199254740993", "1"},   // 2^53 + 1
      {"-9007199254740993", "2"},  // by the quick path's rule, a numerator too long
      {"1" + std::string(400, '0'), "1"},
      {"1", "1" + std::string(400, '0')},
      {"1", power_of_two(1075)},
      {"3", power_of_two(1075)},
      {power_of_two(1024), "1"}};
  for (const auto& [numerator, denominator] : fractions) {
    const FileQuery query = with_first_x(numerator, denominator);
    EXPECT_FALSE(query.in_doubles) << numerator << "/" << denominator;
    mpq_class value{mpz_class(numerator, 10), mpz_class(denominator, 10)};
    value.canonicalize();
    EXPECT_EQ(query.rational.start[0][0], value) << numerator << "/" << denominator;
    EXPECT_EQ(query.rational.end[3][2], 0);
    EXPECT_EQ(query.rational.kind, ImpactKind::vertex_triangle);
  }
}

TEST(QueryReader, KeepsTheDoublesOfAQueryThatHasOneRational) {
  std::string text;
  for (int row = 0; row < 8; ++row)
    text += std::to_string(row) + ",2," + (row == 5 ? "2,6" : "-1,4") + "," + std::to_string(row) +
            ",1,1\n";
  const auto queries = read_text(text + query_text("1,2,3,4,5,8,0"));
  ASSERT_EQ(queries.size(), 2U);
  const FileQuery& mixed = queries[0];
  EXPECT_FALSE(mixed.in_doubles);
  EXPECT_EQ(mixed.truth, true);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto row = static_cast<int>(i);
    EXPECT_EQ(mixed.rational.start[i][0], mpq_class(row, 1) / 2);
    EXPECT_EQ(mixed.rational.start[i][1], mpq_class(-1, 4));
    EXPECT_EQ(mixed.rational.end[i][1], i == 1 ? mpq_class(1, 3) : mpq_class(-1, 4));
    EXPECT_EQ(mixed.rational.end[i][2], row + 4);
  }
  EXPECT_TRUE(queries[1].in_doubles) << "nothing of one query is left in the next";
  EXPECT_EQ(queries[1].truth, false);
  EXPECT_EQ(queries[1].query.end[3], Vec3(0.5, 0.75, 0.625));
}

TEST(QueryReader, UsesOneObjectForAllQueries) {
  const Scratch scratch;
  const auto file =
      scratch.write("q.csv", query_text("1,3,0,1,0,1,1") + query_text("1,2,0,1,0,1,0"));
  QueryReader reader(file, ImpactKind::edge_edge);
  FileQuery query;
  ASSERT_TRUE(reader.next(query));
  EXPECT_FALSE(query.in_doubles);
  ASSERT_TRUE(reader.next(query));
  EXPECT_TRUE(query.in_doubles);
  EXPECT_EQ(query.truth, false);
  EXPECT_EQ(query.line, 9U);
  EXPECT_FALSE(reader.next(query));
}

TEST(QueryReader, NamesTheLineOfWhatIsNoQuery) {
  struct Bad {
    std::string text, said;
  };
  const std::string good = query_text(kOrigin);
  const std::string six_or_seven =
      "six or seven columns are needed (numerator and denominator of x, y and z, and the truth), "
      "not ";
  const Bad bad[] = {
      {good + query_text(kOrigin, {{2, "0,1,0,1,0,0"}}), ", line 11: a denominator is zero"},
      {query_text(kOrigin, {{7, "0,1,5,-0,0,1"}}), ", line 8: a denominator is zero"},
      {query_text(kOrigin, {{7, "0,1,0,1,0.5,1"}}), ", line 8: \"0.5\" is no whole number"},
      {query_text(kOrigin, {{0, "1e5,1,0,1,0,1"}}), ", line 1: \"1e5\" is no whole number"},
      {query_text(kOrigin, {{0, "0,1,0,+1,0,1"}}), ", line 1: \"+1\" is no whole number"},
      {query_text(kOrigin, {{0, "0,1,,1,0,1"}}), ", line 1: \"\" is no whole number"},
      {query_text(kOrigin, {{0, "0,1,-,1,0,1"}}), ", line 1: \"-\" is no whole number"},
      {query_text(kOrigin, {{0, "0,1,--1,1,0,1"}}), ", line 1: \"--1\" is no whole number"},
      {query_text(kOrigin, {{0, "0,1,1 2,1,0,1"}}), ", line 1: \"1 2\" is no whole number"},
      {query_text(kOrigin, {{0, "0,1,0x10,1,0,1"}}), ", line 1: \"0x10\" is no whole number"},
      {query_text(kOrigin, {{0, "0,1,nan,1,0,1"}}), ", line 1: \"nan\" is no whole number"},
      {query_text(kOrigin, {{0, "0,1,\x01,1,0,1"}}), ", line 1: \"?\" is no whole number"},
      {query_text(kOrigin, {{0, "0,1," + std::string(50, 'x') + ",1,0,1"}}),
       ", line 1: \"" + std::string(40, 'x') + "...\" is no whole number"},
      {query_text("0,1,0,1,0"), ", line 1: " + six_or_seven + "5"},
      {query_text("x"), ", line 1: " + six_or_seven + "1"},
      {query_text("0,1,0,1,0,1,0,0"), ", line 1: more than seven columns"},
      {query_text(kOrigin, {{3, kOrigin + ",1"}}),
       ", line 4: 7 columns, where the file began with 6"},
      {query_text(kOrigin + ",1", {{7, kOrigin}}),
       ", line 8: 6 columns, where the file began with 7"},
      {query_text(kOrigin + ",2"), ", line 1: the truth is 0 or 1, not \"2\""},
      {query_text(kOrigin + ",true"), ", line 1: the truth is 0 or 1, not \"true\""},
      {query_text(kOrigin + ","), ", line 1: the truth is 0 or 1, not \"\""},
      {query_text(kOrigin + ",1", {{5, kOrigin + ",0"}}),
       ", line 6: the truth differs within a query"},
      {kOrigin + "\n" + kOrigin, ", line 2: a query has eight lines; the last one has 2"},
      {good + kOrigin + "\n", ", line 9: a query has eight lines; the last one has 1"},
      {query_text(kOrigin, {{6, std::string(70'000, '1')}}),
       ", line 7: a line of more than 65536 bytes"},
      {"", ": the file is empty"}};
  for (const auto& [text, said] : bad) EXPECT_EQ(refusal_of(text), said);
}

TEST(QueryReader, GivesTheQueriesBeforeABadOne) {
  const Scratch scratch;
  const auto file = scratch.write("q.csv", query_text(kOrigin) + "x\n");
  QueryReader reader(file, ImpactKind::vertex_triangle);
  FileQuery query;
  EXPECT_TRUE(reader.next(query));
  EXPECT_NE(sentence_of([&] { reader.next(query); }), "");
}

TEST(QueryReader, RefusesWhatIsNoFile) {
  const Scratch scratch;
  const auto pipe = scratch.folder() / "pipe.csv";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::pair<std::filesystem::path, const char*> files[] = {
      {scratch.folder() / "missing.csv", " does not exist."},
      {scratch.folder(), " is a folder, not a regular file."},
      {pipe, " is a pipe, not a regular file."},
      {"/dev/zero", " is a device, not a regular file."}};
  for (const auto& [file, fault] : files)
    EXPECT_EQ(sentence_of([&] { QueryReader(file, ImpactKind::edge_edge); }),
              "query file \"" + file.string() + "\"" + fault);
}

TEST(KindOfFile, IsFoundInTheNameOfAFileOrOfItsClosestFolder) {
  const auto face = ImpactKind::vertex_triangle;
  const auto edge = ImpactKind::edge_edge;
  const std::pair<const char*, std::optional<ImpactKind>> files[] = {
      {"/d/vf.csv", face},
      {"/d/326vf.csv", face},
      {"/d/326VF.CSV", face},
      {"/d/ee.csv", edge},
      {"/d/326ee.csv", edge},
      {"/d/vertex-face/data_0_0.csv", face},
      {"/d/edge-edge/data_0_0.csv", edge},
      {"/d/Edge-Edge/data_0_0.csv", edge},
      {"/vertex-face/a/b/data.csv", face},
      {"/vertex-face/edge-edge/data.csv", edge},
      {"/edge-edge/vertex-face/data.csv", face},
      {"/edge-edge/vertex-face.csv", face},
      {"/edge-edge/326vf.csv", face},  // the file's name is closer than any folder's
      {"/vertex-face/326ee.csv", edge},
      {"/d/data.csv", std::nullopt},
      {"/d/vf/data.csv", std::nullopt},
      {"/d/vertex-faces/data.csv", std::nullopt},
      {"/d/326vf_old.csv", std::nullopt},
      {"/d/coffee.csv", std::nullopt},  // a word that ends so
      {"/vertex-face/TREE.csv", face},
      {"/edge-edge/half-vf.csv", face},
      {"/d/step_ee.csv", edge}};
  for (const auto& [file, kind] : files) EXPECT_EQ(kind_of_file(file), kind) << file;
}

TEST(ReadTruth, TakesBooleansAndZerosAndOnes) {
  const Scratch scratch;
  EXPECT_EQ(read_truth(scratch.write("t.json", "[true, false, 1, 0]")),
            (std::vector<bool>{true, false, true, false}));
  EXPECT_TRUE(read_truth(scratch.write("t.json", "[]")).empty());
}

TEST(ReadTruth, NamesFileAndElementOfWhatIsNoTruth) {
  const Scratch scratch;
  const auto file = scratch.folder() / "t.json";
  const std::string no_list = file.string() + ": a JSON list of true and false is needed";
  const std::pair<const char*, std::string> bad[] = {
      {"{}", no_list},
      {"true", no_list},
      {"[true", no_list},
      {"0\n1\n", no_list},
      {"[true, 2]", file.string() + ": element 1 is neither true nor false"},
      {"[-1]", file.string() + ": element 0 is neither true nor false"},
      {"[0, 1.0]", file.string() + ": element 1 is neither true nor false"},
      {"[null]", file.string() + ": element 0 is neither true nor false"},
      {"[true, false, \"true\"]", file.string() + ": element 2 is neither true nor false"},
      {"[[true]]", file.string() + ": element 0 is neither true nor false"}};
  for (const auto& [text, said] : bad) {
    scratch.write("t.json", text);
    EXPECT_EQ(sentence_of([&] { read_truth(file); }), said) << text;
  }
  const auto missing = scratch.folder() / "missing.json";
  EXPECT_EQ(sentence_of([&] { read_truth(missing); }),
            "truth file \"" + missing.string() + "\" does not exist.");
}

}  // namespace
}  // namespace contactcheck::queries
