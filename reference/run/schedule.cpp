#include "reference/run/schedule.h"

#include <algorithm>
#include <cmath>

namespace contactcheck {
namespace {

// The van der Corput order of 0 .. n-1: positions sorted by their bit-reversed index.
std::vector<std::size_t> spread(const std::vector<std::size_t>& items) {
  std::vector<std::size_t> out;
  std::size_t power = 1;
  while (power < items.size()) power *= 2;
  for (std::size_t i = 0; i < power; ++i) {
    std::size_t reversed = 0;
    for (std::size_t bit = 1; bit < power; bit *= 2)
      if (i & bit) reversed |= power / (2 * bit);
    if (reversed < items.size()) out.push_back(items[reversed]);
  }
  return out;
}

}  // namespace

std::vector<std::size_t> timing_order(const std::vector<bool>& contact_frames) {
  std::vector<std::size_t> contact, free;
  for (std::size_t f = 0; f < contact_frames.size(); ++f)
    (contact_frames[f] ? contact : free).push_back(f);
  contact = spread(contact);
  free = spread(free);
  std::vector<std::size_t> order;
  std::size_t c = 0, n = 0;
  while (order.size() < contact_frames.size()) {
    // Take a contact frame whenever the contact share of the prefix lags behind (Bresenham).
    const bool lags = c * contact_frames.size() <= order.size() * contact.size();
    if ((lags && c < contact.size()) || n == free.size()) {
      order.push_back(contact[c++]);
    } else {
      order.push_back(free[n++]);
    }
  }
  return order;
}

std::size_t frames_within_budget(double budget_seconds, double seconds_per_repeat,
                                 std::size_t repeats, std::size_t fewest, std::size_t frames) {
  const double cost = std::max(seconds_per_repeat * static_cast<double>(repeats), 1e-9);
  const double fit = std::floor(budget_seconds / cost);
  constexpr double kFarTooSlow = 10.0;
  if (static_cast<double>(fewest) * cost > kFarTooSlow * budget_seconds)
    fewest = std::max<std::size_t>(fewest / 2, 1);
  const auto wanted = static_cast<std::size_t>(std::min(fit, static_cast<double>(frames)));
  return std::min(frames, std::max(fewest, wanted));
}

}  // namespace contactcheck
