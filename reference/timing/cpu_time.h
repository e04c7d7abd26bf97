// Wall time of a detector's calls, and their CPU time including the detector's threads and
// processes.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace contactcheck::timing {

/// True if this process has children that it has not waited for.
bool has_children();

/// Measures a call by the wall clock, minus the time that the machine gave to others: on a shared
/// machine a call of a millisecond may be delayed by seven. A process that waited for nothing (no
/// thread gave up its CPU voluntarily) and started no other would have run all the time, so the
/// difference between wall clock and CPU time went to others. For calls that wait, for a thread or
/// a pipe, nothing is subtracted.
class CallClock {
 public:
  void start();
  /// Nanoseconds since start().
  double stop();
  /// Nanoseconds subtracted so far, over all calls.
  double taken() const { return taken_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point from_;
  double cpu_ = 0.0, taken_ = 0.0;
  long waits_ = 0;
};

/// Accounts one pass: the CPU time of the process in calls of the detector, and the CPU time that
/// others than the calling thread use between calls. Nanoseconds. A command is paused between calls
/// (Detector::pause), what it computes in the background lies within them; so a process that has
/// left its group, which no pause reaches, is a complaint, too.
///
/// Reading the clocks takes time too, and a shared machine may stop between two of them. So the
/// calls' CPU time is compared with the time between the readings, which is never less for one
/// thread, and the calling thread's clock is read before and after that of the process.
class CpuBook {
 public:
  using Clock = std::chrono::steady_clock;
  struct Reading {
    Clock::time_point at;  ///< Before all others ahead of a call, after all others behind it.
    double thread_first = 0.0, process = 0.0, thread_last = 0.0, children = 0.0;
    std::string stray = {};  ///< a process that no pause reaches
  };

  /// `threads`: that the detector may use. `children`: count the processes that this one has
  /// started too, at some 300 us a call where there are any.
  CpuBook(std::size_t threads, bool children) : threads_(threads), children_(children) {}

  void before_call() { before_call(read(true)); }
  /// Gives the call's CPU time.
  double after_call() { return after_call(read(false)); }
  /// After the last call: waits until no thread or process works on, at most 2 s, and calls
  /// `still_here` meanwhile.
  void settle(const std::function<void()>& still_here);

  /// The same with given readings.
  void before_call(const Reading& now);
  double after_call(const Reading& now);

  /// "" where all is well. A sentence where the detector has used more CPU time in its calls than
  /// its threads can in that time, has worked on between them, or has a process that could: then
  /// the time of its calls is not what it costs.
  std::string complaint() const;

 private:
  Reading read(bool calls_next) const;

  std::size_t threads_, calls_ = 0;
  bool children_;
  Reading last_;
  std::string stray_;
  double in_calls_ = 0.0, of_children_ = 0.0, time_of_calls_ = 0.0;
  double between_calls_ = 0.0, time_between_ = 0.0;
};

}  // namespace contactcheck::timing
