// Contact within steps by the tree of ffd-lazy: bounds of lattice pieces over both ends, in frames
// that move with the bodies (core/lazy/lazy_state.h); vertices are mapped where boxes of triangles
// over the step overlap, and tested exactly (step_contacts.h).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/detect/step_contacts.h"
#include "core/lazy/pair_tasks.h"
#include "core/types/semantics.h"

namespace contactcheck {

/// In doubles. Contacts do not depend on the instruction set or the number of threads.
class LazySteps {
 public:
  /// A tree per body; `refitted`: per body, its bounds come from all vertices. `kernels` and `team`
  /// must outlive this.
  LazySteps(const std::vector<Body>& bodies,
            const std::vector<std::shared_ptr<const LatticeTree>>& trees,
            const std::vector<bool>& refitted, const LazyKernels& kernels, ThreadTeam& team);

  /// Where a body is refitted its vertices are the step's if it has any; else they are mapped here,
  /// once it may meet another. Of a step that follows the last one, the start is what the end was.
  void update(const Step& step);
  /// @pre the question is one of steps
  void query(Question question, ContactSet& out);

  LazyCounters counters() const;
  std::uint64_t tested() const { return contacts_.tested(); }
  std::size_t bytes() const;

 private:
  struct Places {
    std::vector<Vec3> start, end;                   // vertices that are mapped here
    bool start_mapped = false, end_mapped = false;  // all of them
    std::vector<std::uint32_t> mapped_in;           // per vertex: the step in which it was mapped
    std::span<const Vec3> at_start, at_end;
  };

  void begin(std::size_t body, const Step& step);
  void map_vertices_of(std::size_t body);
  void erase_pairs_apart();
  std::vector<std::uint32_t> bodies_for(Question question) const;
  void bound(std::size_t body, LazyScratch& scratch);
  void find_candidates(Question question);
  void map_triangle(std::uint32_t body, std::uint32_t triangle);

  const LazyKernels& kernels_;
  ThreadTeam& team_;
  PairTasks tasks_;
  std::vector<LazyState> starts_, ends_;  // per body
  std::vector<Places> places_;            // per body
  std::vector<char> bounded_;             // per body, in this step
  std::vector<BodyPair> pairs_;           // that may meet
  std::vector<ElementPair> candidates_;
  StepContacts contacts_;
  std::uint32_t step_ = 0;
};

}  // namespace contactcheck
