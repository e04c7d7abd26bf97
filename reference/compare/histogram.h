// How many errors are of which size, in bins whose edges are the same for every result.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck {

class Histogram {
 public:
  /// Metres: 0, 1e-12, 2e-12, 5e-12, 1e-11, ... up to the largest double.
  static Histogram of_lengths();
  /// Degrees: 0, 5, 10, ..., 180.
  static Histogram of_angles();

  /// @pre value >= 0; beyond the last edge it counts in the last bin
  void add(double value);
  /// Those that hold any, in order.
  std::vector<results::HistogramBin> bins() const;

 private:
  explicit Histogram(const std::vector<double>& edges);

  const std::vector<double>* edges_;  // ascending; of static life
  std::vector<std::uint64_t> counts_;
};

}  // namespace contactcheck
