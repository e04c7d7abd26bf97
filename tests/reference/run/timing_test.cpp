#include "reference/run/timing.h"

#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using testing::ElementsAre;

struct Call {
  char detector;
  std::size_t frame;
  bool operator==(const Call&) const = default;
};

void PrintTo(const Call& c, std::ostream* out) { *out << c.detector << c.frame; }

// Writes down when it is called.
class Diary : public Detector {
 public:
  Diary(char name, bool vertices, std::vector<Call>& calls)
      : name_(name), needs_vertices_(vertices), calls_(calls) {
    semantics_.questions = {Question::kBody};
  }
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return needs_vertices_; }
  void prepare(const std::vector<Body>&) override {}
  void update(const Frame& frame) override {
    calls_.push_back({name_, frame.index});
    if (name_ == 'X') throw std::runtime_error("out of order");
  }
  void query(Question, ContactSet& out) override {
    EXPECT_TRUE(out.bodies.empty()) << "an answer begins empty";
    out.bodies.push_back({0, 1});
  }

 protected:
  char name_;
  bool needs_vertices_;
  std::vector<Call>& calls_;
  Semantics semantics_;
};

// Answers with the bodies named twice, and with nothing where its word says so: C in every cold
// call, H in every hot one, L from the third query on; O names others.
class Forgetful : public Diary {
 public:
  Forgetful(char word, std::vector<Call>& calls) : Diary(word, true, calls) {}
  void query(Question, ContactSet& out) override {
    const bool hot = queries_++ % 2 == 1;
    if ((name_ == 'C' && !hot) || (name_ == 'H' && hot) || (name_ == 'L' && queries_ > 2)) return;
    out.bodies = {{1, 0}, {0, 1}};
    if (name_ == 'O') out.bodies = {{0, 2}};
  }

 private:
  int queries_ = 0;
};

// Writes down what a supervisor sees while it is called.
class Watched : public Diary {
 public:
  Watched(const SharedProgress& page, bool vertices, std::vector<Call>& calls)
      : Diary('W', vertices, calls), page_(page) {}
  void update(const Frame&) override { look(); }
  void query(Question, ContactSet&) override { look(); }

  std::vector<Phase> phases;
  std::vector<std::uint64_t> ticks;

 private:
  void look() {
    phases.push_back(page_.phase);
    ticks.push_back(page_.ticks);
  }
  const SharedProgress& page_;
};

class Timing : public testing::Test {
 protected:
  Timing()
      : scene_(test::approach_scene(test::make_body("", test::unit_box_mesh(1), {1, 1, 1}).shape,
                                    test::make_body("", test::unit_box_mesh(1), {1, 1, 1}).shape,
                                    {{0.0, 1.3}, {1.0, 0.7}}, 0.1, 0.2, 3, 0.35, {Level::kBody})),
        judged_(judge_scene(scene_, false, progress_)) {}

  TimedEntry entry(Detector& detector, std::size_t frames) {
    TimedEntry e;
    e.detector = &detector;
    e.frames = frames;
    return e;
  }

  // What is wrong with one that was judged by the answer "bodies 0 and 1" to every frame.
  std::string error_of(char word) {
    ContactSet judged;
    judged.bodies = {{0, 1}};
    const std::vector<AnswerPrint> prints(3, print_of(judged, {Question::kBody, true}));
    Forgetful detector(word, calls_);
    std::vector<TimedEntry> entries = {entry(detector, 2)};
    entries[0].question = Question::kBody;
    entries[0].judged = &prints;
    run_timing(judged_, {1, 0}, 2, 1 << 12, entries, progress_);
    return entries[0].error;
  }

  std::vector<Call> calls_;
  SharedProgress page_;
  ProgressWriter progress_{&page_};
  Scene scene_;
  JudgedScene judged_;
};

TEST_F(Timing, RotatesTheDetectorsFromRepeatToRepeatColdThenHot) {
  Diary a('A', true, calls_), b('B', true, calls_), c('C', true, calls_);
  std::vector<TimedEntry> entries = {entry(a, 1), entry(b, 1), entry(c, 1)};
  run_timing(judged_, {2, 0, 1}, 2, 1 << 12, entries, progress_);
  EXPECT_THAT(calls_, ElementsAre(Call{'A', 2}, Call{'A', 2}, Call{'B', 2}, Call{'B', 2},
                                  Call{'C', 2}, Call{'C', 2},  //
                                  Call{'B', 2}, Call{'B', 2}, Call{'C', 2}, Call{'C', 2},
                                  Call{'A', 2}, Call{'A', 2}));
}

