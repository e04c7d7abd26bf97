// Completion of the command line by shells. Names of scenes, suites and detectors are asked of the
// program when they are wanted.
#pragma once

#include <string>

#include "reference/docs/command_words.h"

namespace contactcheck {

std::string bash_completion(const ProgramWords& program);
std::string zsh_completion(const ProgramWords& program);
std::string fish_completion(const ProgramWords& program);

}  // namespace contactcheck
