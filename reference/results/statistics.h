// Medians, and ratios of times with their intervals. Every interval of the program is computed
// and worded here.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace contactcheck::results {

/// The middle value; for an even number of values, the mean of the two middle ones.
/// @pre not empty, no NaN
double median(std::vector<double> values);

/// Nearest rank: the smallest of the values that is not below this share of all.
/// @pre `sorted` is ascending and not empty; 0 <= share <= 1
double quantile(const std::vector<double>& sorted, double share);

/// @pre not empty; all above 0
double geometric_mean(const std::vector<double>& values);

/// Spearman's rank correlation: Pearson's correlation of the ranks; equal values share their mean
/// rank. None if all values of one side are equal, or for fewer than two values.
/// @pre equal sizes; no NaN
std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

/// In at least 95 % of all cases, `quantities` rank correlations of `values` unrelated values all
/// stay below this bound by chance (normal approximation, Bonferroni).
/// @pre values > 1, quantities > 0
double chance_correlation(std::size_t values, std::size_t quantities);

/// A measured ratio with the ends of its 95 % interval or range (interval_name).
struct Ratio {
  double value = 1.0, low = 1.0, high = 1.0;
};

/// From this many measurements on, a ratio has an interval; with fewer, a range.
constexpr std::size_t kFewestForInterval = 5;

/// A repeated measurement may lie outside a range; so what a range is to show must lie outside it
/// by this factor.
constexpr double kRangeFactor = 1.5;

/// The kind of ends of a ratio of that many measurements: "95 %" or "range".
const char* interval_name(std::size_t measurements);

/// One ratio from several measurements, each in a separate process: the geometric mean. From
/// kFewestForInterval on its ends are Student's 95 % t interval on the logarithms (n - 1 degrees of
/// freedom); with fewer they are the smallest and the largest measurement.
/// @pre not empty; all above 0
Ratio mean_ratio(const std::vector<double>& measured);

/// Three significant digits, without exponent for common magnitudes.
std::string three_digits(double value);

/// "1.32x [1.28, 1.36]"; a range is "1.32x (range 1.1 to 1.5)", one pass "1.32x (1 pass)".
std::string ratio_text(const Ratio& ratio, std::size_t passes);

/// Draws with replacement; the draws are the same on every platform.
class Resampler {
 public:
  /// A number below n. @pre n > 0
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

 private:
  // std::uniform_int_distribution differs between standard libraries; a modulo of 64 bits does not.
  std::mt19937_64 random_{20131};
};

/// `estimate` with a percentile bootstrap interval: `draw` computes the estimate from resampled
/// data, 200 times. The interval ends at the 6th smallest and the 6th largest, and contains the
/// estimate. It covers the spread within one process; times differ more between processes
/// (mean_ratio).
Ratio bootstrap(double estimate, const std::function<double(Resampler&)>& draw);

/// The product of two independently measured ratios: the half-widths of their intervals, as
/// logarithms, add up in squares, each end separately.
/// @pre all values and ends above 0; an interval may be unbounded (0 to infinity)
Ratio product(const Ratio& a, const Ratio& b);
/// `measurements`: the smaller number of the two. If it gives a range, the ends are the smallest
/// and largest possible quotient.
Ratio quotient(const Ratio& numerator, const Ratio& denominator, std::size_t measurements);

/// The median of one ratio measured several times independently; a single measurement is returned
/// as it is. The interval is that of a median: by the spread of the measurements (Student's t), and
/// on either side at least as wide as their own intervals make it.
/// @pre at least one; ratios above 0
Ratio median_ratio(const std::vector<Ratio>& measured);

}  // namespace contactcheck::results
