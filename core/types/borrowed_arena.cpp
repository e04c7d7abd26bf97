#include "core/types/borrowed_arena.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace contactcheck {
namespace {

struct Idle {
  std::mutex mutex;
  std::vector<std::unique_ptr<tbb::task_arena>> arenas;
};

// Never destroyed: when a program ends, oneTBB may be gone already.
Idle& idle() {
  static Idle& all = *new Idle;
  return all;
}

}  // namespace

BorrowedArena::BorrowedArena(int threads) {
  {
    const std::lock_guard lock(idle().mutex);
    auto& arenas = idle().arenas;
    const auto found = std::ranges::find_if(
        arenas, [&](const auto& arena) { return arena->max_concurrency() == threads; });
    if (found != arenas.end()) {
      arena_ = std::move(*found);
      arenas.erase(found);
      return;
    }
  }
  arena_ = std::make_unique<tbb::task_arena>(threads);
}

BorrowedArena::~BorrowedArena() {
  const std::lock_guard lock(idle().mutex);
  idle().arenas.push_back(std::move(arena_));
}

}  // namespace contactcheck
