// A made-up paper of one scene in which everything agrees, and the real one.
#pragma once

#include <string>
#include <vector>

#include "reference/reproduce/paper_arithmetic.h"

namespace contactcheck::test {

/// The text of a paper file. Every finding that has a verdict agrees.
std::string sample_paper_text();
/// `text` with its first `from`, which must be there, replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to);
/// The tables of a paper file with this text.
reproduce::PaperTables tables_of(const std::string& text);
/// fixtures/paper/tables.json
reproduce::PaperTables real_paper();

/// The findings that match; an empty word matches all.
std::vector<reproduce::PaperFinding> select(const std::vector<reproduce::PaperFinding>& findings,
                                            const std::string& topic, const std::string& table = "",
                                            const std::string& scene = "",
                                            const std::string& method = "");

}  // namespace contactcheck::test
