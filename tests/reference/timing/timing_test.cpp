#include "reference/timing/timing.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "reference/process/process_tree.h"
#include "reference/timing/cpu_time.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck::timing {
namespace {

using testing::ElementsAre;

constexpr judge::Asked kBody = {Question::kBody, true, {}};

// Writes down the frames that it is updated with; in frame 1 it throws where its word is "throws",
// and answers otherwise where it is "less" or "other".
class Diary : public Detector {
 public:
  explicit Diary(bool vertices = true, std::string word = "")
      : needs_vertices_(vertices), word_(std::move(word)) {
    semantics_.questions = {Question::kBody};
  }
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return needs_vertices_; }
  void prepare(const std::vector<Body>&) override {}
  void update(const Frame& frame) override {
    frames.push_back(frame.index);
    if (word_ == "throws" && frame.index == 1) throw std::runtime_error("out of order");
  }
  void query(Question, ContactSet& out) override {
    EXPECT_TRUE(out.bodies.empty()) << "an answer begins empty";
    if (word_ == "less" && frames.back() == 1) return;
    out.bodies = {{1, 0}, {0, 1}};  // of a repeat nobody is told
    if (word_ == "other" && frames.back() == 1) out.bodies = {{0, 2}};
  }

  std::vector<std::size_t> frames;

 private:
  bool needs_vertices_;
  std::string word_;
  Semantics semantics_;
};

// Writes down what a supervisor sees while it is called.
class Watched : public Diary {
 public:
  Watched(const process::SharedProgress& page, bool vertices) : Diary(vertices), page_(page) {}
  void update(const Frame& frame) override {
    Diary::update(frame);
    look();
  }
  void query(Question question, ContactSet& out) override {
    Diary::query(question, out);
    look();
  }

  std::vector<process::Phase> phases;
  std::vector<std::uint64_t> ticks;

 private:
  void look() {
    phases.push_back(page_.phase);
    ticks.push_back(page_.ticks);
  }
  const process::SharedProgress& page_;
};

constexpr double kMilliseconds = 1e6;  // nanoseconds

// Uses the CPU for so many milliseconds in each call.
class Busy : public Diary {
 public:
  Busy(bool vertices, double update_ms, double query_ms)
      : Diary(vertices), update_ms_(update_ms), query_ms_(query_ms) {}
  void update(const Frame& frame) override {
    Diary::update(frame);
    use_cpu(update_ms_);
  }
  void query(Question question, ContactSet& out) override {
    Diary::query(question, out);
    use_cpu(query_ms_);
  }

 private:
  static double cpu_ns() {
    timespec time = {};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  }
  static void use_cpu(double milliseconds) {
    const double end = cpu_ns() + milliseconds * kMilliseconds;
    while (cpu_ns() < end) {
    }
  }
  double update_ms_, query_ms_;
};

// The least of all frames: what holds up one frame need not hold up another.
double least(const Pass& pass, double PhaseSample::*phase) {
  double out = std::numeric_limits<double>::infinity();
  for (const PhaseSample& sample : pass) out = std::min(out, sample.*phase);
  return out;
}

class Timing : public testing::Test {
 protected:
  Timing()
      : scene_(test::approach_scene(test::make_body("", test::unit_box_mesh(1), {1, 1, 1}).shape,
                                    test::make_body("", test::unit_box_mesh(1), {1, 1, 1}).shape,
                                    {{0.0, 1.3}, {1.0, 0.7}}, 0.1, 0.2, 3, 0.35, {Level::kBody})) {
    ContactSet judged;
    judged.bodies = {{0, 1}};
    prints_.assign(3, judge::fingerprint_of(judged, kBody));
  }

  Pass pass(Detector& detector, std::vector<std::size_t> frames = {0, 1, 2}) {
    return time_pass(scene_, {0, kBody, std::move(frames), &prints_}, detector, progress_);
  }

  // What is wrong with it.
  std::string error_of(const std::string& word) {
    Diary detector(true, word);
    try {
      pass(detector);
    } catch (const std::runtime_error& e) {
      EXPECT_THAT(detector.frames, ElementsAre(0, 1)) << "it is not called again";
      return e.what();
    }
    return "";
  }

