#include "reference/compare/histogram.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>

#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr int kLowestPower = -12, kHighestPower = 307;
constexpr int kDegreesPerBin = 5, kMostDegrees = 180;

// The double next to the decimal number, in every locale.
double decimal(int digit, int power) {
  const std::string text = std::to_string(digit) + "e" + std::to_string(power);
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::vector<double> length_edges() {
  std::vector<double> edges = {0.0};
  for (int power = kLowestPower; power <= kHighestPower; ++power)
    for (const int digit : {1, 2, 5}) edges.push_back(decimal(digit, power));
  edges.push_back(std::numeric_limits<double>::max());
  return edges;
}

std::vector<double> angle_edges() {
  std::vector<double> edges;
  for (int degrees = 0; degrees <= kMostDegrees; degrees += kDegreesPerBin)
    edges.push_back(degrees);
  return edges;
}

}  // namespace

Histogram::Histogram(const std::vector<double>& edges)
    : edges_(&edges), counts_(edges.size() - 1, 0) {}

Histogram Histogram::of_lengths() {
  static const std::vector<double> edges = length_edges();
  return Histogram(edges);
}

Histogram Histogram::of_angles() {
  static const std::vector<double> edges = angle_edges();
  return Histogram(edges);
}

void Histogram::add(double value) {
  CONTACTCHECK_INVARIANT(value >= 0, "an error has a size");
  const auto above = std::upper_bound(edges_->begin(), edges_->end(), value);
  const auto bin = static_cast<std::size_t>(above - edges_->begin()) - 1;
  ++counts_[std::min(bin, counts_.size() - 1)];
}

std::vector<results::HistogramBin> Histogram::bins() const {
  std::vector<results::HistogramBin> out;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (counts_[i] > 0) out.push_back({(*edges_)[i], (*edges_)[i + 1], counts_[i]});
  return out;
}

}  // namespace contactcheck
