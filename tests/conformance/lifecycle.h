// Order of calls, repetition, threads, order of bodies: none of it may change an answer.
#pragma once

#include <string>
#include <vector>

#include "tests/conformance/observation.h"

namespace contactcheck::test {

/// Of frames or of steps alike; names of checks of steps begin with "step".
///
/// A check stands where answers have their case, also in the list of known deviations. It finds
/// "answer differs", by its number of answers, or what `guarded` finds.
struct LifecycleCheck {
  std::string name;
  Observation (*run)(const Maker& make, Moment of);
};

const std::vector<LifecycleCheck>& lifecycle_checks(Moment of);

}  // namespace contactcheck::test
