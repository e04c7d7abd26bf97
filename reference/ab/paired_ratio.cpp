#include "reference/ab/paired_ratio.h"

#include <algorithm>
#include <random>
#include <utility>

#include "core/types/check.h"
#include "core/types/median.h"

namespace contactcheck {
namespace {

constexpr std::size_t kDraws = 2000;

double median_of_draw(const std::vector<double>& ratios, std::mt19937_64& random) {
  std::vector<double> drawn;
  // A modulo of 64 bits, unlike the library's distributions, is the same everywhere.
  for (std::size_t i = 0; i < ratios.size(); ++i) drawn.push_back(ratios[random() % ratios.size()]);
  return median(std::move(drawn));
}

}  // namespace

RatioInterval paired_ratio(const std::vector<double>& base, const std::vector<double>& head) {
  CONTACTCHECK_INVARIANT(!base.empty() && base.size() == head.size(), "times in pairs");
  std::vector<double> ratios, draws;
  for (std::size_t i = 0; i < base.size(); ++i) ratios.push_back(head[i] / base[i]);
  std::mt19937_64 random(20131);
  for (std::size_t i = 0; i < kDraws; ++i) draws.push_back(median_of_draw(ratios, random));
  std::sort(draws.begin(), draws.end());
  return {median(ratios), draws[kDraws / 40], draws[kDraws - 1 - kDraws / 40]};
}

}  // namespace contactcheck
