// Runs a program to its end and keeps what it said.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {

struct Outcome {
  int exit_code = -1;  ///< 128 + signal for a program that died of one
  std::string out, err;
};

/// A program that runs beside the test, with its streams in files; stdin is empty.
class RunningProgram {
 public:
  /// Fails the test when `program` cannot be started.
  RunningProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  /// Kills it unless it has ended.
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  bool has_ended() const;
  void send(int signal) const;
  /// Waits for the end. At most once.
  Outcome outcome();

 private:
  Scratch scratch_;
  pid_t pid_ = 0;  ///< 0: not started, or ended and asked
};

/// Runs `program` to its end.
Outcome run_program(const std::filesystem::path& program,
                    const std::vector<std::string>& arguments);

/// The contactcheck of this build.
Outcome contactcheck_program(const std::vector<std::string>& arguments);

}  // namespace contactcheck::test
