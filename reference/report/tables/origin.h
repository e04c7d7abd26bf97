// Where results come from: command, machine, parts of a run.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::report {

/// Command, machine, compiler, libraries, version and how it was timed, a line each; `code` stands
/// in backticks.
std::vector<std::string> machine_lines(const results::Results& results);

/// How the times were measured; empty where nothing was timed.
std::string timing_line(const results::Results& results);

/// What times of this run are worth: its passes set beside one another in pairs, each detector in
/// each question beside itself, so that every ratio should be 1. Empty where no detector has
/// passes for kFewestForInterval pairs.
std::string steadiness_line(const results::Results& results);

/// What keeps a reader from taking a part for the whole: of which shard, or of how many, and which
/// scenes were taken over from an interrupted run. None for a whole run.
std::vector<std::string> part_sentences(const results::Results& results);

}  // namespace contactcheck::report
