// Where to look first in a failed check, and the command that shows it.
#pragma once

#include <string>

#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"
#include "reference/results/results.h"

namespace contactcheck::gate {

/// "frame 7": the frame with most of what the rule counts, if the counts per frame are at the
/// rule's level; else the first disagreement at that level; for a row with status `error` the frame
/// of the error. "frame 7 (0.5)" adds the parameter's value in a family of cases. Empty if the
/// results do not contain it.
std::string worst_frame(const Rule& rule, const results::Index& index, const results::Run& row);

/// A shell command that runs this row again: the scene (a file as in the results' command), the
/// detector with its options, the number of frames; for a timing rule also the reference and as
/// many processes, or enough for an interval if the rule could not be judged. Empty if a detector
/// is transient.
std::string rerun_command(const Rule& rule, const results::Index& index, const results::Run& row,
                          Verdict verdict);

/// The same for the random pairs of a scene.
std::string pairs_command(const results::Scene& scene);

}  // namespace contactcheck::gate
