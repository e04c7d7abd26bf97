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

/// What the messages of errors say of those that no frame of the scene alone shows: in a timed
/// pass, behind the message; in a warm-up, behind the number of its frame.
inline constexpr const char* kWhileTimed = " (while timed)";
inline constexpr const char* kOfWarmUp = " of the warm-up";
/// True if the row ended in an error while a frame was judged: the recording of the scene shows it.
bool failed_in_a_frame(const Run& row);

}  // namespace contactcheck::results
