#include "reference/timing/speedup.h"

#include <gmock/gmock.h>

#include <cmath>

#include "reference/results/statistics.h"

namespace contactcheck::timing {
namespace {

using testing::ElementsAre;
using testing::Optional;

constexpr double kMillisecond = 1e6;  // nanoseconds

// Means are taken of logarithms: the last digits are lost.
auto Is(double value) { return testing::DoubleNear(value, 1e-12 * value); }

PhaseSample phases(double map_ms, double update_ms, double query_ms) {
  return {map_ms * kMillisecond, update_ms * kMillisecond, query_ms * kMillisecond};
}

// A pass whose frames take these milliseconds, all of it in `update`.
Pass updates(const std::vector<double>& milliseconds) {
  Pass pass;
  for (const double ms : milliseconds) pass.push_back(phases(0.0, ms, 0.0));
  return pass;
}

QuestionSamples played(std::vector<Pass> passes) {
  QuestionSamples samples;
  samples.playback = std::move(passes);
  return samples;
}

TimedFrames without_contact(std::size_t frames) { return {std::vector<bool>(frames), {}}; }

// Three frames, of which the last two have contact; the first and the last were timed cold too.
const TimedFrames kThree = {{false, true, true}, {0, 2}};

// In phases that differ from frame to frame and from pass to pass.
QuestionSamples three_frames() {
  QuestionSamples q;
  q.question = Question::kCells;
  q.playback = {{phases(50, 50, 50), phases(1, 2, 3), phases(5, 3, 2)},
                {phases(70, 10, 10), phases(2, 4, 8), phases(4, 1, 1)}};
  q.cold = {{phases(10, 0, 10), phases(20, 5, 5)}, {phases(2, 3, 5), phases(1, 1, 8)}};
  return q;
}

double sum_of_phases(const results::PhaseTimes& t) {
  return t.map.value_or(0.0) + t.update + t.query;
}

TEST(PlayedFrames, AreAllButTheFirstUnlessThereIsNoOther) {
  EXPECT_THAT(played_frames(1), ElementsAre(0));
  EXPECT_THAT(played_frames(2), ElementsAre(1));
  EXPECT_THAT(played_frames(5), ElementsAre(1, 2, 3, 4));
}

TEST(SummarizeTimes, FrameIsTheGeometricMeanOverPassesOfTheirMeans) {
  const auto t = summarize_times(played({updates({100, 2, 4}), updates({50, 8, 16})}), kThree);
  EXPECT_EQ(t.timed_frames, 3u);
  EXPECT_EQ(t.passes, 2u);
  EXPECT_THAT(t.playback.frame, Is(6.0)) << "of 3 and 12";
}

TEST(SummarizeTimes, TimeOfEachPassIsKept) {
  const auto t = summarize_times(played({updates({100, 2, 4}), updates({50, 8, 16})}), kThree);
  EXPECT_THAT(t.pass_ms, ElementsAre(Is(3.0), Is(12.0)));
  EXPECT_THAT(results::geometric_mean(t.pass_ms), Is(t.playback.frame));
  const auto one = summarize_times(played({updates({7}), updates({5})}), {{true}, {}});
  EXPECT_THAT(one.pass_ms, ElementsAre(Is(7.0), Is(5.0))) << "there is no other frame";
}

TEST(SummarizeTimes, FirstFrameIsGivenApart) {
  const auto t = summarize_times(played({updates({100, 2, 4}), updates({25, 2, 4})}), kThree);
  EXPECT_THAT(t.playback.frame, Is(3.0));
  EXPECT_THAT(t.playback.first_frame, Optional(Is(50.0)));
}

TEST(SummarizeTimes, OfASceneOfOneFrameIsThatFrame) {
  const auto t = summarize_times(played({updates({7})}), {{true}, {0}});
  EXPECT_EQ(t.timed_frames, 1u);
  EXPECT_EQ(t.timed_contact_frames, 1u);
  EXPECT_THAT(t.playback.frame, Is(7.0));
  EXPECT_THAT(t.playback.first_frame, Optional(Is(7.0)));
  EXPECT_THAT(t.playback.contact_frame, Optional(Is(7.0)));
}

TEST(SummarizeTimes, PhasesAddUpToTheFrame) {
  const auto t = summarize_times(three_frames(), kThree);
  EXPECT_EQ(t.question, Question::kCells);
  EXPECT_THAT(t.playback.frame, Is(std::sqrt(8.0 * 10.0)));
  EXPECT_THAT(sum_of_phases(t.playback), Is(t.playback.frame));
  // 12, 10 and 14 of 36 milliseconds over both passes, without their first frames.
  EXPECT_THAT(t.playback.map, Optional(Is(t.playback.frame * 12.0 / 36.0)));
  EXPECT_THAT(t.playback.update, Is(t.playback.frame * 10.0 / 36.0));
  EXPECT_THAT(t.playback.query, Is(t.playback.frame * 14.0 / 36.0));
  ASSERT_TRUE(t.cold);
  EXPECT_THAT(sum_of_phases(*t.cold), Is(t.cold->frame));
}

TEST(SummarizeTimes, LazyMapperHasNoMap) {
  QuestionSamples lazy = played({{phases(0, 1, 1), phases(0, 3, 2)}});
  lazy.lazy_map = true;
  const auto t = summarize_times(lazy, without_contact(2));
  EXPECT_EQ(t.playback.map, std::nullopt);
  EXPECT_THAT(sum_of_phases(t.playback), Is(t.playback.frame));
}

TEST(SummarizeTimes, ContactFrameIsOverFramesWithContactButTheFirst) {
  const QuestionSamples q = played({updates({100, 2, 4})});
  const auto last = summarize_times(q, {{true, false, true}, {}});
  EXPECT_EQ(last.timed_contact_frames, 1u);
  EXPECT_THAT(last.playback.contact_frame, Optional(Is(4.0)));
  const auto only_first = summarize_times(q, {{true, false, false}, {}});
  EXPECT_EQ(only_first.timed_contact_frames, 0u);
  EXPECT_EQ(only_first.playback.contact_frame, std::nullopt);
}

TEST(SummarizeTimes, ColdFramesAreAllCounted) {
  QuestionSamples q = played({updates({1, 1, 1})});
  q.cold = {updates({10, 30})};
  const auto t = summarize_times(q, kThree);
  ASSERT_TRUE(t.cold);
  EXPECT_THAT(t.cold->frame, Is(20.0));
  EXPECT_THAT(t.cold->contact_frame, Optional(Is(30.0))) << "frame 2 of the scene";
  EXPECT_EQ(t.cold->first_frame, std::nullopt);
  EXPECT_EQ(summarize_times(played({updates({1, 1, 1})}), kThree).cold, std::nullopt)
      << "another one's question";
}

TEST(SummarizeTimes, CpuTimeIsOfTheSameFrames) {
  QuestionSamples q = played({updates({5, 2, 4}), updates({5, 2, 4})});
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t f = 0; f < 3; ++f)
      q.playback[p][f].cpu = static_cast<double>(1 + 3 * p + f) * kMillisecond;
  EXPECT_THAT(summarize_times(q, kThree).playback.cpu, Is(std::sqrt(2.5 * 5.5)));
}

// A geometric mean would be 0 as soon as nothing was taken in one pass.
TEST(SummarizeTimes, WhatWasTakenIsTheMeanOverTheSameFramesOfAllPasses) {
  QuestionSamples q = played({updates({5, 2, 4}), updates({5, 2, 4})});
  q.playback[0][0].taken = 100.0 * kMillisecond;  // of the first frame
  q.playback[0][1].taken = 6.0 * kMillisecond;
  q.playback[0][2].taken = 2.0 * kMillisecond;
  q.cold = {updates({1, 1}), updates({1, 1})};
  q.cold[1][0].taken = 1.0 * kMillisecond;
  const auto t = summarize_times(q, kThree);
  EXPECT_THAT(t.playback.taken, Optional(Is(2.0)));
  EXPECT_THAT(t.playback.frame, Is(3.0)) << "it is in none of the times";
  ASSERT_TRUE(t.cold);
  EXPECT_THAT(t.cold->taken, Optional(Is(0.25)));
  EXPECT_EQ(summarize_times(three_frames(), kThree).playback.taken, 0.0) << "none, and looked for";
}

TEST(SummarizeTimes, OwnClockCountsWhereItSpeaksOfEveryFrame) {
  QuestionSamples q = played({updates({5, 2, 4})});
  for (PhaseSample& frame : q.playback[0]) frame.reported = 0.5 * frame.update;
  EXPECT_THAT(summarize_times(q, kThree).playback.self_reported, Optional(Is(1.5)));
  q.playback[0][1].reported.reset();
  EXPECT_EQ(summarize_times(q, kThree).playback.self_reported, std::nullopt);
}

TEST(FrameMs, IsTheMedianOverPassesOfEveryFrame) {
  const auto times =
      frame_ms(played({updates({9, 1, 2}), updates({7, 5, 2}), updates({8, 3, 100})}));
  ASSERT_EQ(times.size(), 3u);
  EXPECT_THAT(times[0], Optional(Is(8.0)));
  EXPECT_THAT(times[1], Optional(Is(3.0)));
  EXPECT_THAT(times[2], Optional(Is(2.0)));
}

QuestionSamples scaled(QuestionSamples samples, double factor) {
  for (auto* regime : {&samples.playback, &samples.cold})
    for (Pass& pass : *regime)
      for (PhaseSample& s : pass) s = {factor * s.map, factor * s.update, factor * s.query};
  return samples;
}

void expect_ratio(const results::Ratio& r, double low, double value, double high) {
  EXPECT_THAT(r.low, Is(low));
  EXPECT_THAT(r.value, Is(value));
  EXPECT_THAT(r.high, Is(high));
}

TEST(ComputeSpeedup, DoubledSamplesAreTwiceInAllParts) {
  const auto s = compute_speedup(scaled(three_frames(), 2.0), three_frames(), kThree);
  expect_ratio(s.playback, 2.0, 2.0, 2.0);
  ASSERT_TRUE(s.cold && s.contact_frames && s.without_map);
  expect_ratio(*s.cold, 2.0, 2.0, 2.0);
  expect_ratio(*s.contact_frames, 2.0, 2.0, 2.0);
  expect_ratio(*s.without_map, 2.0, 2.0, 2.0);
  EXPECT_EQ(s.passes, 2u);
}

TEST(ComputeSpeedup, AboveOneMeansFasterThanTheReference) {
  const auto s =
      compute_speedup(played({updates({9, 6})}), played({updates({9, 2})}), without_contact(2));
  expect_ratio(s.playback, 3.0, 3.0, 3.0);
}

TEST(ComputeSpeedup, FirstFrameCountsOnlyInASceneOfOne) {
  const auto many = compute_speedup(played({updates({900, 4, 2})}), played({updates({1, 2, 1})}),
                                    without_contact(3));
  EXPECT_THAT(many.playback.value, Is(2.0));
  const auto one =
      compute_speedup(played({updates({900})}), played({updates({100})}), without_contact(1));
  EXPECT_THAT(one.playback.value, Is(9.0));
}

TEST(ComputeSpeedup, OfFewPassesHasTheirRange) {
  const auto s = compute_speedup(played({updates({1, 2}), updates({1, 8})}),
                                 played({updates({1, 1}), updates({1, 1})}), without_contact(2));
  expect_ratio(s.playback, 2.0, 4.0, 8.0);
}

TEST(ComputeSpeedup, OfFivePassesHasAnIntervalRoundItsValue) {
  std::vector<Pass> reference, detector;
  for (const double ms : {2.0, 4.0, 4.0, 4.0, 8.0}) {
    reference.push_back(updates({1, ms}));
    detector.push_back(updates({1, 1}));
  }
  const auto s = compute_speedup(played(reference), played(detector), without_contact(2));
  EXPECT_EQ(s.passes, 5u);
  EXPECT_THAT(s.playback.value, Is(4.0));
  // The logarithms deviate by log(2) / sqrt(2).
  const double half_width = 2.776 * std::log(2.0) / std::sqrt(2.0) / std::sqrt(5.0);
  EXPECT_NEAR(s.playback.high, 4.0 * std::exp(half_width), 1e-3);
  EXPECT_NEAR(s.playback.low, 4.0 / std::exp(half_width), 1e-3);
}

// A machine that is slower in one pass slows both sides.
TEST(ComputeSpeedup, ComparesPassByPass) {
  const auto s = compute_speedup(played({updates({1, 6}), updates({1, 60})}),
                                 played({updates({1, 2}), updates({1, 20})}), without_contact(2));
  expect_ratio(s.playback, 3.0, 3.0, 3.0);
}

TEST(ComputeSpeedup, TakesAsManyPassesOfBothSides) {
  const QuestionSamples slow = played({updates({1, 6})});
  const QuestionSamples often = played({updates({1, 2}), updates({1, 1}), updates({1, 1})});
  EXPECT_EQ(compute_speedup(slow, often, without_contact(2)).passes, 1u);
  expect_ratio(compute_speedup(slow, often, without_contact(2)).playback, 3.0, 3.0, 3.0);
  EXPECT_EQ(compute_speedup(often, slow, without_contact(2)).passes, 1u);
}

TEST(ComputeSpeedup, ContactFramesAreApart) {
  const QuestionSamples reference = played({updates({5, 8, 3})}),
                        detector = played({updates({5, 1, 1})});
  const auto s = compute_speedup(reference, detector, {{false, false, true}, {}});
  EXPECT_THAT(s.playback.value, Is(5.5));
  ASSERT_TRUE(s.contact_frames);
  EXPECT_THAT(s.contact_frames->value, Is(3.0));
  EXPECT_EQ(compute_speedup(reference, detector, without_contact(3)).contact_frames, std::nullopt);
}

TEST(ComputeSpeedup, WithoutMapLeavesTheMappingOut) {
  const auto s =
      compute_speedup(played({{phases(1, 1, 1), phases(5, 2, 2)}}),
                      played({{phases(1, 1, 1), phases(5, 0.5, 0.5)}}), without_contact(2));
  EXPECT_THAT(s.playback.value, Is(1.5));
  ASSERT_TRUE(s.without_map);
  EXPECT_THAT(s.without_map->value, Is(4.0));
}

TEST(ComputeSpeedup, WithoutMapIsNullWhenEitherSideMapsLazily) {
  const QuestionSamples eager = three_frames();
  QuestionSamples lazy = eager;
  lazy.lazy_map = true;
  EXPECT_EQ(compute_speedup(eager, lazy, kThree).without_map, std::nullopt);
  EXPECT_EQ(compute_speedup(lazy, eager, kThree).without_map, std::nullopt);
}

TEST(ComputeSpeedup, ColdIsThereWhereBothHaveIt) {
  QuestionSamples reference = three_frames(), detector = three_frames();
  reference.cold = {updates({8, 4})};
  detector.cold = {updates({1, 2})};
  const auto s = compute_speedup(reference, detector, kThree);
  ASSERT_TRUE(s.cold);
  EXPECT_THAT(s.cold->value, Is(4.0)) << "the first cold frame counts";
  detector.cold.clear();
  EXPECT_EQ(compute_speedup(reference, detector, kThree).cold, std::nullopt);
}

TEST(ComputeSpeedup, OfAClockThatHasNotTickedIsFinite) {
  const auto s =
      compute_speedup(played({updates({0, 0})}), played({updates({0, 0})}), without_contact(2));
  expect_ratio(s.playback, 1.0, 1.0, 1.0);
}

}  // namespace
}  // namespace contactcheck::timing
