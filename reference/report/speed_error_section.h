// The chart of speed against error in the Markdown report.
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck {

/// The chart, what it shows, and its points as a table. Empty where nothing was timed.
std::string speed_error_markdown(const results::Results& results);

/// The picture that the section shows, empty where it shows none.
std::string speed_error_picture(const results::Results& results);

}  // namespace contactcheck
