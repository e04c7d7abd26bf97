// The subcommands. Each returns the exit code of the design: 0 the work was done, 2 bad usage or
// bad input, 3 a detector ended in an error. InputError passes through to main, which makes it 2.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace contactcheck {

struct RunArguments {
  std::vector<std::string> targets;    ///< suites, scenes, files; empty: the suite default
  std::vector<std::string> detectors;  ///< empty: those of the suite
  std::size_t frames = 0, repeats = 5, processes = 1;
  std::filesystem::path out = "out";
  bool timing = true, quiet = false;
  std::string command_line;  ///< for the record
};

int run_command(const RunArguments& arguments);
int list_command();
/// `formats`: of "md".
int report_command(const std::filesystem::path& results, const std::vector<std::string>& formats,
                   const std::filesystem::path& out);

}  // namespace contactcheck
