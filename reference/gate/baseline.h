// Results as the baseline of later gates: what a gate compares, and nothing that points at files.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::gate {

/// Without recordings, cases, times and shares per frame, histograms and episodes; machine,
/// libraries and command stay. @pre no shard
results::Results baseline_of(results::Results results);

/// As it is written: one line per scene and per row, so that a change of one row is one line of a
/// difference.
std::string baseline_text(const results::Results& baseline);

/// What another baseline in its place changes, a line each: machine and libraries, rows that are
/// new or gone, statuses, contacts, counts at the finest level; empty when nothing of it changed.
/// Times are not compared.
std::vector<std::string> baseline_changes(const results::Results& before,
                                          const results::Results& now);

}  // namespace contactcheck::gate
