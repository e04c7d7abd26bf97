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

/// The value in the middle; of an even number, the mean of the two there.
/// @pre not empty, no NaN
double median(std::vector<double> values);

/// Nearest rank: the smallest value that at least this share of all is not above.
/// @pre `sorted` is ascending and not empty; 0 <= share <= 1
double quantile(const std::vector<double>& sorted, double share);

/// @pre not empty; all above 0
double geometric_mean(const std::vector<double>& values);

/// Spearman's: Pearson's correlation of the ranks, equal values sharing the mean of theirs. None
/// where all values of one side are equal, or there are fewer than two.
/// @pre as many of both; no NaN
std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

/// What the largest of `quantities` rank correlations of so many values stays below by chance
/// alone, in 95 % of all cases at least (normal approximation, Bonferroni).
/// @pre values > 1, quantities > 0
double chance_correlation(std::size_t values, std::size_t quantities);

/// A measured ratio and what it lies between: a 95 % interval or a range (interval_name).
struct Ratio {
  double value = 1.0, low = 1.0, high = 1.0;
};

/// So many measurements make an interval that covers; fewer show a range.
constexpr std::size_t kFewestForInterval = 5;

/// Another measurement may lie outside a range: what a range is to show must lie outside it by this
/// factor.
constexpr double kRangeFactor = 1.5;

/// What the ends of a ratio of that number of measurements are: "95 %" or "range".
const char* interval_name(std::size_t measurements);

/// One ratio out of several measurements, each in a process of its own: the geometric mean. From
/// kFewestForInterval on the ends are Student's t interval of 95 % on the logarithms (n - 1 degrees
/// of freedom), with fewer the smallest and the largest measurement.
/// @pre not empty; all above 0
Ratio mean_ratio(const std::vector<double>& measured);

/// Three significant digits, without exponent in the range that people read.
std::string three_digits(double value);

/// "1.32x [1.28, 1.36]"; of a range "1.32x (range 1.1 to 1.5)", of one pass "1.32x (1 pass)".
std::string ratio_text(const Ratio& ratio, std::size_t passes);

/// Draws with replacement, the same draws on every platform.
class Resampler {
 public:
  /// A number below n. @pre n > 0
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

 private:
  // std::uniform_int_distribution differs between standard libraries; a modulo of 64 bits does not.
  std::mt19937_64 random_{20131};
};

/// `estimate` with a percentile bootstrap interval: `draw` computes the estimate from what it draws
/// again, 200 times. The interval ends at the 6th smallest and the 6th largest, and contains the
/// estimate. It holds what one process shows: between processes times differ more (mean_ratio).
Ratio bootstrap(double estimate, const std::function<double(Resampler&)>& draw);

/// Of two ratios that were measured apart, so that their errors are independent: the half-widths of
/// their intervals, as logarithms, add up in squares, each end by itself.
/// @pre all values and ends above 0; an interval may be open (0 to infinity)
Ratio product(const Ratio& a, const Ratio& b);
/// `measurements`: of the one that has fewer. Where these make a range, from the smallest to the
/// largest that the quotient can be.
Ratio quotient(const Ratio& numerator, const Ratio& denominator, std::size_t measurements);

/// The median of one ratio measured several times apart; of one measurement that itself. The
/// interval is that of a median: by the spread of the measurements (Student's t), and to either
/// side no narrower than their own intervals make it.
/// @pre at least one; ratios above 0
Ratio median_ratio(const std::vector<Ratio>& measured);

}  // namespace contactcheck::results
