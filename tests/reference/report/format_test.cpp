#include "reference/report/tables/format.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace contactcheck::report {
namespace {

TEST(FormatRate, IsOneOnlyWhenItIsOne) {
  EXPECT_EQ(format_rate(1.0), "1");
  EXPECT_EQ(format_rate(0.99999999), "0.99999");
  EXPECT_EQ(format_rate(std::nextafter(1.0, 0.0)), "0.99999");
  EXPECT_EQ(format_rate(0.999995), "0.99999");
}

TEST(FormatRate, IsCutAndNotRounded) {
  EXPECT_EQ(format_rate(0.0), "0");
  EXPECT_EQ(format_rate(0.666669), "0.66666");
  EXPECT_EQ(format_rate(2.0 / 3.0), "0.66666");
  EXPECT_EQ(format_rate(0.000001), "0.00000");
}

TEST(FormatRate, KeepsDecimalsThatAreExact) {
  EXPECT_EQ(format_rate(0.29), "0.29000");
  EXPECT_EQ(format_rate(0.57), "0.57000");
  EXPECT_EQ(format_rate(0.99999), "0.99999");
}

TEST(FormatRate, OfNothingIsADash) { EXPECT_EQ(format_rate(std::nullopt), "-"); }

TEST(FormatErrorRate, IsNoughtOnlyWhenItIsNought) {
  EXPECT_EQ(format_error_rate(0.0), "0");
  EXPECT_EQ(format_error_rate(1e-12), "0.00001");
  EXPECT_EQ(format_error_rate(std::nullopt), "-");
}

TEST(FormatErrorRate, IsRaisedAndNeverBetterThanItIs) {
  EXPECT_EQ(format_error_rate(1.0 / 3.0), "0.33334");
  EXPECT_EQ(format_error_rate(0.29), "0.29000");
  EXPECT_EQ(format_error_rate(0.1), "0.10000");
  EXPECT_EQ(format_error_rate(1.0), "1");
  EXPECT_EQ(format_error_rate(0.9999999), "1.00000");
}

TEST(FormatNumber, ShowsThreeDigits) {
  EXPECT_EQ(format_number(0.0), "0");
  EXPECT_EQ(format_number(12.345), "12.3");
  EXPECT_EQ(format_number(1234.5), "1234");
  EXPECT_EQ(format_number(0.0123456), "0.0123");
  EXPECT_EQ(format_number(-0.5), "-0.500");
  EXPECT_EQ(format_number(1.5e-7), "1.50e-07");
  EXPECT_EQ(format_number(2.5e9), "2.50e+09");
  EXPECT_EQ(format_number(std::nullopt), "-");
  EXPECT_EQ(format_number(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(FormatCount, ShowsWholeNumbersAndSigns) {
  EXPECT_EQ(format_count(0), "0");
  EXPECT_EQ(format_count(-3), "-3");
  EXPECT_EQ(format_count(12345678901LL), "12345678901");
  EXPECT_EQ(format_count(std::nullopt), "-");
}

TEST(FormatMillimetres, TurnsMetresIntoMillimetres) {
  EXPECT_EQ(format_millimetres(0.0021), "2.10");
  EXPECT_EQ(format_millimetres(0.0), "0");
  EXPECT_EQ(format_millimetres(std::nullopt), "-");
}

TEST(FormatCounts, ShowsOneNumberWhereAllAreTheSame) {
  Range counts;
  EXPECT_EQ(format_counts(counts), "-");
  counts.add(3.0);
  EXPECT_EQ(format_counts(counts), "3");
  counts.add(1.0);
  EXPECT_EQ(format_counts(counts), "1 to 3");
}

TEST(FormatRatio, ShowsWhatItsEndsAre) {
  const results::Ratio ratio = {12.34, 11.8, 12.9};
  EXPECT_EQ(format_ratio(ratio), "12.3x");
  EXPECT_EQ(format_ratio(ratio, 5), "12.3x [11.8, 12.9]");
  EXPECT_EQ(format_ratio(ratio, 4), "12.3x (11.8 to 12.9)");
  EXPECT_EQ(format_ratio(ratio, 2), "12.3x (11.8 to 12.9)");
  EXPECT_EQ(format_ratio(ratio, 1), "12.3x (1 pass)");
  EXPECT_EQ(format_ratio_range(ratio), "12.3x (11.8 to 12.9)");
  EXPECT_EQ(format_ratio(std::nullopt), "-");
  EXPECT_EQ(format_ratio(std::nullopt, 5), "-");
}

TEST(EndsSentence, SaysIntervalFromFivePassesOnAlone) {
  EXPECT_EQ(ends_sentence({5}), "[low, high] is the 95 % interval over 5 passes.");
  EXPECT_EQ(ends_sentence({1, 2, 3}), "(low to high) is the range of 2 or 3 passes.");
  EXPECT_EQ(ends_sentence({3, 7}),
            "[low, high] is the 95 % interval over 7 passes; (low to high) is the range of 3 "
            "passes.");
  EXPECT_EQ(ends_sentence({1}), "");
  EXPECT_EQ(ends_sentence({}), "");
}

}  // namespace
}  // namespace contactcheck::report
