// A made-up paper of one scene in which everything agrees.
#pragma once

#include <string>

#include "reference/reproduce/paper_tables.h"

namespace contactcheck::test {

/// The text of sample_paper.json. Every finding that has a verdict agrees.
std::string sample_paper_text();
/// `text` with its first `from`, which must be there, replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to);
/// The tables of a paper file with this text.
reproduce::PaperTables tables_of(const std::string& text);

}  // namespace contactcheck::test