  process::SharedProgress page_;
  process::ProgressWriter progress_{&page_};
  scene::Scene scene_;
  std::vector<judge::AnswerFingerprint> prints_;
};

TEST_F(Timing, AsksEveryFrameOnceInOrder) {
  Diary detector;
  const Pass samples = pass(detector);
  EXPECT_THAT(detector.frames, ElementsAre(0, 1, 2));
  EXPECT_EQ(samples.size(), 3u);
  EXPECT_GT(samples[1].cpu, 0.0);
}

// Writes down how many vertices it is given of each body, in frames and at both ends of steps.
class Receiver : public Diary {
 public:
  explicit Receiver(bool needs) : Diary(needs) {}
  void update(const Frame& frame) override { note(frame); }
  void update_step(const Step& step) override {
    note(step.start);
    note(step.end);
    follows.push_back(step.follows);
  }
  void query(Question, ContactSet&) override {}

  std::vector<std::size_t> vertices, nodes;
  std::vector<bool> follows;

 private:
  void note(const Frame& frame) {
    for (const BodyState& body : frame.bodies) {
      vertices.push_back(body.vertices.size());
      nodes.push_back(body.nodes.size());
    }
  }
};

// What nobody has mapped must not be there to be taken for vertices.
TEST_F(Timing, OneThatNeedsNoVerticesIsGivenNone) {
  for (const bool needs : {true, false})
    for (const Question question : {Question::kBody, Question::kImpacts}) {
      SCOPED_TRACE(name_of(question));
      const judge::Asked asked = {question, true, {}};
      const std::vector<judge::AnswerFingerprint> prints(3, judge::fingerprint_of({}, asked));
      Receiver detector(needs);
      time_pass(scene_, {0, asked, {0, 1}, &prints}, detector, progress_);
      const BodyShape& shape = *scene_.bodies[0].shape;
      const std::size_t given = question == Question::kBody ? 4 : 8;
      EXPECT_EQ(detector.vertices,
                std::vector<std::size_t>(given, needs ? shape.mesh.vertices.size() : 0));
      EXPECT_EQ(detector.nodes, std::vector<std::size_t>(given, shape.node_count()));
    }
}

TEST_F(Timing, StepFollowsWhereItBeginsWithTheEndOfTheLastOne) {
  const judge::Asked asked = {Question::kImpacts, true, {}};
  const std::vector<judge::AnswerFingerprint> prints(3, judge::fingerprint_of({}, asked));
  for (const bool needs : {true, false}) {
    Receiver detector(needs);
    for (int pass = 0; pass < 2; ++pass)
      time_pass(scene_, {0, asked, {0, 1, 1, 0, 1}, &prints}, detector, progress_);
    EXPECT_THAT(detector.follows,
                ElementsAre(false, true, false, false, true, false, true, false, false, true));
  }
}

TEST_F(Timing, OfColdFramesThoseAlone) {
  Diary detector;
  CacheSweep sweep(1 << 12);
  const Pass samples = time_pass(scene_, {0, kBody, {0, 2}, &prints_, &sweep}, detector, progress_);
  EXPECT_THAT(detector.frames, ElementsAre(0, 2));
  EXPECT_EQ(samples.size(), 2u);
  EXPECT_EQ(sweep.lines_read(), 2u * (1 << 12) / 64) << "all of it before each frame";
}

TEST_F(Timing, SupervisorSeesThePhaseOfEveryCallAndThatItIsANewOne) {
  for (const bool vertices : {true, false}) {
    Watched detector(page_, vertices);
    pass(detector, {0, 1});
    EXPECT_THAT(detector.phases, ElementsAre(process::Phase::kUpdate, process::Phase::kQuery,
                                             process::Phase::kUpdate, process::Phase::kQuery));
    for (std::size_t i = 1; i < detector.ticks.size(); ++i)
      EXPECT_GT(detector.ticks[i], detector.ticks[i - 1]) << "call " << i;
  }
}

