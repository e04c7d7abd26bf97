// The ground truth of a step: what meets while all vertices move straight from a frame to the next.
//
// Shares core's types and rest-shape data, and nothing of its broad or narrow phase: vertices and
// edges of one body look for triangles of another in the oracle's own tree, fitted to both ends of
// the step; elementary_impact.h decides. Two triangles are in contact within a step if they touch
// at its start or one of their vertices and the other, or two of their edges, meet: a pair that is
// disjoint at the start first meets so (core/detect/step_contacts.h has the proof).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"

namespace contactcheck::oracle {

/// Two bodies whose surfaces meet within a step.
struct FirstImpact {
  BodyPair bodies;
  bool starts_in_contact = false;   ///< their surfaces share a point at t = 0: both times are 0
  double earliest = 0, latest = 0;  ///< the first time is in here; width at most kImpactTimeWidth
};

struct StepTruth {
  /// The lists of steps, canonical: `impacts` without times, which `first` has, in its order.
  ContactSet contacts;
  std::vector<FirstImpact> first;
};

/// The kinds of truth to compute.
struct WantedSteps {
  bool between = true;  ///< contact of two bodies
  bool own = false;     ///< contact of bodies with themselves
};

class StepOracle {
 public:
  explicit StepOracle(const std::vector<Body>& bodies);
  ~StepOracle();
  StepOracle(const StepOracle&) = delete;
  StepOracle& operator=(const StepOracle&) = delete;

  /// `at_start`: the pairs of triangles of two bodies that share a point at the start, canonical
  /// (Truth::surface). Exact.
  /// @pre vertices for every body at both ends, all finite
  /// @throws RefusedInput for more than kMostContacts (oracle.h) contacts of a kind
  StepTruth judge(const Step& step, const std::vector<ElementPair>& at_start, WantedSteps wanted);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactcheck::oracle
