// Results as the baseline of later gates: the compared fields, without references to files.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::gate {

/// Drops recordings, cases, identities, times and shares per frame, histograms and episodes; keeps
/// machine, libraries and command. @pre not a shard
results::Results baseline_of(results::Results results);

/// The text of the file: one line per scene and per row, so that a changed row is one line of a
/// diff.
std::string baseline_text(const results::Results& baseline);

/// What changes if `now` replaces `before`, one line each: machine and libraries, rows that are new
/// or gone, statuses, contacts, counts at the finest level; empty if none of it changed. Times are
/// not compared.
std::vector<std::string> baseline_changes(const results::Results& before,
                                          const results::Results& now);

}  // namespace contactcheck::gate