// No call of the detector happens meanwhile, so that another thread looks; the detector may use
// it, then.
TEST_F(Timing, SupervisorSeesMapping) {
  const auto fine = test::make_body("", test::unit_box_mesh(40), {1, 1, 1}).shape;
  const scene::Scene scene =
      test::approach_scene(fine, fine, {{0.0, 1.3}, {1.0, 0.7}}, 0.1, 0.2, 3, 0.35, {Level::kBody});
  std::atomic<bool> seen = false, done = false;
  std::thread supervisor([&] {
    while (!done) {
      seen = seen || page_.phase == process::Phase::kMap;
      std::this_thread::yield();
    }
  });
  Diary detector;
  for (int i = 0; i < 10'000 && !seen; ++i) {
    // The other thread's work is taken for the detector's, which may have two.
    time_pass(scene, {0, kBody, {0}, &prints_, nullptr, 2}, detector, progress_);
  }
  done = true;
  supervisor.join();
  EXPECT_TRUE(seen);
}

TEST_F(Timing, MapsForThoseWhoNeedVerticesAlone) {
  Diary eager(true), lazy(false);
  EXPECT_GT(pass(eager).at(0).map, 0.0);
  EXPECT_EQ(pass(lazy).at(0).map, 0.0);
}

TEST_F(Timing, MappingIsWithinItsClock) {
  const auto fine = test::make_body("", test::unit_box_mesh(40), {1, 1, 1}).shape;
  scene_ =
      test::approach_scene(fine, fine, {{0.0, 1.3}, {1.0, 0.7}}, 0.1, 0.2, 3, 0.35, {Level::kBody});
  constexpr double kFasterThanAnyMachine = 0.2;  // nanoseconds a vertex
  Diary detector;
  EXPECT_GT(least(pass(detector), &PhaseSample::map),
            kFasterThanAnyMachine * 2.0 * static_cast<double>(fine->mesh.vertices.size()));
}

TEST_F(Timing, UpdateAndQueryHaveEachTheirOwnTime) {
  constexpr double kWork = 2.0, kAlmostAll = 0.99;  // of 2 ms: the clocks may run apart a little
  for (const bool vertices : {true, false}) {
    Busy updates(vertices, kWork, 0.0), answers(vertices, 0.0, kWork);
    const Pass updated = pass(updates), answered = pass(answers);
    EXPECT_GE(least(updated, &PhaseSample::update), kAlmostAll * kWork * kMilliseconds);
    EXPECT_LT(least(updated, &PhaseSample::query), 0.5 * kWork * kMilliseconds);
    EXPECT_GE(least(answered, &PhaseSample::query), kAlmostAll * kWork * kMilliseconds);
    EXPECT_LT(least(answered, &PhaseSample::update), 0.5 * kWork * kMilliseconds);
  }
}

TEST_F(Timing, AnswerThatWasJudgedMayRepeatItself) { EXPECT_EQ(error_of(""), ""); }

TEST_F(Timing, WhatItThrowsEndsThePass) { EXPECT_EQ(error_of("throws"), "out of order"); }

TEST_F(Timing, AnswerThatWasNotJudgedEndsThePass) {
  EXPECT_EQ(error_of("less"), "it answered 0 pairs of bodies and not the 1 that were judged");
  EXPECT_EQ(error_of("other"),
            "it answered 1 pairs of bodies, and others than those that were judged");
}

// ---- CPU time ----------------------------------------------------------------------------------

void work(double milliseconds) {
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double, std::milli>(milliseconds);
  while (std::chrono::steady_clock::now() < end) {
  }
}

TEST(CpuBook, OfCallsThatWorkIsTheirTime) {
  CpuBook book(1, false);
  double in_calls = 0.0;
  for (int i = 0; i < 3; ++i) {
    book.before_call();
    work(5.0);
    in_calls += book.after_call();
    work(5.0);  // the caller's own
  }
  book.settle([] {});
  EXPECT_EQ(book.complaint(), "");
  EXPECT_LT(in_calls, 16.0 * kMilliseconds);
}

