#include "tests/reference/reproduce/sample_paper.h"

#include <gtest/gtest.h>

#include "reference/text/file_text.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {

std::string sample_paper_text() {
  return text::read_file_bytes(CONTACTCHECK_SAMPLE_PAPER, "sample");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "not in the text: " << from;
    return text;
  }
  return text.replace(at, from.size(), to);
}

reproduce::PaperTables tables_of(const std::string& text) {
  const Scratch scratch;
  return reproduce::load_paper_tables(scratch.write("tables.json", text));
}

}  // namespace contactcheck::test
