#include "reference/ab/paired_ratio.h"

#include <algorithm>
#include <random>
#include <utility>

#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr std::size_t kDraws = 2000;

double median_of_draw(const std::vector<double>& ratios, std::mt19937_64& random) {
  std::vector<double> drawn;
  // A modulo of 64 bits, unlike the library's distributions, is the same everywhere.
  for (std::size_t i = 0; i < ratios.size(); ++i) drawn.push_back(ratios[random() % ratios.size()]);
  return median_of(std::move(drawn));
}

}  // namespace

double median_of(std::vector<double> values) {
  CONTACTCHECK_INVARIANT(!values.empty(), "a median of something");
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

RatioInterval paired_ratio(const std::vector<double>& base, const std::vector<double>& head) {
  CONTACTCHECK_INVARIANT(!base.empty() && base.size() == head.size(), "times in pairs");
  std::vector<double> ratios, draws;
  for (std::size_t i = 0; i < base.size(); ++i) ratios.push_back(head[i] / base[i]);
  std::mt19937_64 random(20131);
  for (std::size_t i = 0; i < kDraws; ++i) draws.push_back(median_of_draw(ratios, random));
  std::sort(draws.begin(), draws.end());
  return {median_of(ratios), draws[kDraws / 40], draws[kDraws - 1 - kDraws / 40]};
}

}  // namespace contactcheck
