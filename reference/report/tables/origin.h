// The origin of results: command, machine, parts of a run.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::report {

/// results::Machine::isa as readers know it: "AVX-512" for "AVX3", which is Highway's name and that
/// of the option `isa`.
std::string instruction_set(const std::string& isa);

/// Command, machine, compiler, libraries, version and timing settings, one line each; `code` is in
/// backticks.
std::vector<std::string> machine_lines(const results::Results& results);

/// How the times were measured; empty if nothing was timed.
std::string timing_line(const results::Results& results);

/// The repeatability of this run's times: passes of each detector in each question are compared in
/// pairs, so that every ratio should be 1. Empty if no detector has passes for kFewestForInterval
/// pairs.
std::string steadiness_line(const results::Results& results);

/// Tells a reader that results are a part: the shard, or the number of merged shards, and the
/// scenes reused from an interrupted run. Empty for a whole run.
std::vector<std::string> part_sentences(const results::Results& results);

}  // namespace contactcheck::report
