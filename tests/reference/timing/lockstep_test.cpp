#include "reference/timing/lockstep.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "tests/reference/judge/two_balls.h"

namespace contactcheck::timing {
namespace {

using test::Blind;
using test::falling_balls;
using test::TruthfulDetector;
using testing::HasSubstr;

using Fed = std::vector<std::vector<Vec3>>;  // the nodes of every body

// What one entry went through, kept by the test: the entry's detector dies with it.
struct StepDiary {
  std::vector<Fed> fed;
  std::vector<std::size_t> contacts;
};

// Writes down what it is fed and what it answers.
template <typename Base>
class Writes : public Base {
 public:
  Writes(StepDiary& diary, std::vector<const StepDiary*>& turns) : diary_(diary), turns_(turns) {}
  void update(const Frame& frame) override {
    Base::update(frame);
    turns_.push_back(&diary_);
    Fed& fed = diary_.fed.emplace_back();
    for (const BodyState& body : frame.bodies)
      fed.emplace_back(body.nodes.begin(), body.nodes.end());
  }
  void query(Question question, ContactSet& out) override {
    Base::query(question, out);
    diary_.contacts.push_back(out.triangles.size());
  }

 private:
  StepDiary& diary_;
  std::vector<const StepDiary*>& turns_;
};

class ThrowsInQuery : public TruthfulDetector {
 public:
  explicit ThrowsInQuery(std::size_t& calls) : calls_(calls) {}
  void query(Question, ContactSet&) override {
    ++calls_;
    throw std::runtime_error("out of order");
  }

 private:
  std::size_t& calls_;
};

class ThrowsInPrepare : public TruthfulDetector {
  void prepare(const std::vector<Body>&) override { throw std::runtime_error("no such body"); }
};

class AnswersBodiesAlone : public TruthfulDetector {
 public:
  AnswersBodiesAlone() { own_.questions = {Question::kBody}; }
  const Semantics& semantics() const override { return own_; }

 private:
  Semantics own_;
};

class Lockstep : public testing::Test {
 protected:
  template <typename Kind, typename... Arguments>
  void add(Arguments&... arguments) {
    const auto position = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({position, std::make_unique<Kind>(arguments...), 0, {}, ""});
  }
  void run(const LockstepSettings& settings) {
    TruthfulDetector driver;
    run_lockstep(scene_, driver, settings, entries_, progress_);
  }
  static void expect_times(const LockstepEntry& entry, std::size_t steps, std::size_t repeats) {
    EXPECT_EQ(entry.error, "");
    EXPECT_EQ(entry.steps, steps);
    ASSERT_EQ(entry.sums.size(), repeats);
    for (const StepSum& sum : entry.sums) {
      EXPECT_GT(sum.mss, 0.0);
      EXPECT_GT(sum.cell, 0.0);
      EXPECT_GT(sum.test, 0.0);
      EXPECT_GT(sum.response, 0.0);
    }
  }

  process::SharedProgress page_;
  process::ProgressWriter progress_{&page_};
  scene::Scene scene_ = falling_balls(30);  // the balls meet in the middle of it
  std::vector<LockstepEntry> entries_;
  std::vector<const StepDiary*> turns_;
};

TEST_F(Lockstep, EveryEntryHasStepsAndRepeatsAsAskedAndPositiveSums) {
  add<TruthfulDetector>();
  add<Blind>();
  run({.steps = 6, .repeats = 3});
  for (const LockstepEntry& entry : entries_) expect_times(entry, 6, 3);
}

TEST_F(Lockstep, ShortMotionHasNoMoreStepsThanItsOwn) {
  scene_ = falling_balls(4);
  scene_.simulation()->every = 2;
  add<Blind>();
  run({.steps = 40, .repeats = 2});
  expect_times(entries_[0], 8, 2);
}

TEST_F(Lockstep, EveryRepeatOfEveryEntryIsFedTheSameNodes) {
  StepDiary exact, blind;
  add<Writes<TruthfulDetector>>(exact, turns_);
  add<Writes<Blind>>(blind, turns_);
  constexpr std::size_t kSteps = 15, kRepeats = 3;
  run({.steps = kSteps, .repeats = kRepeats});
  ASSERT_EQ(exact.fed.size(), kSteps * kRepeats);
  EXPECT_EQ(blind.fed, exact.fed) << "what one does is not seen by the other";
  EXPECT_NE(exact.fed[0], exact.fed[1]) << "the motion goes on";
  for (std::size_t i = kSteps; i < exact.fed.size(); ++i) {
    EXPECT_EQ(exact.fed[i], exact.fed[i % kSteps]) << "call " << i;
    EXPECT_EQ(exact.contacts[i], exact.contacts[i % kSteps]) << "call " << i;
  }
  EXPECT_THAT(exact.contacts, testing::Contains(testing::Gt(0u))) << "or nobody did anything";
}

TEST_F(Lockstep, StatesAreSpreadOverTheMotionOfTheScenesDriver) {
  StepDiary diary;
  add<Writes<Blind>>(diary, turns_);
  run({.steps = 3, .repeats = 1});
  StepDiary whole;
  Writes<TruthfulDetector> watched(whole, turns_);
  std::vector<LockstepEntry> none;
  run_lockstep(scene_, watched, {.steps = 30, .repeats = 1}, none, progress_);
  ASSERT_EQ(diary.fed.size(), 3u);
  // The middles of thirds of 30 steps.
  EXPECT_EQ(diary.fed[0], whole.fed.at(5));
  EXPECT_EQ(diary.fed[1], whole.fed.at(15));
  EXPECT_EQ(diary.fed[2], whole.fed.at(25));
}

TEST_F(Lockstep, EntriesTakeTurnsAtEveryStepAndTheFirstRotates) {
  StepDiary a, b, c;
  for (StepDiary* diary : {&a, &b, &c}) add<Writes<Blind>>(*diary, turns_);
  run({.steps = 2, .repeats = 2});
  EXPECT_THAT(turns_, testing::ElementsAre(&a, &b, &c, &a, &b, &c,  //
                                           &b, &c, &a, &b, &c, &a));
}

TEST_F(Lockstep, EntryThatThrowsHasAnErrorAndNoTimesAndStopsNobodyElse) {
  std::size_t calls = 0;
  add<TruthfulDetector>();
  add<ThrowsInQuery>(calls);
  add<ThrowsInPrepare>();
  add<AnswersBodiesAlone>();
  add<Blind>();
  run({.steps = 4, .repeats = 2});
  EXPECT_EQ(calls, 1u) << "it is not called again";
  EXPECT_THAT(entries_[1].error, HasSubstr("out of order"));
  EXPECT_THAT(entries_[2].error, HasSubstr("no such body"));
  EXPECT_THAT(entries_[3].error, HasSubstr("neither cells nor triangles"));
  for (std::size_t i : {1u, 2u, 3u}) {
    EXPECT_EQ(entries_[i].steps, 0u) << i;
    EXPECT_TRUE(entries_[i].sums.empty()) << i;
  }
  expect_times(entries_[0], 4, 2);
  expect_times(entries_[4], 4, 2);
}

TEST_F(Lockstep, WhatTheScenesDriverThrowsPassesThrough) {
  std::size_t calls = 0;
  ThrowsInQuery driver(calls);
  add<Blind>();
  EXPECT_THROW(run_lockstep(scene_, driver, {}, entries_, progress_), std::runtime_error);
}

}  // namespace
}  // namespace contactcheck::timing
