// Writes the manual page and the shells' completions out of the command line's own words:
//   write_command_pages FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "reference/adapters/register.h"
#include "reference/cli/command_words.h"
#include "reference/cli/completion.h"
#include "reference/cli/man_page.h"

namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

void write_pages(const std::filesystem::path& folder) {
  const contactcheck::cli::ProgramWords program =
      contactcheck::cli::program_words(contactcheck::adapters::standard_catalog());
  write(folder / "contactcheck.1", contactcheck::cli::man_page(program));
  write(folder / "contactcheck.bash", contactcheck::cli::bash_completion(program));
  write(folder / "_contactcheck", contactcheck::cli::zsh_completion(program));
  write(folder / "contactcheck.fish", contactcheck::cli::fish_completion(program));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_command_pages FOLDER\n");
    return 2;
  }
  try {
    write_pages(argv[1]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "write_command_pages: %s\n", e.what());
    return 1;
  }
  return 0;
}
