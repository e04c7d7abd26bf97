#include "core/lazy/thread_team.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <optional>

#include "core/types/check.h"

namespace contactcheck {

struct ThreadTeam::Arena {
  explicit Arena(int threads) : tasks(threads) {
    // oneTBB starts no more threads than there are cores unless it is told to.
    if (threads > tbb::info::default_concurrency())
      more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  std::optional<tbb::global_control> more;
  tbb::task_arena tasks;
};

ThreadTeam::ThreadTeam(std::size_t threads) : scratch_(threads) {
  CONTACTCHECK_INVARIANT(threads >= 1, "somebody has to do it");
  if (threads > 1) arena_ = std::make_unique<Arena>(static_cast<int>(threads));
}

ThreadTeam::~ThreadTeam() = default;

void ThreadTeam::for_each(std::size_t count,
                          const std::function<void(std::size_t, LazyScratch&)>& work) {
  if (!arena_ || count < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i, scratch_[0]);
    return;
  }
  const auto on_this_thread = [&](std::size_t i) {
    work(i, scratch_[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())]);
  };
  // One piece of work at a time: they differ too much for ranges.
  arena_->tasks.execute(
      [&] { tbb::parallel_for(std::size_t{0}, count, on_this_thread, tbb::simple_partitioner()); });
}

}  // namespace contactcheck
