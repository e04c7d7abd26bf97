// The tests of a frame's pairs of bodies, shared out to threads.
#pragma once

#include <span>
#include <vector>

#include "core/lazy/kernels.h"
#include "core/lazy/thread_team.h"

namespace contactcheck {

/// What the tests find does not depend on the number of threads: tasks are cut by the number of
/// pairs and by their fronts alone, and each puts down what it finds in a place of its own.
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

  void run_whole(std::span<LazyState> states, bool first_only);
  void run_parts(std::span<LazyState> states, bool first_only);
  void cut(std::size_t pair);
  void collect(bool first_only, std::vector<ElementPair>& out) const;

  const LazyKernels& kernels_;
  ThreadTeam& team_;
  std::span<const BodyPair> pairs_;
  std::vector<BvttFront> fronts_;  // per pair
  std::vector<Task> tasks_;
  std::vector<std::vector<ElementPair>> found_;  // per task
};

}  // namespace contactcheck
