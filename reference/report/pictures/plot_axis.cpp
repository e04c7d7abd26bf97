#include "reference/report/pictures/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace contactcheck::report {
namespace {

constexpr double kBend = 0.001;  // where ErrorAxis turns from linear to logarithmic
constexpr double kFewDecades = 3.5, kManyDecades = 12;
const double kRoom = std::log10(1.5);

}  // namespace

LogAxis::LogAxis(double least, double most)
    : low_(std::log10(least) - kRoom), span_(std::log10(most) + kRoom - low_) {}

double LogAxis::place(double value) const { return (std::log10(value) - low_) / span_; }

std::vector<Tick> LogAxis::ticks() const {
  const int first = static_cast<int>(std::floor(low_)),
            last = static_cast<int>(std::ceil(low_ + span_));
  const int every = static_cast<int>(std::ceil(span_ / kManyDecades));
  std::vector<Tick> ticks;
  for (int decade = first; decade <= last; decade += std::max(every, 1)) {
    for (const int digit : {1, 2, 5}) {
      if (digit > 1 && span_ > kFewDecades) continue;
      const double value = digit * std::pow(10.0, decade), at = place(value);
      if (at >= 0.0 && at <= 1.0) ticks.push_back({value, fmt::format("{:.6g}", value)});
    }
  }
  return ticks;
}

ErrorAxis::ErrorAxis(double highest) : top_(std::min(1.0, 1.6 * std::max(0.01, highest))) {}

double ErrorAxis::place(double share) const {
  return std::log1p(share / kBend) / std::log1p(top_ / kBend);
}

std::vector<Tick> ErrorAxis::ticks() const {
  std::vector<Tick> ticks;
  for (const double share : {0.0, 0.001, 0.01, 0.1, 0.5, 1.0})
    if (share <= top_) ticks.push_back({share, fmt::format("{:.6g} %", 100.0 * share)});
  return ticks;
}

}  // namespace contactcheck::report
