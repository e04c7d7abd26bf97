#include "reference/judge/episodes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

namespace contactcheck::judge {
namespace {

using testing::Optional;

constexpr BodyPair kPair{0, 1}, kOther{1, 2};

// One letter per frame: 't' true only, 'r' reported only, 'b' both, '.' neither.
struct Script {
  BodyPairsPerFrame truth, reported;

  void add(const std::string& frames, BodyPair pair) {
    truth.resize(frames.size());
    reported.resize(frames.size());
    for (std::size_t f = 0; f < frames.size(); ++f) {
      if (frames[f] == 't' || frames[f] == 'b') truth[f].push_back(pair);
      if (frames[f] == 'r' || frames[f] == 'b') reported[f].push_back(pair);
    }
  }
};

std::vector<results::Episode> episodes_of(const std::string& frames) {
  Script script;
  script.add(frames, kPair);
  return find_episodes(script.truth, script.reported);
}

TEST(Episodes, NoneWithoutContact) { EXPECT_TRUE(episodes_of(".....").empty()); }

TEST(Episodes, ReportOnTimeIsZeroFramesLate) {
  const auto found = episodes_of("..bbb.");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].bodies, kPair);
  EXPECT_THAT(found[0].first_true, Optional(2u));
  EXPECT_THAT(found[0].first_reported, Optional(2u));
  EXPECT_THAT(found[0].late_frames, Optional(0L));
  EXPECT_EQ(found[0].hover_gap, std::nullopt);
}

TEST(Episodes, EarlyReportIsNegative) {
  const auto found = episodes_of(".rrrbb");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].late_frames, Optional(-3L));
}

TEST(Episodes, LateReportIsPositive) {
  const auto found = episodes_of(".ttbb");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].late_frames, Optional(2L));
}

TEST(Episodes, NeverReportedHasNoLateness) {
  const auto found = episodes_of(".ttt.");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].first_true, Optional(1u));
  EXPECT_EQ(found[0].first_reported, std::nullopt);
  EXPECT_EQ(found[0].late_frames, std::nullopt);
}

TEST(Episodes, SpuriousOnlyHasNoTrueFrame) {
  const auto found = episodes_of("..rr.");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].first_true, std::nullopt);
  EXPECT_THAT(found[0].first_reported, Optional(2u));
  EXPECT_EQ(found[0].late_frames, std::nullopt);
}

TEST(Episodes, TwoContactsOfOnePairAreTwoEpisodes) {
  const auto found = episodes_of("bb..tb.");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_THAT(found[0].late_frames, Optional(0L));
  EXPECT_THAT(found[1].first_true, Optional(4u));
  EXPECT_THAT(found[1].late_frames, Optional(1L));
}

TEST(Episodes, FalseReportBetweenTwoContactsJoinsThem) {
  const auto found = episodes_of(".brb.");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].first_true, Optional(1u));
}

TEST(Episodes, ContactFromTheFirstFrame) {
  const auto found = episodes_of("bbb");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].first_true, Optional(0u));
  EXPECT_THAT(found[0].first_reported, Optional(0u));
}

TEST(Episodes, PairsAreKeptApart) {
  Script script;
  script.add(".bb.", kPair);
  script.add("r.tt", kOther);
  const auto found = find_episodes(script.truth, script.reported);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].bodies, kPair);
  EXPECT_EQ(found[1].bodies, kOther);
  EXPECT_EQ(found[1].first_true, std::nullopt);
  EXPECT_EQ(found[2].bodies, kOther);
  EXPECT_EQ(found[2].first_reported, std::nullopt);
}

// A gap that closes linearly, and a detector that reports below a threshold.
struct Closing {
  double start, speed, threshold;
  double gap(double t) const { return std::max(0.0, start - speed * t); }
  bool reports(double t) const { return gap(t) <= threshold; }
};

double hover_gap_of(const Closing& c, double before, double after, double tolerance) {
  return bisect_hover_gap(
      before, after, tolerance, [&](double t) { return c.reports(t); },
      [&](double t) { return c.gap(t); });
}

TEST(BisectHoverGap, FindsTheThresholdOfALinearApproach) {
  const double tolerance = 1e-6;
  for (const double threshold : {0.013, 0.1, 0.25, 0.4999}) {
    const Closing closing{1.0, 0.5, threshold};
    const double gap = hover_gap_of(closing, 0.0, 2.0, tolerance);
    EXPECT_LE(gap, threshold);
    EXPECT_GE(gap, threshold - tolerance);
  }
}

TEST(BisectHoverGap, HoldsTheWantedToleranceAndNoBetter) {
  const Closing closing{1.0, 1.0, 0.3};
  int calls = 0;
  const double gap = bisect_hover_gap(
      0.0, 1.0, 1e-2,
      [&](double t) {
        ++calls;
        return closing.reports(t);
      },
      [&](double t) { return closing.gap(t); });
  EXPECT_NEAR(gap, 0.3, 1e-2);
  EXPECT_EQ(calls, 7);  // 2^-7 is the first below 1e-2
}

TEST(BisectHoverGap, ExactDetectorHoversNowhere) {
  EXPECT_EQ(hover_gap_of({1.0, 0.7, 0.0}, 1.0, 2.0, 1e-6), 0.0);
}

TEST(BisectHoverGap, BothTouchingIsZeroWithoutAsking) {
  const double gap = bisect_hover_gap(
      0.0, 1.0, 1e-6,
      [](double) {
        ADD_FAILURE() << "there is nothing to bisect";
        return true;
      },
      [](double) { return 0.0; });
  EXPECT_EQ(gap, 0.0);
}

TEST(BisectHoverGap, EqualGapsAtBothEndsAreNotBelieved) {
  // The bodies come near and part within the interval: both ends are 0.5 apart.
  const auto distance = [](double t) { return std::abs(t - 0.5); };
  const auto reports = [](double t) { return t >= 0.4; };
  EXPECT_NEAR(bisect_hover_gap(0.0, 1.0, 1e-6, reports, distance), 0.1, 1e-6);
}

TEST(BisectHoverGap, EndsThoughTheGapJumps) {
  const auto distance = [](double t) { return t < 0.3 ? 1.0 : 0.2; };
  const auto reports = [](double t) { return t >= 0.3; };
  EXPECT_EQ(bisect_hover_gap(0.0, 1.0, 1e-6, reports, distance), 0.2);
}

results::Episode episode(std::optional<double> gap, std::optional<long> late) {
  return {{0, 1}, {}, {}, gap, late};
}

TEST(SumUpEpisodes, NothingOfNone) {
  results::Geometry geometry;
  sum_up_episodes(geometry);
  EXPECT_EQ(geometry.hover_gap_max, std::nullopt);
  EXPECT_EQ(geometry.late_frames, std::nullopt);
}

TEST(SumUpEpisodes, TheLargestGapAndTheWorstLatenessWithItsSign) {
  results::Geometry geometry;
  geometry.episodes = {episode(0.5, 2), episode(std::nullopt, std::nullopt), episode(0.25, -3)};
  sum_up_episodes(geometry);
  EXPECT_EQ(geometry.hover_gap_max, 0.5);
  EXPECT_EQ(geometry.late_frames, -3);
}

}  // namespace
}  // namespace contactcheck::judge
