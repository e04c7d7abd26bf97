#include "reference/results/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "core/types/check.h"

namespace contactcheck::results {
namespace {

constexpr std::size_t kDraws = 200;
constexpr double kNormal95 = 1.96;    ///< standard deviations to either side
constexpr double kMedian95 = 1.2533;  ///< a median is so many times as uncertain as a mean, at most

// How far an end lies from the value, as a logarithm; infinite for an open end.
double reach(double from, double to) { return std::abs(std::log(to / from)); }

Ratio widened(double ratio, double below, double above) {
  return {ratio, ratio * std::exp(-below), ratio * std::exp(above)};
}

// Student's t of a 95 % interval: from a table, and beyond it the first terms of its expansion
// about the normal distribution (2e-3 off at 9 degrees of freedom, less beyond).
double student95(std::size_t freedom) {
  constexpr double kTable[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306};
  if (freedom <= std::size(kTable)) return kTable[freedom - 1];
  const double n = static_cast<double>(freedom), z = kNormal95, cube = z * z * z;
  return z + (cube + z) / (4.0 * n) + (5.0 * cube * z * z + 16.0 * cube + 3.0 * z) / (96.0 * n * n);
}

struct Logarithms {
  double mean = 0.0;       ///< of the quotients by the first value: 0 exactly where all are equal
  double deviation = 0.0;  ///< of n - 1; 0 of one
};

Logarithms logarithms_of(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  Logarithms out;
  for (const double value : values) out.mean += std::log(value / values.front()) / count;
  if (values.size() == 1) return out;
  double squares = 0.0;
  for (const double value : values)
    squares += std::pow(std::log(value / values.front()) - out.mean, 2);
  out.deviation = std::sqrt(squares / (count - 1.0));
  return out;
}

// From 1 on; equal values have the mean of their ranks.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t i = first; i < end; ++i)
      ranks[order[i]] = 0.5 * static_cast<double>(first + 1 + end);
  }
  return ranks;
}

}  // namespace

double median(std::vector<double> values) {
  CONTACTCHECK_INVARIANT(!values.empty(), "a median of something");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double quantile(const std::vector<double>& sorted, double share) {
  CONTACTCHECK_INVARIANT(!sorted.empty(), "a quantile of something");
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

double geometric_mean(const std::vector<double>& values) {
  CONTACTCHECK_INVARIANT(!values.empty(), "a mean of something");
  return values.front() * std::exp(logarithms_of(values).mean);
}

std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  CONTACTCHECK_INVARIANT(x.size() == y.size(), "pairs of values");
  const std::vector<double> a = ranks_of(x), b = ranks_of(y);
  const double mean = 0.5 * static_cast<double>(x.size() + 1);
  double product = 0.0, squares_a = 0.0, squares_b = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    product += (a[i] - mean) * (b[i] - mean);
    squares_a += (a[i] - mean) * (a[i] - mean);
    squares_b += (b[i] - mean) * (b[i] - mean);
  }
  if (!(squares_a > 0.0) || !(squares_b > 0.0)) return std::nullopt;
  return product / std::sqrt(squares_a * squares_b);
}

double chance_correlation(std::size_t values, std::size_t quantities) {
  // Two-sided: so many standard deviations of 1 / sqrt(n - 1) leave 5 % out, for all together.
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double outside = std::erfc(middle / std::sqrt(2.0)) * static_cast<double>(quantities);
    (outside > 0.05 ? low : high) = middle;
  }
  return std::min(1.0, high / std::sqrt(static_cast<double>(values - 1)));
}

const char* interval_name(std::size_t measurements) {
  return measurements >= kFewestForInterval ? "95 %" : "range";
}

Ratio mean_ratio(const std::vector<double>& measured) {
  CONTACTCHECK_INVARIANT(!measured.empty(), "a mean of something");
  const Logarithms logs = logarithms_of(measured);
  const double mean = measured.front() * std::exp(logs.mean);
  if (measured.size() < kFewestForInterval) {
    const auto [least, greatest] = std::minmax_element(measured.begin(), measured.end());
    // The mean of equal measurements may be off by an ulp.
    return {mean, std::min(*least, mean), std::max(*greatest, mean)};
  }
  const double half_width = student95(measured.size() - 1) * logs.deviation /
                            std::sqrt(static_cast<double>(measured.size()));
  return widened(mean, half_width, half_width);
}

std::string three_digits(double value) {
  if (value == 0.0) return "0";
  if (std::isnan(value)) return "-";  // a quotient of nothing by nothing
  const double size = std::fabs(value);
  if (size >= 1e6 || size < 1e-4) return fmt::format("{:.2e}", value);
  const int digits = std::max(0, 2 - static_cast<int>(std::floor(std::log10(size))));
  return fmt::format("{:.{}f}", value, digits);
}

std::string ratio_text(const Ratio& ratio, std::size_t passes) {
  const std::string value = three_digits(ratio.value) + "x";
  if (passes == 1) return value + " (1 pass)";
  const bool interval = passes >= kFewestForInterval;
  return fmt::format(fmt::runtime(interval ? "{} [{}, {}]" : "{} (range {} to {})"), value,
                     three_digits(ratio.low), three_digits(ratio.high));
}

Ratio bootstrap(double estimate, const std::function<double(Resampler&)>& draw) {
  constexpr std::size_t kOutside = kDraws / 40;  // 2.5 % on either side
  Resampler resampler;
  std::vector<double> draws;
  for (std::size_t i = 0; i < kDraws; ++i) draws.push_back(draw(resampler));
  std::sort(draws.begin(), draws.end());
  return {estimate, std::min(estimate, draws[kOutside]),
          std::max(estimate, draws[kDraws - 1 - kOutside])};
}

Ratio product(const Ratio& a, const Ratio& b) {
  return widened(a.value * b.value, std::hypot(reach(a.value, a.low), reach(b.value, b.low)),
                 std::hypot(reach(a.value, a.high), reach(b.value, b.high)));
}

Ratio quotient(const Ratio& numerator, const Ratio& denominator, std::size_t measurements) {
  if (measurements < kFewestForInterval)
    return {numerator.value / denominator.value, numerator.low / denominator.high,
            numerator.high / denominator.low};
  return widened(
      numerator.value / denominator.value,
      std::hypot(reach(numerator.value, numerator.low), reach(denominator.value, denominator.high)),
      std::hypot(reach(numerator.value, numerator.high),
                 reach(denominator.value, denominator.low)));
}

Ratio median_ratio(const std::vector<Ratio>& measured) {
  CONTACTCHECK_INVARIANT(!measured.empty(), "the middle of something");
  if (measured.size() == 1) return measured.front();
  const double count = static_cast<double>(measured.size());
  std::vector<double> ratios;
  double below = 0.0, above = 0.0;  // mean squares of what each says of itself
  for (const Ratio& r : measured) {
    ratios.push_back(r.value);
    below += std::pow(reach(r.value, r.low), 2) / count;
    above += std::pow(reach(r.value, r.high), 2) / count;
  }
  const double apart = student95(measured.size() - 1) * logarithms_of(ratios).deviation;
  const auto half_width = [&](double squares) {
    return kMedian95 * std::max(apart, std::sqrt(squares)) / std::sqrt(count);
  };
  return widened(median(ratios), half_width(below), half_width(above));
}

}  // namespace contactcheck::results