// A process of one thread that works all the time, after so many milliseconds of it.
CpuBook::Reading one_thread_after(double milliseconds) {
  const double time = milliseconds * kMilliseconds;
  return {CpuBook::Clock::time_point(std::chrono::nanoseconds(std::llround(time))), time, time,
          time};
}

TEST(CpuBook, ComplainsOfMoreThreadsThanItMayUse) {
  for (const std::size_t threads : {1, 4}) {
    CpuBook book(threads, false);
    book.before_call(one_thread_after(0.0));
    CpuBook::Reading end = one_thread_after(5.0);
    end.process += 10.0 * kMilliseconds;
    book.after_call(end);
    if (threads == 1) {
      EXPECT_EQ(book.complaint(),
                "it has used 15 ms of CPU time in 5 ms of calls; it may use 1 thread (--threads)");
    } else {
      EXPECT_EQ(book.complaint(), "");
    }
  }
}

// What a machine does that stands still: its guest takes that for CPU time.
TEST(CpuBook, TakesNoHaltBetweenTwoClocksForWork) {
  for (const bool halts_ahead : {true, false}) {
    CpuBook book(1, false);
    double now = 0.0;
    const auto read = [&](bool ahead) {
      const double halt = ahead == halts_ahead ? 0.7 : 0.0;
      CpuBook::Reading out;
      if (ahead) out.at = one_thread_after(now).at;
      for (double* clock : {&out.thread_first, &out.process, &out.thread_last})
        *clock = one_thread_after(now += halt).process;
      if (!ahead) out.at = one_thread_after(now).at;
      return out;
    };
    for (int i = 0; i < 10; ++i) {
      book.before_call(read(true));
      book.after_call(read(false));
    }
    EXPECT_EQ(book.complaint(), "");
  }
}

TEST(CpuBook, ComplainsOfWorkBetweenCallsAndAfterTheLast) {
  CpuBook book(1, false);
  book.before_call();
  book.after_call();
  // Of its own time: a busy machine may give it little of the clock's.
  std::thread other([] {
    timespec used = {};
    while (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used) == 0 && used.tv_nsec < 20'000'000) {
    }
  });
  book.settle([] {});
  other.join();
  EXPECT_THAT(book.complaint(), testing::HasSubstr("while it was not called"));
}

// A child that leads a group, as a command does, and has a child of its own that stays in it or
// not.
TEST(CpuBook, ComplainsOfAProcessThatNoPauseReaches) {
  enum { kStays, kLeaves, kLeftAndEnded };
  for (const int what : {kStays, kLeaves, kLeftAndEnded}) {
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
      setpgid(0, 0);
      if (fork() == 0) {
        if (what != kStays) setsid();
        if (what == kLeftAndEnded) _exit(0);  // nobody waits for it
        write(ready[1], "x", 1);
        sleep(300);
        _exit(0);
      }
      siginfo_t ended;
      if (what == kLeftAndEnded && waitid(P_ALL, 0, &ended, WEXITED | WNOWAIT) == 0)
        write(ready[1], "x", 1);
      sleep(300);
      _exit(0);
    }
    char byte = 0;
    ASSERT_EQ(read(ready[0], &byte, 1), 1);
    CpuBook book(1, true);
    book.before_call();
    book.after_call();
    process::kill_tree(child);
    waitpid(child, nullptr, 0);
    for (const int end : ready) close(end);
    if (what == kLeaves) {
      EXPECT_THAT(book.complaint(),
                  testing::HasSubstr("has left the process group of its command"));
    } else {
      EXPECT_EQ(book.complaint(), "");
    }
  }
}

TEST(CpuBook, CountsProcessesThatWereStarted) {
  CpuBook book(1, true);
  book.before_call();
  book.after_call();
  const pid_t child = fork();
  if (child == 0) {
    work(40.0);
    _exit(0);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  book.settle([] {});
  waitpid(child, nullptr, 0);
  EXPECT_THAT(book.complaint(), testing::HasSubstr("while it was not called"));
}

}  // namespace
}  // namespace contactcheck::timing
