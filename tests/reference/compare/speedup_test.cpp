#include "reference/compare/speedup.h"

#include <gmock/gmock.h>

#include <random>

namespace contactcheck {
namespace {

constexpr double kMillisecond = 1e6;  // nanoseconds

// Whole-frame times in milliseconds, spent in `update`; hot is half of cold.
FrameSamples updates(const std::vector<double>& milliseconds) {
  FrameSamples out;
  for (double ms : milliseconds) {
    out.cold.push_back({0.0, ms * kMillisecond, 0.0});
    out.hot.push_back({0.0, 0.5 * ms * kMillisecond, 0.0});
  }
  return out;
}

// Frame 2: three repeats with map, update, query that have their medians in different repeats.
QuestionSamples two_frames() {
  QuestionSamples q;
  q.question = Question::kCells;
  q.frames[2].cold = {{1e6, 9e6, 2e6}, {2e6, 5e6, 8e6}, {3e6, 4e6, 1e6}};
  q.frames[2].hot = {{1e6, 1e6, 1e6}, {2e6, 2e6, 2e6}, {6e6, 6e6, 6e6}};
  q.frames[5] = {{{4e6, 7e6, 4e6}, {4e6, 7e6, 4e6}, {4e6, 7e6, 4e6}},
                 {{4e6, 4e6, 4e6}, {4e6, 4e6, 4e6}, {4e6, 4e6, 4e6}}};
  return q;
}

const std::vector<bool> kContactInFive = {false, false, false, false, false, true, true};

TEST(SummarizeTimes, IsTheMeanOverFramesOfMediansOverRepeats) {
  const results::QuestionTimes t = summarize_times({two_frames()}, kContactInFive);
  EXPECT_EQ(t.question, Question::kCells);
  EXPECT_EQ(t.timed_frames, 2u);
  EXPECT_EQ(t.timed_contact_frames, 1u);
  EXPECT_EQ(t.repeats, 3u);
  // Frame 2: map 2, update 5, query 2, whole 12 (of 12, 15, 8); frame 5: 4, 7, 4, 15.
  EXPECT_THAT(t.cold.map, testing::Optional(testing::DoubleEq(3.0)));
  EXPECT_DOUBLE_EQ(t.cold.update, 6.0);
  EXPECT_DOUBLE_EQ(t.cold.query, 3.0);
  EXPECT_DOUBLE_EQ(t.cold.frame, 13.5);
  EXPECT_THAT(t.cold.contact_frame, testing::Optional(testing::DoubleEq(15.0)));
  // Hot: frame 2 has 6, frame 5 has 12.
  EXPECT_DOUBLE_EQ(t.hot.frame, 9.0);
}

TEST(SummarizeTimes, LazyMapperHasNoMapAndNoContactFrameWithoutContact) {
  QuestionSamples lazy = two_frames();
  lazy.lazy_map = true;
  const results::QuestionTimes t = summarize_times({lazy}, std::vector<bool>(7, false));
  EXPECT_EQ(t.cold.map, std::nullopt);
  EXPECT_EQ(t.cold.contact_frame, std::nullopt);
  EXPECT_EQ(t.timed_contact_frames, 0u);
}

TEST(SummarizeTimes, PoolsTheRepeatsOfAllProcesses) {
  QuestionSamples first, second;
  first.frames[0] = updates({1.0, 2.0, 3.0});
  second.frames[0] = updates({10.0, 20.0, 30.0});
  const results::QuestionTimes t = summarize_times({first, second}, {false});
  EXPECT_EQ(t.repeats, 6u);
  EXPECT_DOUBLE_EQ(t.cold.frame, 6.5);  // of 1 2 3 10 20 30
}

TEST(ColdFrameMs, IsTheMedianPerFrame) {
  const auto times = cold_frame_ms({two_frames()}, 7);
  ASSERT_EQ(times.size(), 7u);
  for (const std::size_t untimed : {0, 1, 3, 4, 6}) EXPECT_EQ(times[untimed], std::nullopt);
  EXPECT_DOUBLE_EQ(times[2].value(), 12.0);
  EXPECT_DOUBLE_EQ(times[5].value(), 15.0);
}

ProcessSamples scaled(ProcessSamples processes, double factor) {
  for (QuestionSamples& q : processes)
    for (auto& [frame, samples] : q.frames)
      for (auto* mode : {&samples.cold, &samples.hot})
        for (PhaseSample& s : *mode) s = {factor * s.map, factor * s.update, factor * s.query};
  return processes;
}

void expect_exactly(const Ratio& r, double value) {
  EXPECT_EQ(r.value, value);
  EXPECT_EQ(r.low, value);
  EXPECT_EQ(r.high, value);
}

TEST(ComputeSpeedup, DoubledSamplesAreExactlyTwiceWithoutUncertainty) {
  const ProcessSamples detector = {two_frames(), two_frames()};
  const auto s = compute_speedup(scaled(detector, 2.0), detector, kContactInFive);
  ASSERT_TRUE(s);
  expect_exactly(s->cold, 2.0);
  expect_exactly(s->hot, 2.0);
  ASSERT_TRUE(s->contact_frames);
  expect_exactly(*s->contact_frames, 2.0);
  ASSERT_TRUE(s->without_map);
  expect_exactly(*s->without_map, 2.0);
}

TEST(ComputeSpeedup, AboveOneMeansFasterThanTheReference) {
  QuestionSamples slow, fast;
  slow.frames[0] = updates({6.0});
  fast.frames[0] = updates({2.0});
  EXPECT_EQ(compute_speedup({slow}, {fast}, {false})->cold.value, 3.0);
}

TEST(ComputeSpeedup, UsesOnlyFramesThatBothWereTimedOn) {
  QuestionSamples reference, detector;
  reference.frames[0] = updates({4.0, 4.0});
  reference.frames[1] = updates({1000.0, 1000.0});
  detector.frames[0] = updates({1.0, 1.0});
  detector.frames[2] = updates({1000.0, 1000.0});
  const auto s = compute_speedup({reference}, {detector}, {false, true, true});
  ASSERT_TRUE(s);
  expect_exactly(s->cold, 4.0);
  EXPECT_EQ(s->contact_frames, std::nullopt) << "no contact frame is common to both";
}

TEST(ComputeSpeedup, NoneWithoutACommonFrame) {
  QuestionSamples reference, detector;
  reference.frames[0] = updates({4.0});
  detector.frames[1] = updates({1.0});
  EXPECT_EQ(compute_speedup({reference}, {detector}, {false, false}), std::nullopt);
}

TEST(ComputeSpeedup, ContactFramesAreApart) {
  QuestionSamples reference, detector;
  reference.frames[0] = updates({8.0});
  reference.frames[1] = updates({3.0});
  detector.frames[0] = updates({1.0});
  detector.frames[1] = updates({1.0});
  const auto s = compute_speedup({reference}, {detector}, {false, true});
  expect_exactly(s->cold, 5.5);
  ASSERT_TRUE(s->contact_frames);
  expect_exactly(*s->contact_frames, 3.0);
}

TEST(ComputeSpeedup, WithoutMapLeavesTheMappingOut) {
  QuestionSamples reference, detector;
  reference.frames[0].cold = reference.frames[0].hot = {{5e6, 2e6, 2e6}};
  detector.frames[0].cold = detector.frames[0].hot = {{5e6, 0.5e6, 0.5e6}};
  const auto s = compute_speedup({reference}, {detector}, {false});
  EXPECT_EQ(s->cold.value, 1.5);
  ASSERT_TRUE(s->without_map);
  EXPECT_EQ(s->without_map->value, 4.0);
}

TEST(ComputeSpeedup, WithoutMapIsNullWhenEitherSideMapsLazily) {
  ProcessSamples eager = {two_frames()}, lazy = {two_frames()};
  lazy[0].lazy_map = true;
  EXPECT_EQ(compute_speedup(eager, lazy, kContactInFive)->without_map, std::nullopt);
  EXPECT_EQ(compute_speedup(lazy, eager, kContactInFive)->without_map, std::nullopt);
  EXPECT_NE(compute_speedup(eager, eager, kContactInFive)->without_map, std::nullopt);
}

// A uniform number in [-1, 1], the same on every machine.
double noise(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
}

ProcessSamples noisy(double milliseconds, std::mt19937_64& random, int processes) {
  constexpr int kFrames = 12, kRepeats = 5;
  ProcessSamples out(processes);
  for (QuestionSamples& q : out)
    for (int f = 0; f < kFrames; ++f) {
      std::vector<double> repeats;
      for (int r = 0; r < kRepeats; ++r)
        repeats.push_back(milliseconds * (1.0 + 0.2 * noise(random)));
      q.frames[f] = updates(repeats);
    }
  return out;
}

struct Coverage {
  int holds = 0;
  double widest = 0.0;
};

// How many of 100 intervals hold the true ratio, 3.
Coverage coverage(int processes) {
  Coverage out;
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 100; ++trial) {
    const ProcessSamples reference = noisy(6.0, random, processes);
    const ProcessSamples detector = noisy(2.0, random, processes);
    const Ratio r = compute_speedup(reference, detector, std::vector<bool>(12))->cold;
    if (r.low <= 3.0 && 3.0 <= r.high) ++out.holds;
    out.widest = std::max(out.widest, r.high - r.low);
  }
  return out;
}

TEST(ComputeSpeedup, IntervalHoldsTheTruthInNineOfTenTrials) {
  const Coverage c = coverage(1);
  EXPECT_GE(c.holds, 90);
  EXPECT_LT(c.widest, 0.75) << "an interval that says nothing always holds the truth";
}

TEST(ComputeSpeedup, IntervalHoldsTheTruthOverSeveralProcesses) {
  const Coverage c = coverage(3);
  EXPECT_GE(c.holds, 90);
  EXPECT_LT(c.widest, 0.75);
}

}  // namespace
}  // namespace contactcheck
