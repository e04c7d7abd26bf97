// Puts a detector through a case and holds what it says against the oracle.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/detect/detector.h"
#include "reference/oracle/step_truth.h"
#include "tests/conformance/cases.h"
#include "tests/conformance/known_deviations.h"

namespace contactcheck::test {

/// Makes a new detector that is not prepared yet.
using Maker = std::function<std::unique_ptr<Detector>()>;

struct Observation {
  Findings findings;
  std::string details;  ///< for a reader: counts per level, messages
};

/// Names of findings: "LEVEL missed" and "LEVEL spurious" of every level claimed that can be judged
/// in this case, "invalid id", "unusable contact", "contradiction", "unnamed visits", "refused",
/// "exception".
///
/// A detector in single precision is held against the truth for the values that it was fed.
Observation observe(const Maker& make, const Case& scene);

/// The same for a case about steps. Names of findings, beside those: "unusable time" (not within
/// the step), "time early" and "time late" (of a true pair of bodies, by more than the width that
/// times are certified to), "list of another question", "floating-point environment".
/// @pre the detector claims double precision, as all do that answer about steps
Observation observe_steps(const Maker& make, const Case& scene);

/// By step: between bodies and within them.
std::vector<oracle::StepTruth> step_truth_of(const Case& scene);

/// `what` as it is, but for what it throws: "refused" or "exception".
Observation guarded(const std::function<Observation()>& what);

}  // namespace contactcheck::test
