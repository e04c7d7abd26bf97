// How near reported contact within a step comes to contact, where there is none: a detector's
// tolerance excuses what comes within it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "core/types/impact.h"
#include "core/types/semantics.h"
#include "reference/oracle/impact_distance.h"

namespace contactcheck::oracle {

struct StepNearness {
  NearVerdict verdict = NearVerdict::kSpurious;
  /// The smallest distance of near elements within the step, in metres and as a share of their
  /// distance at its start; both rounded upwards. For two triangles it is that of the nearest
  /// elements, for two bodies that of the first near triangles found. 0 unless near.
  double distance = 0, of_start = 0;
};

class StepDistances {
 public:
  explicit StepDistances(const std::vector<Body>& bodies);
  ~StepDistances();
  StepDistances(const StepDistances&) = delete;
  StepDistances& operator=(const StepDistances&) = delete;

  /// Pairs of triangles of two bodies that are looked at before the answer is kUndecided.
  static constexpr std::uint64_t kMostPairs = 500;

  /// @pre vertices for every body at both ends, all finite, which outlive the calls that follow
  void set_step(const Step& step);

  /// Whether a pair that `level` reports and that does not meet within the step comes within the
  /// tolerance: a vertex and a triangle, or two edges, as near_miss() has it; two triangles if some
  /// of their fifteen pairs of such elements do; two bodies if some of their triangles do. Elements
  /// of one body with a common vertex, or welded ones, are spurious.
  /// @pre a level of contact within steps; `pair` as in compare_step_at(), without contact
  StepNearness nearness(Level level, const ElementPair& pair, const ImpactTolerance& tolerance);

  /// Whether two bodies that are apart at the start are within `distance` metres there.
  NearVerdict near_at_start(const BodyPair& bodies, double distance);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactcheck::oracle
