// Words of command lines that people copy.
#pragma once

#include <string>

namespace contactcheck {

/// `word` as a shell takes it for one word: quoted where it has to be.
std::string in_shell(const std::string& word);

}  // namespace contactcheck
