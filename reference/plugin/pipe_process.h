// A command that is talked to over its standard input and output.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "reference/process/process_tree.h"
#include "reference/process/worker_process.h"

namespace contactcheck::plugin {

struct PipeLimits {
  std::size_t line = std::size_t{1} << 20;         ///< bytes of a line that it writes
  std::size_t unasked = std::size_t{1} << 20;      ///< bytes that it writes before it is asked
  std::uint64_t errors = std::uint64_t{64} << 20;  ///< bytes on its standard error
};

/// Runs `/bin/sh -c COMMAND` in this process's working directory, as the leader of a process group,
/// so that the whole of it can be paused. It ends with this process. Its standard error is a file
/// of its own. There is no limit of time or memory here: a worker that waits makes no progress, and
/// its supervisor, who counts the memory of all that a worker has started, ends it.
class PipeProcess {
 public:
  /// @throws InputError when there are no pipes or processes to be had
  explicit PipeProcess(const std::string& command, const PipeLimits& limits = {});
  /// Closes its input; what has not ended half a second later is killed.
  ~PipeProcess();
  /// Kills it and all that it has started, at once. Nothing else may be called afterwards.
  void kill();
  PipeProcess(const PipeProcess&) = delete;
  PipeProcess& operator=(const PipeProcess&) = delete;

  /// All of these @throw std::runtime_error: it has ended (with what it said last), passed a limit,
  /// or wrote what it was not asked for
  void send(std::string_view bytes);
  std::string receive_line();  ///< without its end
  std::string receive(std::size_t bytes);

  /// Stops its process group, so that it computes nothing while nobody waits for it; send() lets it
  /// go on, too. A process that has left the group is not stopped (timing::CpuBook sees it).
  void pause();
  void resume();
  /// Resident memory of it and all that it has started.
  std::uint64_t resident_bytes() const { return process::resident_bytes_of_tree(child_.pid()); }

  /// The first line that it wrote on its standard error, or "".
  std::string first_error_line() const;

 private:
  void start(const std::string& command, int input, int output);
  bool wait_for(short input_events, short* ready) const;
  void read_more();
  void check_limits() const;
  [[noreturn]] void fail_ended();
  [[noreturn]] void fail(const std::string& what) const;
  std::string last_words() const;
  bool ends_within(int milliseconds);
  void close_input();

  PipeLimits limits_;
  process::MemoryFile errors_;
  process::Child child_;
  int input_ = -1, output_ = -1;  ///< of the command: written and read here
  int status_ = 0;
  bool reaped_ = false, paused_ = false;
  std::string buffer_;  ///< read and not yet asked for
  /// When the limits were last looked at: a command that answers at once must keep them too.
  mutable std::chrono::steady_clock::time_point checked_{};
};

}  // namespace contactcheck::plugin
