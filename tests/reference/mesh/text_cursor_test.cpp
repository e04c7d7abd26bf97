#include "reference/mesh/text_cursor.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace contactcheck::mesh {
namespace {

using Rule = TextCursor::Rule;

TEST(TextCursor, KnowsTheLineOfEachWordWhateverEndsLines) {
  TextCursor cursor("a\nb\r\nc\rd\n\n\re");
  for (const auto& [word, line] :
       {std::pair{"a", 1u}, {"b", 2u}, {"c", 3u}, {"d", 4u}, {"e", 7u}}) {
    EXPECT_EQ(cursor.word(), word);
    EXPECT_EQ(cursor.line(), line);
  }
  EXPECT_EQ(cursor.word(), "");
}

TEST(TextCursor, StaysOnItsLineUntilItIsToLeaveIt) {
  TextCursor cursor(" a b # c\nd", Rule::kHashComments);
  EXPECT_EQ(cursor.word_of_line(), "a");
  EXPECT_EQ(cursor.rest_of_line(), "b");
  EXPECT_EQ(cursor.word_of_line(), "");
  EXPECT_TRUE(cursor.next_line());
  EXPECT_EQ(cursor.word_of_line(), "d");
  EXPECT_FALSE(cursor.next_line());
}

TEST(TextCursor, TakesNoCommentForANumbersEnd) {
  TextCursor cursor("1#2\n1.#IND 3", Rule::kHashComments);
  EXPECT_EQ(cursor.word(), "1");
  EXPECT_EQ(cursor.word(), "1.#IND");
  EXPECT_EQ(cursor.word(), "3");
}

// glibc's strtod rounds correctly; it is another implementation than std::from_chars.
template <typename Real>
void expect_as_c_reads_it(const std::string& text) {
  Real expected = 0;
  if constexpr (sizeof(Real) == sizeof(double))
    expected = std::strtod(text.c_str(), nullptr);
  else
    expected = std::strtof(text.c_str(), nullptr);
  const std::optional<Real> value = decimal<Real>(text);
  ASSERT_EQ(value.has_value(), std::isfinite(expected)) << text;
  if (!value) return;
  EXPECT_EQ(std::signbit(*value), std::signbit(expected)) << text;
  EXPECT_EQ(*value, expected) << text;
}

TEST(Decimal, IsTheNearestNumber) {
  std::mt19937_64 random(20261128);
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", static_cast<int>(random() % 25), value);
    expect_as_c_reads_it<double>(text);
    expect_as_c_reads_it<float>(text);
  }
}

TEST(Decimal, RoundsToZeroBelowTheSmallestAndIsNoneAboveTheLargest) {
  for (const char* const text :
       {"4.9406564584124655e-324", "2.4703282292062328e-324", "2.4703282292062327e-324", "1e-400",
        "-1e-400", "0.000000000000000000000000000000000000000000000000000000000001e-300",
        "1000000000000000000000000000000000000000000e-400", "-0", "0e999999999999999999999",
        "1e-999999999999999999999", "1e999999999999999999999", "1.7976931348623157e308",
        "1.7976931348623158e308", "1.7976931348623159e308", "3.4028235e38", "3.4028236e38", "1e-46",
        "7.1e-46"}) {
    expect_as_c_reads_it<double>(text);
    expect_as_c_reads_it<float>(text);
  }
  const std::string long_zero = "0." + std::string(400, '0') + "1",
                    long_number = std::string(400, '9');
  expect_as_c_reads_it<double>(long_zero);
  expect_as_c_reads_it<double>(long_number);
}

TEST(Decimal, IsAllOfTheWord) {
  for (const char* const text :
       {"",     "+",        "-",      ".",       "e5",      "1e",      "1e+",  "1,5",
        "1.5f", "0x10",     "1_000",  "1.#QNAN", "-1.#IND", "nan",     "-nan", "inf",
        "+inf", "infinity", "nan(7)", "1..2",    "--1",     "+-1",     "-+1",  "1-2",
        "1d",   "d1",       "1e5d2",  "1 ",      "1;",      "\xC2\xBD"}) {
    EXPECT_EQ(decimal<double>(text), std::nullopt) << text;
    EXPECT_EQ(decimal<float>(text), std::nullopt) << text;
  }
}

TEST(Decimal, ReadsFortransExponents) {
  EXPECT_EQ(decimal<double>("2.0D+01"), 20.0);
  EXPECT_EQ(decimal<double>("-.5d-3"), -0.5e-3);
  EXPECT_EQ(decimal<double>("1d999"), std::nullopt);
  EXPECT_EQ(decimal<double>("1d-999"), 0.0);
}

TEST(Number, LooksLikeOne) {
  for (const char* const text :
       {"1", "-.5", "nan", "-NaN", "Inf", "-inf", "1.#QNAN", "+7", "-nan(ind)"})
    EXPECT_TRUE(looks_like_a_number(text)) << text;
  for (const char* const text : {"", "-", "f", "v", "red", "e5", "n", "in", "#"})
    EXPECT_FALSE(looks_like_a_number(text)) << text;
}

}  // namespace
}  // namespace contactcheck::mesh
