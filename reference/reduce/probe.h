// Asks a detector about one frame of two bodies after the other, in a process of its own: a
// detector that crashes, hangs or eats memory ends that process, and this is its answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reference/reduce/candidate.h"
#include "reference/reduce/channel.h"
#include "reference/reduce/verdict.h"
#include "reference/run/interrupts.h"
#include "reference/run/worker_process.h"

namespace contactcheck {

struct ProbeSettings {
  std::filesystem::path executable;  ///< this program, for its hidden subcommand `probe`
  std::string detector;              ///< canonical name
  std::vector<std::string> plugins;  ///< as RunSettings::plugins
  double call_limit = 10.0;          ///< seconds that a detector may take for one frame
  std::uint64_t memory_limit = std::uint64_t{4} << 30;  ///< bytes resident
};

class Probe {
 public:
  explicit Probe(ProbeSettings settings) : settings_(std::move(settings)) {}

  /// What the detector, made anew, answers, judged at `levels` as `contactcheck run` judges it.
  /// @throws std::runtime_error when the suite's own code cannot judge the frame; Interrupted
  ProbeVerdict ask(const Snapshot& snapshot, const std::vector<Level>& levels);
  /// The next question is asked in a fresh process.
  void restart() { connection_.reset(); }
  std::size_t asked() const { return asked_; }

 private:
  struct Connection {
    Connection(const ProbeSettings& settings, Channel theirs, Channel own);
    Channel channel;
    WorkerProcess process;
  };

  void connect();
  void pass_on_interrupt();
  std::optional<ProbeVerdict> exchange(const std::string& request);
  std::string limit_passed_before_message(double seconds);
  bool leaves_by_itself() const;
  ProbeVerdict end_of_process(const std::string& limit);

  ProbeSettings settings_;
  std::unique_ptr<Connection> connection_;
  InterruptGuard interrupts_;
  std::size_t asked_ = 0;
};

}  // namespace contactcheck
