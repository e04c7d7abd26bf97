// What can follow a flag, or stand as a word of its own: what a shell should offer there.
#pragma once

#include <string>

#include "reference/docs/command_words.h"

namespace contactcheck {

enum class ValueKind { kNothing, kFile, kScenes, kFamilies, kDetectors, kFormats, kWord };

ValueKind kind_of(const OptionWords& option);

/// The first positional of the command; nothing: it takes flags alone.
ValueKind words_kind(const CommandWords& command);

/// A pipe of shell commands that prints the names there are, one a line. `program`: how the shell
/// calls contactcheck.
std::string names_command(ValueKind kind, const std::string& program);

}  // namespace contactcheck
