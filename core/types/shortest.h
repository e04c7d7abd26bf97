// Numbers as text, without loss.
#pragma once

#include <string>

namespace contactcheck {

/// The shortest text that reads back as the same double, whatever the locale; "inf" and "nan" too.
std::string shortest(double value);

}  // namespace contactcheck
