// The text of check.py, which goes into every export.
#pragma once

#include <string_view>

namespace contactcheck::certify {

extern const std::string_view kCheckScript;

}  // namespace contactcheck::certify
