// The worker as an operating system's process: with streams of its own, in a group of its own.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "reference/process/process_tree.h"

namespace contactcheck::process {

/// A file without a name, in memory.
class MemoryFile {
 public:
  /// @throws InputError when it cannot be made
  explicit MemoryFile(const char* label);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int fd() const { return fd_; }
  std::uint64_t size() const;
  /// Its first bytes, `longest` at most.
  std::string text(std::size_t longest) const;
  /// Its last bytes, `longest` at most.
  std::string last_text(std::size_t longest) const;

 private:
  std::string text_from(std::uint64_t begin, std::size_t longest) const;

  int fd_;
};

/// A running worker. Its standard input is empty; its standard output and error are files that only
/// it and this object know, opened for appending. It leads a process group, so that children of a
/// library end with it.
class WorkerProcess {
 public:
  /// Under which number the worker finds the descriptor that it is given; also the end of the
  /// numbers that its standard streams take.
  static constexpr int kInheritedFd = 3;

  /// Runs `executable ARGUMENTS...` with the descriptor `inherited_fd` as kInheritedFd.
  /// @throws InputError when it cannot be started
  WorkerProcess(const std::filesystem::path& executable, std::vector<std::string> arguments,
                int inherited_fd);
  /// Ends the group.
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  bool has_ended() const;
  void kill();
  /// Waits for its end, ends what is left of its group and of all that it has started, and gives
  /// its status as waitpid does.
  int reap();

  /// With all that it has started.
  std::uint64_t resident_bytes() const { return resident_bytes_of_tree(child_.pid()); }
  /// What it has written and not taken back, both streams together.
  std::uint64_t output_bytes() const { return output_.size() + errors_.size(); }
  /// What stands on its standard error.
  std::string error_text() const;

 private:
  void start(const std::filesystem::path& executable, std::vector<std::string> arguments,
             int inherited_fd);

  MemoryFile output_, errors_;
  Child child_;
  bool reaped_ = false;
};

/// What waitpid's status says: "signal 11 (Segmentation fault)", "exit code 3".
std::string describe_status(int status);

}  // namespace contactcheck::process
