// Where numbers stand on the axes of a picture, and which of them are named.
#pragma once

#include <string>
#include <vector>

namespace contactcheck::report {

struct Tick {
  double value;
  std::string name;
};

/// A logarithm, with room for half as much again at both ends: also where all values are one. What
/// lies within goes to [0, 1].
class LogAxis {
 public:
  /// @pre 0 < least <= most, finite
  LogAxis(double least, double most);
  double place(double value) const;
  /// Powers of ten and, where few of those are within, twice and five times them. At most 13.
  std::vector<Tick> ticks() const;

 private:
  double low_, span_;
};

/// An axis for shares of errors: 0 and 1 in 10,000 must both be seen, so it is nearly linear up to
/// 0.1 % and nearly a logarithm above. Shares in [0, top()] go to [0, 1].
class ErrorAxis {
 public:
  /// Room for `highest` (in [0, 1]) and always for 1 %.
  explicit ErrorAxis(double highest);
  double top() const { return top_; }
  double place(double share) const;
  /// In percent.
  std::vector<Tick> ticks() const;

 private:
  double top_;
};

}  // namespace contactcheck::report
