#include "reference/reduce/number_moves.h"

#include <gmock/gmock.h>

#include <cmath>

#include "reference/reduce/simple_number.h"

namespace contactcheck::reduce {
namespace {

using testing::Each;
using testing::ElementsAre;

bool accept_all() { return true; }

using Shows = std::function<bool(const Coordinates&)>;

Coordinates simplest(const Coordinates& start, const Shows& shows) {
  EXPECT_TRUE(shows(start));
  Coordinates out = simplify(start, start.size() / 2, shows, accept_all);
  EXPECT_TRUE(shows(out));
  return out;
}

const Coordinates kUneasy = {0.1234567, 17.0 / 3.0, -1.9876543, 3.1415926, 0.7071067, 1.4142135};

TEST(Simplify, OfWhatDoesNotMatterIsZero) {
  EXPECT_THAT(simplest(kUneasy, [](const Coordinates&) { return true; }), Each(0.0));
}

TEST(Simplify, FindsTheSimplestNumberAboveABound) {
  const Shows shows = [](const Coordinates& c) { return c[1] > 5.2; };
  EXPECT_THAT(simplest(kUneasy, shows), ElementsAre(0.0, 8.0, 0.0, 0.0, 0.0, 0.0));
}

TEST(Simplify, FindsFewDigitsWhereFewBitsDoNotDo) {
  const Shows shows = [](const Coordinates& c) { return c[1] > 0.6999 && c[1] < 0.70001; };
  EXPECT_THAT(simplest({0.3, 0.7000000001, 0.5, 1.0, 2.0, 3.0}, shows),
              ElementsAre(0.0, 0.7, 0.0, 0.0, 0.0, 0.0));
}

// No single coordinate can change alone: they move together.
TEST(Simplify, MovesEqualCoordinatesTogether) {
  const Shows shows = [](const Coordinates& c) { return c[0] == c[3] && c[0] > 0.1; };
  EXPECT_THAT(simplest({0.123, 5.1, 7.0, 0.123, 9.3, 2.2}, shows),
              ElementsAre(1.0, 0.0, 0.0, 1.0, 0.0, 0.0));
}

// Their difference stays what it is; the common part of them goes.
TEST(Simplify, MovesToTheOrigin) {
  const Shows shows = [](const Coordinates& c) { return c[3] - c[0] == 0.375; };
  const Coordinates out = simplest({1000.125, 0.0, 0.0, 1000.5, 0.0, 0.0}, shows);
  EXPECT_THAT(out, ElementsAre(0.0, 0.0, 0.0, 0.375, 0.0, 0.0));
}

// A ratio stays what it is, at any scale.
TEST(Simplify, ScalesToSmallWholeNumbers) {
  const Shows shows = [](const Coordinates& c) { return c[0] > 0.0 && c[3] == 5.0 * c[0]; };
  const Coordinates out = simplest({0x1.8p-40, 0.0, 0.0, 0x7.8p-40, 0.0, 0.0}, shows);
  EXPECT_THAT(out, ElementsAre(1.0, 0.0, 0.0, 5.0, 0.0, 0.0));
}

TEST(Simplify, KeepsAnOrderWithRanks) {
  const Shows shows = [](const Coordinates& c) {
    return c[0] < c[3] && c[3] < c[6] && c[6] < c[9];
  };
  const Coordinates out =
      simplest({0.11, 0, 0, 0.1100001, 0, 0, 0.1100002, 0, 0, 77.3, 0, 0}, shows);
  EXPECT_LE(reading_cost(out), reading_cost({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}));
}

TEST(Simplify, GivesTheSameEveryTime) {
  const Shows shows = [](const Coordinates& c) {
    return std::abs(c[0] * c[4] - c[1] * c[3]) > 3.9 && c[2] < c[5];
  };
  EXPECT_EQ(simplest(kUneasy, shows), simplest(kUneasy, shows));
}

TEST(Simplify, NeverTriesWhatIsNoSimplerOrNotFinite) {
  const Coordinates start = {1e300, 1e-300, 0.1, 3.0, 1.0 / 3.0, 5e-324};
  long least = reading_cost(start);
  const Shows shows = [&](const Coordinates& c) {
    EXPECT_LT(reading_cost(c), least);
    for (const double x : c) EXPECT_TRUE(std::isfinite(x) && !(x == 0.0 && std::signbit(x)));
    const bool shown = c[0] > 1e200 && c[1] > 0.0 && c[1] < 1e-200;
    if (shown) least = reading_cost(c);
    return shown;
  };
  simplify(start, 3, shows, accept_all);
}

TEST(Simplify, StopsWhereItMayNotGoOn) {
  int asked = 0;
  const auto shows = [&](const Coordinates&) {
    ++asked;
    return false;
  };
  EXPECT_EQ(simplify(kUneasy, 3, shows, [&] { return asked < 10; }), kUneasy);
  EXPECT_EQ(asked, 10);
}

TEST(Translations, TryExactOnesFirst) {
  const Coordinates now = {0.1, 0.0, 0.0, 1024.5, 0.0, 0.0};
  const std::vector<Coordinates> moves = translations(now);
  ASSERT_FALSE(moves.empty());
  bool inexact_seen = false;
  for (const Coordinates& move : moves) {
    const double by = now[0] - move[0];
    const bool exact = move[0] + by == now[0] && move[3] + by == now[3];
    inexact_seen = inexact_seen || !exact;
    EXPECT_FALSE(exact && inexact_seen);
  }
}

}  // namespace
}  // namespace contactcheck::reduce
