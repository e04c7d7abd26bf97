// Formats numbers: short, and never rounded to a better value. "-" means not measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reference/results/statistics.h"

namespace contactcheck::report {

/// "1" only for exactly 1, else truncated to five decimals, so that 0.99999 never reads as 1.
std::string format_rate(std::optional<double> value);
/// For a rate of errors: rounded up to five decimals, so that 0.000001 never reads as 0.
std::string format_error_rate(std::optional<double> value);
/// Three significant digits.
std::string format_number(std::optional<double> value);
/// Whole numbers.
std::string format_count(std::optional<std::int64_t> value);
/// Metres as millimetres with three significant digits; "0" for exactly 0.
std::string format_millimetres(std::optional<double> value);
/// The smallest and the largest of some numbers; no ends before the first.
struct Range {
  std::optional<double> low, high;
  void add(double value);
};
/// "1.50 to 12.3", or one number where both read the same.
std::string format_range(const Range& range);
/// A share of errors in percent: "0 %" only for none, "100 %" only for all.
std::string format_percent(double share);
/// 12,345,678
std::string grouped_digits(std::uint64_t value);
/// "1 scene", "1,200 scenes"
std::string plural(std::uint64_t n, const std::string& one);
/// "a, b and c"
std::string listed(const std::vector<std::string>& names);
/// The first `most` names, and the number of the others.
std::string short_list(const std::vector<std::string>& names, std::size_t most);
/// Whole numbers: "3", "1 to 3"; "-" for an empty range.
std::string format_counts(const Range& range);
/// "1 pass", "3 passes"
std::string counted_passes(std::size_t n);
/// "12.3x"
std::string format_ratio(const std::optional<results::Ratio>& ratio);
/// With its ends, an interval or a range by the number of passes (interval_name): "12.3x [11.8,
/// 12.9]" or "12.3x (11.8 to 12.9)"; "12.3x (1 pass)" has no ends.
std::string format_ratio(const std::optional<results::Ratio>& ratio, std::size_t passes);
/// "12.3x (11.8 to 12.9)": the ends are shown as a range.
std::string format_ratio_range(const std::optional<results::Ratio>& ratio);
/// A sentence on what the ends of ratios are, by their numbers of passes; empty if none has ends.
std::string ends_sentence(const std::set<std::size_t>& passes);

}  // namespace contactcheck::report
