// Threads that share the work of a frame.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "core/lazy/kernels.h"

namespace contactcheck {

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

}  // namespace contactcheck
