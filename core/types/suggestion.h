// What a person may have meant by a name that does not exist.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contactcheck {

/// "did you mean bunny-touch? ", with up to three of `names`, in their order: those that begin with
/// `word` and a '-'; else those that the fewest edits (inserted, deleted, changed or exchanged
/// neighbouring characters) make of it, at most one in three characters. Capitals count as small
/// letters. Empty where none is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& names);

}  // namespace contactcheck
