// The manual page contactcheck(1), in troff's man macros.
#pragma once

#include <string>

#include "reference/cli/command_words.h"

namespace contactcheck::cli {

std::string man_page(const ProgramWords& program);

}  // namespace contactcheck::cli
