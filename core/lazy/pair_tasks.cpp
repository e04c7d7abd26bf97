#include "core/lazy/pair_tasks.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <optional>

#include "core/types/borrowed_arena.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

// From this many pairs on there is work for every thread without cutting any.
constexpr std::size_t kManyPairs = 256;
// Slots that a cut pair is spread to, and how many go to a task: a slot takes some microseconds.
constexpr std::size_t kSlots = 64, kSlotsPerTask = 8, kLeavesPerTask = 64;

template <class T>
std::span<const T> part_of(const std::vector<T>& all, std::size_t begin, std::size_t count) {
  begin = std::min(begin, all.size());
  return {all.data() + begin, std::min(count, all.size() - begin)};
}

}  // namespace

struct ThreadTeam::Arena {
  explicit Arena(int threads) : tasks(threads) {
    // By default oneTBB starts no more threads than there are cores.
    if (threads > tbb::info::default_concurrency())
      more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  std::optional<tbb::global_control> more;
  BorrowedArena tasks;
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
  arena_->tasks->execute(
      [&] { tbb::parallel_for(std::size_t{0}, count, on_this_thread, tbb::simple_partitioner()); });
}

void PairTasks::run(std::span<LazyState> states, std::span<const BodyPair> pairs, bool first_only,
                    std::vector<ElementPair>& out) {
  const auto bodies = [&](std::size_t p) {
    return BodiesToTest{pairs[p], states[pairs[p].a], states[pairs[p].b]};
  };
  if (team_.threads() == 1) {
    for (std::size_t p = 0; p < pairs.size(); ++p)
      kernels_.collide(bodies(p), first_only, team_.scratch()[0], out);
    return;
  }
  // A task is a whole pair of bodies, or a part of the front of one.
  const bool whole = pairs.size() >= kManyPairs;
  tasks_.clear();
  if (whole) {
    for (std::size_t p = 0; p < pairs.size(); ++p) tasks_.push_back({p, {}});
  } else {
    if (fronts_.size() < pairs.size()) fronts_.resize(pairs.size());
    team_.for_each(pairs.size(), [&](std::size_t p, LazyScratch& scratch) {
      kernels_.spread(bodies(p), kSlots, scratch, fronts_[p]);
    });
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const BvttFront& front = fronts_[p];
      for (std::size_t i = 0; i < front.slots.size(); i += kSlotsPerTask)
        tasks_.push_back({p, {part_of(front.slots, i, kSlotsPerTask), {}}});
      for (std::size_t i = 0; i < front.leaves.size(); i += kLeavesPerTask)
        tasks_.push_back({p, {{}, part_of(front.leaves, i, kLeavesPerTask)}});
    }
  }
  if (found_.size() < tasks_.size()) found_.resize(tasks_.size());
  std::vector<std::atomic<bool>> known(pairs.size());  // true: these bodies meet
  team_.for_each(tasks_.size(), [&](std::size_t t, LazyScratch& scratch) {
    const Task& task = tasks_[t];
    found_[t].clear();
    if (first_only && known[task.pair].load(std::memory_order_relaxed)) return;
    if (whole) {
      kernels_.collide(bodies(task.pair), first_only, scratch, found_[t]);
    } else {
      kernels_.collide_part(bodies(task.pair), task.part, first_only, scratch, found_[t]);
    }
    if (!found_[t].empty()) known[task.pair].store(true, std::memory_order_relaxed);
  });
  // In the order of the tasks, whatever threads did them.
  std::size_t last = pairs.size();
  for (std::size_t t = 0; t < tasks_.size(); ++t) {
    if (found_[t].empty() || (first_only && tasks_[t].pair == last)) continue;
    last = tasks_[t].pair;
    out.insert(out.end(), found_[t].begin(), found_[t].end());
  }
}

}  // namespace contactcheck
