#include "reference/reduce/probe.h"

#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include "reference/reduce/probe_worker.h"
#include "reference/run/printable.h"

namespace contactcheck {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPollInterval = std::chrono::milliseconds(20);
// The exact judgement of a large frame may take longer than a detector is given.
constexpr double kSecondsOfOwnCode = 600.0;
constexpr double kSecondsToLeave = 5.0;
// As for the workers of a run (supervisor.cpp).
constexpr std::uint64_t kOutputLimit = std::uint64_t{64} << 20;

std::vector<std::string> words_of(const ProbeSettings& settings) {
  std::vector<std::string> words = {"probe", settings.detector, "--channel-fd",
                                    std::to_string(WorkerProcess::kInheritedFd)};
  for (const std::string& plugin : settings.plugins) words.push_back("--plugin=" + plugin);
  return words;
}

}  // namespace

Probe::Connection::Connection(const ProbeSettings& settings, Channel theirs, Channel own)
    : channel(std::move(own)), process(settings.executable, words_of(settings), theirs.fd()) {}

void Probe::connect() {
  auto [theirs, own] = Channel::pair();
  connection_ = std::make_unique<Connection>(settings_, std::move(theirs), std::move(own));
}

void Probe::pass_on_interrupt() {
  if (!interrupts_.interrupted()) return;
  connection_.reset();
  interrupts_.pass_on();
}

ProbeVerdict Probe::ask(const Snapshot& snapshot, const std::vector<Level>& levels) {
  pass_on_interrupt();  // quick answers leave no time to look while they are waited for
  ++asked_;
  const std::string request = probe_request(snapshot, levels);
  // What a detector has overwritten in an earlier frame may strike in the suite's own code; that
  // does not happen in a fresh process.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (!connection_) connect();
    if (const std::optional<ProbeVerdict> verdict = exchange(request)) return *verdict;
  }
  throw std::runtime_error("a worker process ended while it judged a frame, outside any detector");
}

// Nothing when the process ended before the detector's turn.
std::optional<ProbeVerdict> Probe::exchange(const std::string& request) {
  const bool sent = connection_->channel.send(request);
  const std::string own_limit = limit_passed_before_message(kSecondsOfOwnCode);
  if (!sent || !own_limit.empty() || !connection_->channel.receive()) {
    end_of_process(own_limit);
    return std::nullopt;
  }
  const std::string limit = limit_passed_before_message(settings_.call_limit);
  const std::optional<std::string> answer =
      limit.empty() ? connection_->channel.receive() : std::nullopt;
  return answer ? verdict_from_text(*answer) : end_of_process(limit);
}

std::string Probe::limit_passed_before_message(double seconds) {
  const Clock::time_point start = Clock::now();
  while (!connection_->channel.waits(kPollInterval)) {
    pass_on_interrupt();
    if (std::chrono::duration<double>(Clock::now() - start).count() > seconds) return "time limit";
    if (connection_->process.resident_bytes() > settings_.memory_limit) return "memory limit";
    if (connection_->process.output_bytes() > kOutputLimit) return "output limit";
    // A child of the library may hold the channel open.
    if (connection_->process.has_ended()) break;
  }
  return "";
}

// Its side of the channel is closed; exit handlers of libraries may hang.
bool Probe::leaves_by_itself() const {
  const Clock::time_point start = Clock::now();
  while (!connection_->process.has_ended()) {
    if (std::chrono::duration<double>(Clock::now() - start).count() > kSecondsToLeave) return false;
    std::this_thread::sleep_for(kPollInterval);
  }
  return true;
}

ProbeVerdict Probe::end_of_process(const std::string& limit) {
  if (!limit.empty() || !leaves_by_itself()) connection_->process.kill();
  const int status = connection_->process.reap();
  ProbeVerdict verdict;
  verdict.status = results::Status::kError;
  verdict.how = limit.empty() ? describe_status(status) : limit;
  verdict.message = printable_line(connection_->process.error_text());
  connection_.reset();
  return verdict;
}

}  // namespace contactcheck
