#include "core/lazy/pair_tasks.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>

#include "core/types/check.h"

namespace contactcheck {
namespace {

// The axis along which the boxes lie farthest apart, measured in box widths: the fewest overlap.
int sweep_axis(std::span<const Aabb> boxes) {
  Aabb centers;
  Vec3 widths = Vec3::Zero();
  for (const Aabb& box : boxes) {
    centers.extend(box.center());
    widths += box.extent();
  }
  int best = 0;
  for (int k = 1; k < 3; ++k)
    if (centers.extent()[k] * widths[best] > centers.extent()[best] * widths[k]) best = k;
  return best;
}

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

void find_candidate_bodies(std::span<const Aabb> boxes, std::vector<BodyPair>& out) {
  out.clear();
  if (boxes.size() < 2) return;
  const int axis = sweep_axis(boxes);
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return boxes[a].lo[axis] < boxes[b].lo[axis];
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Aabb &first = boxes[order[i]], &second = boxes[order[j]];
      if (second.lo[axis] > first.hi[axis]) break;
      if (first.overlaps(second))
        out.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
    }
  std::sort(out.begin(), out.end());
}

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
  std::vector<std::atomic<bool>> known(pairs.size());  // that the bodies of a pair meet
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
