// check.csv and check.json: every contact that was found, for a table and for a program.
#pragma once

#include <string>

#include "reference/check/check_summary.h"

namespace contactcheck::check {

/// One line per contact (RFC 4180), of frames and of steps. Columns that do not apply are empty.
/// fixtures/README.md, "Checked frames", explains the columns.
std::string check_csv(const CheckSummary& summary);

/// Schema contactcheck-check/1: `command`, `frames` and `steps` as events have them, and of the end
/// the same as the event. `start`: the keys of that event.
Json check_json(const CheckSummary& summary, const std::string& command, const Json& start,
                int exit_code);

}  // namespace contactcheck::check
