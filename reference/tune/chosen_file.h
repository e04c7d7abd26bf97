// The chosen configuration as a file that `contactcheck run` takes.
#pragma once

#include <filesystem>
#include <string>

#include "reference/tune/tuning.h"

namespace contactcheck::tune {

/// chosen.json in the folder of the request.
std::filesystem::path chosen_file(const TuningRequest& request);

/// A suite of one scene and one detector, to be written as that file. The scene is an id; or a path
/// from that folder, absolute where symbolic links lie between the two.
/// @pre one is chosen
std::string chosen_suite(const Tuning& tuning, const TuningRequest& request);

/// The chosen detector is a plug-in: the suite names it, and the command line must load it.
/// @pre one is chosen
bool chosen_from_outside(const Tuning& tuning, const TuningRequest& request);

/// Takes away what an earlier run has left under that name.
/// @throws InputError when it is the scene itself, or cannot be taken away
void remove_old_choice(const TuningRequest& request);

}  // namespace contactcheck::tune
