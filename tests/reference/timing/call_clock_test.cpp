// What CallClock takes off the time of a call: what the machine has given to others, of a process
// that neither waits nor has children. All of it holds however busy the machine is.
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "reference/timing/cpu_time.h"

namespace contactcheck::timing {
namespace {

constexpr double kNsPerMs = 1e6;
constexpr double kRounding = 1.0;  // nanosecond

double reading_of(clockid_t clock) {
  timespec time = {};
  clock_gettime(clock, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

struct Spun {
  double wall = 0.0, cpu = 0.0;  ///< nanoseconds
  double away() const { return wall - cpu; }
};

// Works until what it has taken is enough.
Spun spin_until(const std::function<bool(const Spun&)>& enough) {
  const double wall = reading_of(CLOCK_MONOTONIC), cpu = reading_of(CLOCK_PROCESS_CPUTIME_ID);
  while (true) {
    const Spun spun = {reading_of(CLOCK_MONOTONIC) - wall,
                       reading_of(CLOCK_PROCESS_CPUTIME_ID) - cpu};
    if (enough(spun)) return spun;
  }
}

TEST(CallClock, OfACallThatSpinsIsItsTimeWithoutWhatWasTaken) {
  CallClock clock;
  const double before = reading_of(CLOCK_MONOTONIC);
  clock.start();
  const Spun spun = spin_until([](const Spun& s) { return s.cpu >= 2.0 * kNsPerMs; });
  const double time = clock.stop();
  const double outside = reading_of(CLOCK_MONOTONIC) - before;
  EXPECT_GE(time, 0.99 * spun.cpu) << "the two clocks may run apart a little";
  EXPECT_GE(time + clock.taken(), spun.wall - kRounding);
  EXPECT_LE(time + clock.taken(), outside + kRounding);
}

TEST(CallClock, OfACallThatSleepsIsAllOfItsTime) {
  CallClock clock;
  clock.start();
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_GE(clock.stop(), 5.0 * kNsPerMs);
  EXPECT_EQ(clock.taken(), 0.0);
}

// ---- beside another process on the same CPU -----------------------------------------------------

// This process and those that it starts, for the life of this object.
class OneCpu {
 public:
  OneCpu() {
    cpu_set_t one;
    CPU_ZERO(&one);
    if (sched_getaffinity(0, sizeof before_, &before_) != 0) return;
    std::size_t cpu = 0;
    while (!CPU_ISSET(cpu, &before_)) ++cpu;
    CPU_SET(cpu, &one);
    pinned_ = sched_setaffinity(0, sizeof one, &one) == 0;
  }
  ~OneCpu() {
    if (pinned_) sched_setaffinity(0, sizeof before_, &before_);
  }
  OneCpu(const OneCpu&) = delete;
  OneCpu& operator=(const OneCpu&) = delete;

  bool pinned() const { return pinned_; }

 private:
  cpu_set_t before_;
  bool pinned_ = false;
};

// A process that is gone with this object.
class Child {
 public:
  explicit Child(const std::function<void()>& action) : pid_(fork()) {
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    action();
    _exit(0);
  }
  ~Child() {
    if (pid_ < 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

 private:
  pid_t pid_;
};

void never_rest() {
  for (volatile unsigned turns = 0;;) {
    turns = turns + 1;
  }
}

struct HeldUpCall {
  Spun spun;
  double time = 0.0, taken = 0.0, outside = 0.0;  ///< outside: by the wall clock, around the call
  bool children = false;
};

// Spins until another has had the CPU for a millisecond; in vain, for 5 s.
HeldUpCall held_up_call() {
  HeldUpCall call;
  call.children = has_children();
  CallClock clock;
  const double before = reading_of(CLOCK_MONOTONIC);
  clock.start();
  call.spun =
      spin_until([](const Spun& s) { return s.away() >= kNsPerMs || s.wall >= 5000.0 * kNsPerMs; });
  call.time = clock.stop();
  call.outside = reading_of(CLOCK_MONOTONIC) - before;
  call.taken = clock.taken();
  return call;
}

// What `action` gives in a new process, which has no children and no other threads.
HeldUpCall in_a_new_process(const std::function<HeldUpCall()>& action) {
  HeldUpCall call;
  int ends[2];
  if (pipe(ends) != 0) return call;
  const Child child([&] {
    const HeldUpCall own = action();
    if (write(ends[1], &own, sizeof own) < 0) _exit(1);
  });
  close(ends[1]);
  EXPECT_EQ(read(ends[0], &call, sizeof call), static_cast<ssize_t>(sizeof call));
  close(ends[0]);
  return call;
}

TEST(CallClock, TakesOffWhatASiblingHadOfTheSameCpu) {
  const OneCpu one;
  ASSERT_TRUE(one.pinned());
  const Child competitor(never_rest);
  const HeldUpCall call = in_a_new_process([] {
    HeldUpCall own = held_up_call();
    // A page that had to be fetched is a wait, of which nothing is taken off.
    for (int i = 0; i < 10 && own.taken == 0.0; ++i) own = held_up_call();
    return own;
  });
  ASSERT_GE(call.spun.away(), kNsPerMs) << "it was not held up";
  EXPECT_FALSE(call.children);
  EXPECT_GE(call.taken, 0.9 * kNsPerMs);
  EXPECT_LE(call.time, call.outside - 0.9 * kNsPerMs);
  EXPECT_GE(call.time, 0.99 * call.spun.cpu);
  EXPECT_GE(call.time + call.taken, call.spun.wall - kRounding);
}

// It might have waited for its child.
TEST(CallClock, TakesNothingOffWhatItsOwnChildHadOfTheCpu) {
  const OneCpu one;
  ASSERT_TRUE(one.pinned());
  const HeldUpCall call = in_a_new_process([] {
    const Child competitor(never_rest);
    return held_up_call();
  });
  ASSERT_GE(call.spun.away(), kNsPerMs) << "it was not held up";
  EXPECT_TRUE(call.children);
  EXPECT_EQ(call.taken, 0.0);
  EXPECT_GE(call.time, call.spun.wall - kRounding);
}

}  // namespace
}  // namespace contactcheck::timing
