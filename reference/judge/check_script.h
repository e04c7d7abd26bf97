// The text of check.py, which goes into every export.
#pragma once

#include <string_view>

namespace contactcheck::judge {

extern const std::string_view kCheckScript;

}  // namespace contactcheck::judge
