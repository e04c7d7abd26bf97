#pragma once

#include <cstddef>
#include <string>

namespace contactcheck::cli {

/// The words of `text`, broken so that lines end at column `width` (a longer word stands alone),
/// all lines but the first behind `indent` blanks, where the first begins too. Ends the last line.
std::string wrapped_text(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace contactcheck::cli
