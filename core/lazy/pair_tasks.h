// The tests of the pairs of bodies of a frame, shared out to threads.
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
  /// One per thread.
  std::span<LazyScratch> scratch() { return scratch_; }
  std::span<const LazyScratch> scratch() const { return scratch_; }

  /// work(i, scratch of the thread that does it) for all i < count, in any order, at once on all
  /// threads; in order where there is one thread.
  void for_each(std::size_t count, const std::function<void(std::size_t, LazyScratch&)>& work);

 private:
  struct Arena;
  std::vector<LazyScratch> scratch_;
  std::unique_ptr<Arena> arena_;  ///< none where the calling thread works alone
};

/// Tests the pairs. What it finds does not depend on the number of threads: tasks are cut by the
/// number of pairs and by their fronts alone, and each writes what it finds to its own list.
class PairTasks {
 public:
  PairTasks(const LazyKernels& kernels, ThreadTeam& team) : kernels_(kernels), team_(team) {}

  /// Appends all intersecting pairs of triangles, or one per pair of bodies if `first_only`.
  /// @pre the bodies of all pairs are placed and refitted, or their nodes known
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
