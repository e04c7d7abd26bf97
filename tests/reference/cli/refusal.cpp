#include "tests/reference/cli/refusal.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

namespace contactcheck::test {
namespace {

namespace fs = std::filesystem;

// Sizes by path; folders and what cannot be asked count as nothing.
std::map<std::string, std::uintmax_t> tree(const fs::path& folder) {
  std::map<std::string, std::uintmax_t> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::error_code ignored;
    const bool file = entry.is_regular_file(ignored);
    out[entry.path().string()] = file ? entry.file_size(ignored) : 0;
  }
  return out;
}

}  // namespace

void PrintTo(const BadCommand& command, std::ostream* out) { *out << command.name; }

std::string with_folder(std::string text, const Scratch& scratch) {
  const std::string folder = scratch.folder().string();
  for (std::size_t at = 0; (at = text.find("DIR", at)) != std::string::npos; at += folder.size())
    text.replace(at, 3, folder);
  return text;
}

void expect_refused(const BadCommand& command, const Scratch& scratch) {
  Words words;
  for (const std::string& word : command.words) words.push_back(with_folder(word, scratch));
  const auto before = tree(scratch.folder());
  const Outcome outcome = contactcheck_program(words);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, testing::StartsWith("contactcheck: "));
  for (const std::string& piece : command.named)
    EXPECT_THAT(outcome.err, testing::HasSubstr(with_folder(piece, scratch)));
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(tree(scratch.folder()), before) << "nothing may be written";
}

}  // namespace contactcheck::test
