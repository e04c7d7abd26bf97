// The manual page contactcheck(1), in troff's man macros.
#pragma once

#include <string>

#include "reference/docs/command_words.h"

namespace contactcheck {

std::string man_page(const ProgramWords& program);

}  // namespace contactcheck
