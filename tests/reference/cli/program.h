// Runs a program to its end and keeps what it said.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contactcheck::test {

struct Outcome {
  int exit_code = -1;  ///< 128 + signal for a program that died of one
  std::string out, err;
};

/// Runs `program` with its streams in files; stdin is empty.
Outcome run_program(const std::filesystem::path& program,
                    const std::vector<std::string>& arguments);

/// The contactcheck of this build.
Outcome contactcheck_program(const std::vector<std::string>& arguments);

}  // namespace contactcheck::test
