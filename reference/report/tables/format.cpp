#include "reference/report/tables/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/text/lists.h"

namespace contactcheck::report {
namespace {

// Rates are shown with five decimals. The product with 1e5 may fall a rounding step beside a whole
// number (0.29 gives 28999.999...): a few steps of 2^-53 are forgiven, far below any count's reach.
constexpr double kRateSteps = 1e5, kSlack = 0x1p-50;

}  // namespace

std::string format_rate(std::optional<double> value) {
  if (!value) return "-";
  const double rate = *value;
  if (rate == 1.0 || rate == 0.0) return fmt::format("{:.0f}", rate);
  const double cut = std::min(std::floor(rate * kRateSteps * (1.0 + kSlack)), kRateSteps - 1.0);
  return fmt::format("{:.5f}", cut / kRateSteps);
}

std::string format_error_rate(std::optional<double> value) {
  if (!value) return "-";
  const double rate = *value;
  if (rate == 1.0 || rate == 0.0) return fmt::format("{:.0f}", rate);
  const double raised = std::max(std::ceil(rate * kRateSteps * (1.0 - kSlack)), 1.0);
  return fmt::format("{:.5f}", raised / kRateSteps);
}

std::string format_number(std::optional<double> value) {
  return value ? results::three_digits(*value) : "-";
}

std::string format_count(std::optional<std::int64_t> value) {
  return value ? std::to_string(*value) : "-";
}

std::string format_millimetres(std::optional<double> value) {
  return value ? results::three_digits(1e3 * *value) : "-";
}

void Range::add(double value) {
  low = std::min(low.value_or(value), value);
  high = std::max(high.value_or(value), value);
}

std::string format_range(const Range& range) {
  const std::string from = format_number(range.low), to = format_number(range.high);
  return from == to ? from : from + " to " + to;
}

std::string format_percent(double share) {
  if (share == 0.0 || share == 1.0) return fmt::format("{:.0f} %", 100.0 * share);
  if (share < 1e-4) return "< 0.01 %";
  if (share > 0.999) return "> 99.9 %";
  const int digits = share < 0.01 ? 2 : 1;
  // Halves go up, as in format.ts.
  const double steps = digits == 2 ? 100.0 : 10.0;
  return fmt::format("{:.{}f} %", std::round(100.0 * share * steps) / steps, digits);
}

std::string grouped_digits(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string plural(std::uint64_t n, const std::string& one) {
  return grouped_digits(n) + " " + one + (n == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::string short_list(const std::vector<std::string>& names, std::size_t most) {
  if (names.size() <= most + 1) return listed(names);
  return text::shortened(names, most);
}

std::string format_counts(const Range& range) {
  if (!range.low) return "-";
  const std::string from = fmt::format("{:.0f}", *range.low);
  return range.low == range.high ? from : fmt::format("{} to {:.0f}", from, *range.high);
}

std::string counted_passes(std::size_t n) {
  return std::to_string(n) + (n == 1 ? " pass" : " passes");
}

std::string format_ratio(const std::optional<results::Ratio>& ratio) {
  return ratio ? results::three_digits(ratio->value) + "x" : "-";
}

std::string format_ratio(const std::optional<results::Ratio>& ratio, std::size_t passes) {
  if (!ratio) return "-";
  // A table says once what its brackets are (ends_sentence).
  const bool range = passes != 1 && passes < results::kFewestForInterval;
  return range ? format_ratio_range(ratio) : results::ratio_text(*ratio, passes);
}

std::string format_ratio_range(const std::optional<results::Ratio>& ratio) {
  if (!ratio) return "-";
  return fmt::format("{} ({} to {})", format_ratio(ratio), results::three_digits(ratio->low),
                     results::three_digits(ratio->high));
}

std::string ends_sentence(const std::set<std::size_t>& passes) {
  std::string interval, range;
  for (const std::size_t n : passes) {
    if (n == 1) continue;
    std::string& numbers = n < results::kFewestForInterval ? range : interval;
    numbers += (numbers.empty() ? "" : " or ") + std::to_string(n);
  }
  if (!interval.empty()) interval = "[low, high] is the 95 % interval over " + interval + " passes";
  if (!range.empty()) range = "(low to high) is the range of " + range + " passes";
  if (interval.empty() && range.empty()) return "";
  return interval + (interval.empty() || range.empty() ? "" : "; ") + range + ".";
}

}  // namespace contactcheck::report
