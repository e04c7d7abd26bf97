// Medians, and ratios of times with their intervals. Every interval of the program is computed
// here.
#pragma once

#include <cstddef>
#include <functional>
#include <random>
#include <vector>

namespace contactcheck {

/// The value in the middle; of an even number, the mean of the two there.
/// @pre not empty, no NaN
double median(std::vector<double> values);

/// Nearest rank: the smallest value that at least this share of all is not above.
/// @pre `sorted` is ascending and not empty; 0 <= share <= 1
double quantile(const std::vector<double>& sorted, double share);

/// A measured ratio with its 95 % interval.
struct Ratio {
  double value = 1.0, low = 1.0, high = 1.0;
};

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
/// estimate.
Ratio bootstrap(double estimate, const std::function<double(Resampler&)>& draw);

/// The median of head / base over rounds. The two times of a round were measured one after the
/// other: a slow machine slows both, and one slow round moves the median little.
/// @pre as many of both, at least one; all above 0
Ratio paired_ratio(const std::vector<double>& base, const std::vector<double>& head);

/// Of two ratios that were measured apart, so that their errors are independent: the half-widths of
/// their intervals, as logarithms, add up in squares, each end by itself.
/// @pre all values and ends above 0; an interval may be open (0 to infinity)
Ratio product(const Ratio& a, const Ratio& b);
Ratio quotient(const Ratio& numerator, const Ratio& denominator);

/// The median of one ratio measured several times apart; of one measurement that itself. The
/// interval is that of a median: by the spread of the measurements (Student's t), and to either
/// side no narrower than their own intervals make it.
/// @pre at least one; ratios above 0
Ratio median_ratio(const std::vector<Ratio>& measured);

}  // namespace contactcheck
