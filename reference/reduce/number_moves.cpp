#include "reference/reduce/number_moves.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>

#include "reference/reduce/simple_number.h"

namespace contactcheck::reduce {
namespace {

constexpr std::size_t kAxes = 3;
constexpr int kCostOfValue = 3;
// At most this many vertices or values are tried: a move takes an evaluation, and candidates of
// this size are mostly made simpler by the moves of whole axes.
constexpr std::size_t kMostTried = 32;
constexpr int kFinestGrid = 52, kMostBits = 52, kMostDigits = 16;

std::vector<double> values_along(const Coordinates& c, std::size_t axis) {
  std::set<double> values;
  for (std::size_t i = axis; i < c.size(); i += kAxes) values.insert(c[i]);
  return {values.begin(), values.end()};
}

/// Collects moves and puts them into the order in which they are tried.
class Moves {
 public:
  explicit Moves(const Coordinates& now) : cost_now_(reading_cost(now)) {}

  void add(Coordinates c, bool exact = true) {
    for (double& x : c) x += 0.0;  // no minus before a zero
    if (!std::all_of(c.begin(), c.end(), [](double x) { return std::isfinite(x); })) return;
    const long cost = reading_cost(c);
    if (cost < cost_now_) moves_.push_back({!exact, cost, std::move(c)});
  }

  std::vector<Coordinates> in_order() {
    std::sort(moves_.begin(), moves_.end());
    moves_.erase(std::unique(moves_.begin(), moves_.end()), moves_.end());
    std::vector<Coordinates> out;
    for (Move& move : moves_) out.push_back(std::move(move.coordinates));
    return out;
  }

 private:
  struct Move {
    bool inexact = false;
    long cost = 0;
    Coordinates coordinates;
    auto operator<=>(const Move&) const = default;
  };

  long cost_now_;
  std::vector<Move> moves_;
};

/// Every coordinate of `indices` through `change`.
template <typename Change>
Coordinates changed(Coordinates c, const std::vector<std::size_t>& indices, Change&& change) {
  for (const std::size_t i : indices) c[i] = change(c[i]);
  return c;
}

std::vector<std::size_t> range(std::size_t from, std::size_t to, std::size_t step = 1) {
  std::vector<std::size_t> out;
  for (std::size_t i = from; i < to; i += step) out.push_back(i);
  return out;
}

std::vector<std::size_t> along(const Coordinates& c, std::size_t axis) {
  return range(axis, c.size(), kAxes);
}

void scale(const Coordinates& now, const std::vector<std::size_t>& indices, Moves& moves) {
  std::set<int> powers;
  std::set<double> sizes;
  for (const std::size_t i : indices) {
    if (now[i] == 0.0) continue;
    const int top = std::ilogb(now[i]);
    powers.insert(-top);
    powers.insert(significant_bits(now[i]) - 1 - top);  // its last bit becomes 1
    if (sizes.size() < kMostTried) sizes.insert(std::abs(now[i]));
  }
  for (const int power : powers) {
    Coordinates scaled = changed(now, indices, [power](double x) { return std::ldexp(x, power); });
    const Coordinates back =
        changed(scaled, indices, [power](double x) { return std::ldexp(x, -power); });
    moves.add(std::move(scaled), back == now);
  }
  for (const double size : sizes)
    moves.add(changed(now, indices, [size](double x) { return x / size; }), false);
}

Coordinates ranked(Coordinates c, std::size_t axis) {
  const std::vector<double> values = values_along(c, axis);
  for (const std::size_t i : along(c, axis))
    c[i] =
        static_cast<double>(std::lower_bound(values.begin(), values.end(), c[i]) - values.begin());
  return c;
}

void round_set(const Coordinates& now, const std::vector<std::size_t>& indices, Moves& moves) {
  double largest = 0.0;
  for (const std::size_t i : indices) largest = std::max(largest, std::abs(now[i]));
  if (largest == 0.0) return;
  const int top = std::ilogb(largest);
  for (int k = 0; k <= kFinestGrid; ++k)
    moves.add(changed(now, indices, [&](double x) {
      return std::ldexp(std::nearbyint(std::ldexp(x, k - top)), top - k);
    }));
  for (int bits = 1; bits <= kMostBits; ++bits)
    moves.add(changed(now, indices, [bits](double x) { return rounded_to_bits(x, bits); }));
  for (int digits = 1; digits <= kMostDigits; ++digits)
    moves.add(changed(now, indices, [digits](double x) { return rounded_to_digits(x, digits); }));
}

}  // namespace

long reading_cost(const Coordinates& coordinates) {
  long cost = 0;
  for (const double x : coordinates) cost += complexity(x);
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    cost += kCostOfValue * static_cast<long>(values_along(coordinates, axis).size());
  return cost;
}

std::vector<Coordinates> translations(const Coordinates& now) {
  Moves moves(now);
  for (std::size_t v = 0; v < now.size() / kAxes && v < kMostTried; ++v) {
    Coordinates moved = now;
    bool exact = true;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double by = now[kAxes * v + i % kAxes];
      moved[i] = now[i] - by;
      exact = exact && moved[i] + by == now[i];
    }
    moves.add(std::move(moved), exact);
  }
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const std::vector<double> values = values_along(now, axis);
    for (std::size_t v = 0; v < values.size() && v < kMostTried; ++v) {
      const double by = values[v];
      Coordinates moved = changed(now, along(now, axis), [by](double x) { return x - by; });
      const Coordinates back = changed(moved, along(now, axis), [by](double x) { return x + by; });
      moves.add(std::move(moved), back == now);
    }
  }
  return moves.in_order();
}

