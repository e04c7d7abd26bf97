// What tuning found, for people.
#pragma once

#include <string>

#include "reference/tune/tuning.h"

namespace contactcheck::tune {

/// For a terminal: the front, the chosen configuration and the command that runs it.
std::string tuning_text(const Tuning& tuning, const TuningRequest& request);

/// The same as a Markdown page, with everything that was measured.
std::string tuning_markdown(const Tuning& tuning, const TuningRequest& request);

}  // namespace contactcheck::tune
