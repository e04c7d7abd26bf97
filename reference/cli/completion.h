// Shell completion of the command line. The shell gets names of scenes, suites and detectors from
// the program when they are needed.
#pragma once

#include <string>

#include "reference/cli/command_words.h"

namespace contactcheck::cli {

// What can follow a flag, or stand as a word of its own: what a shell should offer there.

enum class ValueKind { kNothing, kFile, kScenes, kFamilies, kDetectors, kFormats, kWord };

ValueKind kind_of(const OptionWords& option);

/// The kind of the command's first positional; kNothing: it takes only flags.
ValueKind words_kind(const CommandWords& command);

/// A pipe of shell commands that prints the names there are, one a line. `program`: how the shell
/// calls contactcheck.
std::string names_command(ValueKind kind, const std::string& program);

std::string bash_completion(const ProgramWords& program);
std::string zsh_completion(const ProgramWords& program);
std::string fish_completion(const ProgramWords& program);

}  // namespace contactcheck::cli
