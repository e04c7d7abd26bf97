// Fuzz target: command lines, words with NUL bytes between them. They are parsed, and nothing of
// them is run: a line that is accepted says what is to be done, one that is not says why. For the
// record the words are quoted as a shell takes them.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "reference/cli/arguments.h"
#include "reference/text/shell_word.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

std::vector<std::string> words_of(const std::string& bytes) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= bytes.size();) {
    const std::size_t end = std::min(bytes.find('\0', begin), bytes.size());
    words.push_back(bytes.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

void check_shell_words(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += " " + text::in_shell(word);
  require(text::shell_words(line) == words, "a shell takes the words that were given");
}

void parse(std::vector<std::string> words) {
  CLI::App app;
  const DetectorCatalog catalog;
  cli::CommandLine line{app, catalog, "", {}};
  cli::describe_program(line);
  std::string program = "contactcheck";
  std::vector<char*> argv = {program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  try {
    app.parse(static_cast<int>(argv.size()), argv.data());
    require(line.chosen != nullptr, "a line that is accepted says what is to be done");
  } catch (const CLI::ParseError& refusal) {
    require(*refusal.what() != '\0', "a refusal says why");
  } catch (const InputError& refusal) {
    require_sentence(refusal.what());
  }
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(arguments) {
  using namespace contactcheck;
  const std::vector<std::string> words =
      test::words_of(std::string(reinterpret_cast<const char*>(data), size));
  test::check_shell_words(words);
  test::parse(words);
  return 0;
}
