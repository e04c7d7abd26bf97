// Words of a command line that runs a part of some results again.
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::results {

/// "--detector NAME", or how the results' command named a detector from outside: a library with its
/// options, "--detector ./libmine.so:leaf=8", or a command, "--detector-cmd 'python3 mine.py'".
/// Empty for a transient detector, which no command can run again.
std::string detector_words(const Results& results, const std::string& detector);

/// The scene as `run` takes it: its id, or the file or the meshes, with motion and size, that the
/// results' command named.
std::string scene_words(const Results& results, const std::string& scene);

/// The folder of --out, as the results' command names it.
std::string out_folder(const Results& results);

}  // namespace contactcheck::results