TEST_F(Timing, TimesEachEntryOnItsPrefixOfTheOrder) {
  Diary a('A', true, calls_), b('B', true, calls_);
  std::vector<TimedEntry> entries = {entry(a, 3), entry(b, 1)};
  run_timing(judged_, {2, 0, 1}, 5, 1 << 12, entries, progress_);
  ASSERT_EQ(entries[0].samples.frames.size(), 3u);
  ASSERT_EQ(entries[1].samples.frames.size(), 1u);
  EXPECT_EQ(entries[1].samples.frames.begin()->first, 2u);
  for (const TimedEntry& e : entries)
    for (const auto& [frame, samples] : e.samples.frames) {
      EXPECT_EQ(samples.cold.size(), 5u);
      EXPECT_EQ(samples.hot.size(), 5u);
    }
}

TEST_F(Timing, SupervisorSeesThePhaseOfEveryCallAndThatItIsANewOne) {
  for (const bool vertices : {true, false}) {
    Watched detector(page_, vertices, calls_);
    std::vector<TimedEntry> entries = {entry(detector, 1)};
    run_timing(judged_, {0}, 1, 1 << 12, entries, progress_);
    EXPECT_THAT(detector.phases,
                ElementsAre(Phase::kUpdate, Phase::kQuery, Phase::kUpdate, Phase::kQuery));
    for (std::size_t i = 1; i < detector.ticks.size(); ++i)
      EXPECT_GT(detector.ticks[i], detector.ticks[i - 1]) << "call " << i;
  }
}

// No call of the detector happens meanwhile, so that another thread looks.
TEST_F(Timing, SupervisorSeesMapping) {
  const auto fine = test::make_body("", test::unit_box_mesh(40), {1, 1, 1}).shape;
  const Scene scene =
      test::approach_scene(fine, fine, {{0.0, 1.3}, {1.0, 0.7}}, 0.1, 0.2, 3, 0.35, {Level::kBody});
  const JudgedScene judged = judge_scene(scene, false, progress_);
  std::atomic<bool> seen = false, done = false;
  std::thread supervisor([&] {
    while (!seen && !done) seen = page_.phase == Phase::kMap;
  });
  Diary eager('A', true, calls_);
  std::vector<TimedEntry> entries = {entry(eager, 1)};
  for (int i = 0; i < 10'000 && !seen; ++i) run_timing(judged, {0}, 1, 1 << 12, entries, progress_);
  done = true;
  supervisor.join();
  EXPECT_TRUE(seen);
}

TEST_F(Timing, MapsForThoseWhoNeedVerticesAlone) {
  Diary eager('A', true, calls_), lazy('B', false, calls_);
  std::vector<TimedEntry> entries = {entry(eager, 1), entry(lazy, 1)};
  run_timing(judged_, {0}, 1, 1 << 12, entries, progress_);
  EXPECT_GT(entries[0].samples.frames.at(0).cold.at(0).map, 0.0);
  EXPECT_EQ(entries[1].samples.frames.at(0).cold.at(0).map, 0.0);
}

TEST_F(Timing, DetectorThatThrowsIsNotCalledAgainAndStopsNobodyElse) {
  Diary a('A', true, calls_), broken('X', true, calls_);
  std::vector<TimedEntry> entries = {entry(a, 2), entry(broken, 2)};
  run_timing(judged_, {1, 0}, 3, 1 << 12, entries, progress_);
  EXPECT_EQ(
      std::count_if(calls_.begin(), calls_.end(), [](const Call& c) { return c.detector == 'X'; }),
      1);
  EXPECT_THAT(entries[1].error, testing::HasSubstr("frame 1"));
  EXPECT_THAT(entries[1].error, testing::HasSubstr("out of order"));
  EXPECT_EQ(entries[0].error, "");
  EXPECT_EQ(entries[0].samples.frames.at(0).cold.size(), 3u);
}

TEST_F(Timing, AnswerThatWasJudgedMayRepeatItself) { EXPECT_EQ(error_of('-'), ""); }

TEST_F(Timing, AnswerThatWasNotJudgedEndsInAnError) {
  const std::string missing = "it answered 0 pairs of bodies and not the 1 that were judged";
  EXPECT_EQ(error_of('C'), "frame 1, while timed: " + missing) << "cold alone";
  EXPECT_EQ(error_of('H'), "frame 1, while timed: " + missing) << "hot alone";
  EXPECT_EQ(error_of('O'),
            "frame 1, while timed: it answered 1 pairs of bodies, and others than "
            "those that were judged");
  calls_.clear();
  EXPECT_EQ(error_of('L'), "frame 1, while timed: " + missing) << "later repeats";
  EXPECT_EQ(calls_.size(), 4u) << "and it is not called again";
}

}  // namespace
}  // namespace contactcheck
