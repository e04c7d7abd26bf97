// Reuses arenas of oneTBB.
#pragma once

#include <oneapi/tbb/task_arena.h>

#include <memory>

namespace contactcheck {

/// An arena for `threads` threads, used by this object alone and pooled after it: oneTBB 2021.8
/// leaks up to 7 kB per destroyed arena (its issue 967), and a simulation needs one per step.
class BorrowedArena {
 public:
  explicit BorrowedArena(int threads);
  ~BorrowedArena();

  tbb::task_arena* operator->() { return arena_.get(); }

 private:
  std::unique_ptr<tbb::task_arena> arena_;
};

}  // namespace contactcheck
