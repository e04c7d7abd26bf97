#include "reference/timing/cpu_time.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "reference/process/process_tree.h"
#include "reference/text/counted.h"
#include "reference/text/printable.h"

namespace contactcheck::timing {
namespace {

constexpr double kNanosecondsPerMillisecond = 1e6;

double nanoseconds_of(clockid_t clock) {
  timespec time = {};
  if (clock_gettime(clock, &time) != 0) return 0.0;
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

double nanoseconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double, std::nano>(time).count();
}

double nanoseconds(const timeval& time) {
  return 1e9 * static_cast<double>(time.tv_sec) + 1e3 * static_cast<double>(time.tv_usec);
}

// CPU time of the children it has waited for, in nanoseconds: fields 16 and 17 of its status, in
// ticks, which follow a name in brackets.
double of_ended_children(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
  std::string skipped;
  for (int i = 3; i < 16; ++i) fields >> skipped;
  double user = 0.0, system = 0.0;
  fields >> user >> system;
  return fields ? (user + system) * 1e9 / static_cast<double>(sysconf(_SC_CLK_TCK)) : 0.0;
}

// Those that run and those that have ended.
double of_children() {
  rusage ended = {};
  getrusage(RUSAGE_CHILDREN, &ended);
  double sum = nanoseconds(ended.ru_utime) + nanoseconds(ended.ru_stime);
  if (!has_children()) return sum;
  for (const pid_t process : process::process_tree(getpid())) {
    clockid_t clock = 0;
    if (process == getpid() || clock_getcpuclockid(process, &clock) != 0) continue;
    sum += nanoseconds_of(clock) + of_ended_children(process);
  }
  return sum;
}

// Without another thread, and without a process where these count.
bool alone(bool children) {
  std::error_code gone;
  const auto threads = std::filesystem::directory_iterator("/proc/self/task", gone);
  return std::distance(begin(threads), end(threads)) <= 1 &&
         (!children || process::process_tree(getpid()).size() == 1);
}

// How often a thread of this process has given up its CPU by itself.
long waits() {
  rusage own = {};
  getrusage(RUSAGE_SELF, &own);
  return own.ru_nvcsw;
}

std::string milliseconds(double nanoseconds) {
  const double value = nanoseconds / kNanosecondsPerMillisecond;
  char text[32];
  std::snprintf(text, sizeof text, value < 1000.0 ? "%.3g ms" : "%.0f ms", value);
  return text;
}

}  // namespace

bool has_children() {
  siginfo_t state = {};
  return waitid(P_ALL, 0, &state, WEXITED | WNOHANG | WNOWAIT) == 0;
}

void CallClock::start() {
  waits_ = waits();
  cpu_ = nanoseconds_of(CLOCK_PROCESS_CPUTIME_ID);
  from_ = Clock::now();
}

double CallClock::stop() {
  const double wall = nanoseconds(Clock::now() - from_);
  const double cpu = nanoseconds_of(CLOCK_PROCESS_CPUTIME_ID) - cpu_;
  if (cpu >= wall || waits() != waits_ || has_children()) return wall;
  taken_ += wall - cpu;
  return cpu;
}

// Own clocks are read next to the call: looking for children takes time of its own.
CpuBook::Reading CpuBook::read(bool calls_next) const {
  Reading out;
  if (calls_next) out.at = Clock::now();
  if (children_ && calls_next) {
    out.children = of_children();
    if (has_children()) out.stray = process::descendant_outside_its_group();
  }
  out.thread_first = nanoseconds_of(CLOCK_THREAD_CPUTIME_ID);
  out.process = nanoseconds_of(CLOCK_PROCESS_CPUTIME_ID);
  out.thread_last = nanoseconds_of(CLOCK_THREAD_CPUTIME_ID);
  if (children_ && !calls_next) out.children = of_children();
  if (!calls_next) out.at = Clock::now();
  return out;
}

void CpuBook::before_call(const Reading& now) {
  if (calls_ > 0) {
    between_calls_ += now.process + now.children - last_.process - last_.children -
                      (now.thread_last - last_.thread_first);
    time_between_ += nanoseconds(now.at - last_.at);
  }
  if (stray_.empty()) stray_ = now.stray;
  last_ = now;
}

double CpuBook::after_call(const Reading& now) {
  // One that has ended between two looks may be counted later, in whole ticks.
  const double used = std::max(now.process + now.children - last_.process - last_.children, 0.0);
  in_calls_ += used;
  of_children_ += now.children - last_.children;
  time_of_calls_ += nanoseconds(now.at - last_.at);
  last_ = now;
  ++calls_;
  return used;
}

// Other threads or processes may not have been scheduled for a while on a loaded machine.
void CpuBook::settle(const std::function<void()>& still_here) {
  constexpr auto kWait = std::chrono::milliseconds(20);
  constexpr double kRest = 0.01 * kNanosecondsPerMillisecond;
  before_call();
  for (int i = 0; i < 100 && !alone(children_); ++i) {
    const double before = between_calls_;
    std::this_thread::sleep_for(kWait);
    still_here();
    before_call();
    if (between_calls_ - before < kRest) return;
  }
}

std::string CpuBook::complaint() const {
  if (!stray_.empty())
    return "its process \"" + text::printable_line(stray_) +
           "\" has left the process group of its command: it could work on while it is not called, "
           "when the group is stopped";
  // For clocks that tick at different rates; a command tidies up behind its answer, and the pipe's
  // two ends work beside each other.
  const bool command = of_children_ > 0.0;
  const double slack = 0.25 * time_of_calls_ + 0.2 * kNanosecondsPerMillisecond +
                       static_cast<double>(calls_) * (command ? 1e6 : 5e3);
  const std::size_t threads = threads_ + (command ? 1 : 0);
  if (in_calls_ > static_cast<double>(threads) * time_of_calls_ + slack)
    return "it has used " + milliseconds(in_calls_) + " of CPU time in " +
           milliseconds(time_of_calls_) + " of calls; it may use " +
           text::counted(threads_, "thread") + " (--threads)";
  // Threads that it may have may wait for the next call without sleeping.
  if (between_calls_ > slack + static_cast<double>(threads_ - 1) * time_between_)
    return "it has used " + milliseconds(between_calls_) +
           " of CPU time while it was not called, beside " + milliseconds(time_of_calls_) +
           " of calls: their time is not what it costs";
  return "";
}

}  // namespace contactcheck::timing
