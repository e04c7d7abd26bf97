// Arenas of oneTBB, used again.
#pragma once

#include <oneapi/tbb/task_arena.h>

#include <memory>

namespace contactcheck {

/// An arena for that many threads, nobody else's for as long as this lives. oneTBB 2021.8 keeps up
/// to 7 kB of each arena that is destroyed (its issue 967), and a simulation needs one per step.
class BorrowedArena {
 public:
  explicit BorrowedArena(int threads);
  ~BorrowedArena();

  tbb::task_arena* operator->() { return arena_.get(); }

 private:
  std::unique_ptr<tbb::task_arena> arena_;
};

}  // namespace contactcheck