std::vector<Coordinates> scalings(const Coordinates& now) {
  Moves moves(now);
  scale(now, range(0, now.size()), moves);
  for (std::size_t axis = 0; axis < kAxes; ++axis) scale(now, along(now, axis), moves);
  return moves.in_order();
}

std::vector<Coordinates> rankings(const Coordinates& now) {
  Moves moves(now);
  moves.add(ranked(ranked(ranked(now, 0), 1), 2), false);
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    moves.add(ranked(now, axis), false);
    moves.add(changed(now, along(now, axis), [](double x) { return -x; }));
  }
  return moves.in_order();
}

std::vector<Coordinates> roundings(const Coordinates& now, std::size_t first) {
  Moves moves(now);
  round_set(now, range(0, now.size()), moves);
  round_set(now, range(0, first), moves);
  round_set(now, range(first, now.size()), moves);
  for (std::size_t axis = 0; axis < kAxes; ++axis) round_set(now, along(now, axis), moves);
  for (std::size_t v = 0; v < now.size() / kAxes && v < kMostTried; ++v)
    round_set(now, range(kAxes * v, kAxes * v + kAxes), moves);
  return moves.in_order();
}

std::vector<Coordinates> replaced_values(const Coordinates& now) {
  Moves moves(now);
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const std::vector<double> values = values_along(now, axis);
    for (std::size_t v = 0; v < values.size() && v < kMostTried; ++v) {
      const double value = values[v];
      for (const double simpler : simpler_numbers(value))
        moves.add(
            changed(now, along(now, axis), [&](double x) { return x == value ? simpler : x; }));
    }
  }
  return moves.in_order();
}

std::vector<Coordinates> replaced_coordinate(const Coordinates& now, std::size_t index) {
  Moves moves(now);
  std::vector<double> numbers = simpler_numbers(now[index]);
  const std::vector<double> values = values_along(now, index % kAxes);
  numbers.insert(numbers.end(), values.begin(),
                 values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), kMostTried)));
  for (const double number : numbers)
    moves.add(changed(now, {index}, [number](double) { return number; }));
  return moves.in_order();
}

Coordinates simplify(Coordinates start, std::size_t first,
                     const std::function<bool(const Coordinates&)>& shows,
                     const std::function<bool()>& may_go_on) {
  Coordinates now = std::move(start);
  const auto take_first_that_shows = [&](const std::vector<Coordinates>& moves) {
    for (const Coordinates& move : moves) {
      if (!may_go_on()) return false;
      if (!shows(move)) continue;
      now = move;
      return true;
    }
    return false;
  };
  long before = 0;
  do {
    before = reading_cost(now);
    for (const auto moves_of : {translations, scalings, rankings})
      while (take_first_that_shows(moves_of(now))) {
      }
    while (take_first_that_shows(roundings(now, first))) {
    }
    while (take_first_that_shows(replaced_values(now))) {
    }
    for (std::size_t i = 0; i < now.size() && may_go_on(); ++i)
      take_first_that_shows(replaced_coordinate(now, i));
  } while (reading_cost(now) < before && may_go_on());
  return now;
}

}  // namespace contactcheck::reduce
