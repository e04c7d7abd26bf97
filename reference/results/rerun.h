// Words of a command line that repeats a part of some results.
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::results {

/// "--detector NAME"; for a plug-in as in the results' command: a library with its options,
/// "--detector ./libmine.so:leaf=8", or a command, "--detector-cmd 'python3 mine.py'". Empty for a
/// transient detector, which no command can run again.
std::string detector_words(const Results& results, const std::string& detector);

/// The scene for `run`: its id, or the file or the meshes, with motion and size, of the results'
/// command.
std::string scene_words(const Results& results, const std::string& scene);

/// The folder of --out in the results' command.
std::string out_folder(const Results& results);

}  // namespace contactcheck::results
