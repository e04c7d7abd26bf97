// Distributes the tests of a frame's pairs of bodies over threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/lazy/kernels.h"
#include "core/types/contact_set.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Threads that share the work of a frame.
class ThreadTeam {
 public:
  /// The calling thread is one of them. @pre threads >= 1
  explicit ThreadTeam(std::size_t threads);
  ~ThreadTeam();

  std::size_t threads() const { return scratch_.size(); }
  /// One scratch per thread.
  std::span<LazyScratch> scratch() { return scratch_; }
  std::span<const LazyScratch> scratch() const { return scratch_; }

  /// Calls work(i, scratch of the executing thread) for all i < count, concurrently and in any
  /// order; with one thread in order.
  void for_each(std::size_t count, const std::function<void(std::size_t, LazyScratch&)>& work);

 private:
  struct Arena;
  std::vector<LazyScratch> scratch_;
  std::unique_ptr<Arena> arena_;  ///< null: the calling thread works alone
};

/// Tests pairs of bodies. The set found does not depend on the number of threads; only with
/// `first_only` may other triangles stand for a pair of bodies. Each task writes to its own list.
class PairTasks {
 public:
  PairTasks(const LazyKernels& kernels, ThreadTeam& team) : kernels_(kernels), team_(team) {}

  /// Appends all intersecting pairs of triangles, or one per pair of bodies if `first_only`.
  /// @pre the bodies of all pairs are placed, and find_cells(), or bound_all() if refitted, is done
  void run(std::span<LazyState> states, std::span<const BodyPair> pairs, bool first_only,
           std::vector<ElementPair>& out);

 private:
  struct Task {
    std::size_t pair;
    FrontPart part;
  };

  const LazyKernels& kernels_;
  ThreadTeam& team_;
  std::vector<BvttFront> fronts_;  // per pair
  std::vector<Task> tasks_;
  std::vector<std::vector<ElementPair>> found_;  // per task
};

}  // namespace contactcheck
