// The worker as a process of the operating system, with separate streams and process group.
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

/// Bytes that a worker may write on both streams before its supervisor ends it: they are files in
/// memory, which no other limit counts. A library that prints a line for every contact stays far
/// below.
inline constexpr std::uint64_t kWorkerOutputLimit = std::uint64_t{64} << 20;

/// A running worker. Its standard input is empty; its standard output and error are private files,
/// opened for appending. It leads a process group, so that children of a library end with it.
class WorkerProcess {
 public:
  /// The number under which the worker finds the descriptor that it inherits; all numbers below are
  /// its standard streams.
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

  /// Resident memory of the worker and all processes that it has started, bytes.
  std::uint64_t resident_bytes() const { return resident_bytes_of_tree(child_.pid()); }
  /// Bytes written and not yet taken by the worker, both streams together.
  std::uint64_t output_bytes() const { return output_.size() + errors_.size(); }
  /// The text of its standard error.
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

/// "ended in signal 6 (Aborted): Assertion failed ...", with one line of what it wrote on its
/// standard error, if it did.
std::string ended_text(int status, const std::string& error_text);

}  // namespace contactcheck::process
