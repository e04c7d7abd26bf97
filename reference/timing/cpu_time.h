// Wall time of a detector's calls, and their CPU time including the detector's threads and
// processes.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace contactcheck::timing {

/// Whether this process has any that it has started and not waited for.
bool has_children();

/// Times a call by the wall clock, without what the machine has taken away: on one that others use
/// too, a call of a millisecond may be held up for seven. A process that has not waited for
/// anything (no thread of it has given up its CPU by itself) and has started no other would have
/// run all the time; what its CPU time is short of the wall clock has been given to others. Of
/// calls that wait, for a thread or a pipe, nothing is taken off.
class CallClock {
 public:
  void start();
  /// Nanoseconds since start().
  double stop();
  /// Nanoseconds that have been taken off, of all calls.
  double taken() const { return taken_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point from_;
  double cpu_ = 0.0, taken_ = 0.0;
  long waits_ = 0;
};

/// Adds up one pass: the CPU time of the process in calls of the detector, and what others than
/// the calling thread use while it is not called. Nanoseconds.
///
/// Reading the clocks takes time too, and a machine that others use may stand still between two of
/// them. So the calls' CPU time is held against the time between the readings, which is never less
/// for one thread, and the calling thread's own clock is read on both sides of the process's.
class CpuBook {
 public:
  using Clock = std::chrono::steady_clock;
  struct Reading {
    Clock::time_point at;  ///< Before all others ahead of a call, after all others behind it.
    double thread_first = 0.0, process = 0.0, thread_last = 0.0, children = 0.0;
  };

  /// `threads`: that the detector may use. `children`: count the processes that this one has
  /// started too, at some 100 us a call where there are any.
  CpuBook(std::size_t threads, bool children) : threads_(threads), children_(children) {}

  void before_call() { before_call(read(true)); }
  /// Gives the call's CPU time.
  double after_call() { return after_call(read(false)); }
  /// After the last call: waits until no thread or process works on, at most 2 s, and calls
  /// `still_here` meanwhile.
  void settle(const std::function<void()>& still_here);

  /// The same of readings that are given.
  void before_call(const Reading& now);
  double after_call(const Reading& now);

  /// "" where all is well. A sentence where the detector has used more CPU time in its calls than
  /// its threads can in that time, or has worked on between them: then the time of its calls is not
  /// what it costs.
  std::string complaint() const;

 private:
  Reading read(bool calls_next) const;

  std::size_t threads_, calls_ = 0;
  bool children_;
  Reading last_;
  double in_calls_ = 0.0, of_children_ = 0.0, time_of_calls_ = 0.0;
  double between_calls_ = 0.0, time_between_ = 0.0;
};

}  // namespace contactcheck::timing
