#include "reference/plugin/examination.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "core/types/check.h"
#include "reference/plugin/pipe_detector.h"
#include "reference/plugin/plugin_library.h"
#include "reference/process/interrupts.h"
#include "reference/process/surroundings.h"
#include "reference/process/worker_process.h"
#include "reference/suite/worker.h"
#include "reference/text/printable.h"

namespace contactcheck::plugin {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

constexpr auto kPollInterval = std::chrono::milliseconds(5);
constexpr double kMostSeconds = 30.0;
constexpr std::size_t kLongestAnswer = std::size_t{1} << 20;
constexpr std::uint64_t kOutputLimit = std::uint64_t{64} << 20;  // as for workers

/// The child that examines, and its limits.
class Examination {
 public:
  Examination(const PluginSource& source, const std::filesystem::path& executable,
              const suite::RunSettings& settings)
      : source_(source),
        memory_limit_(settings.memory_limit),
        seconds_(std::min(settings.call_limit, kMostSeconds)),
        answer_("contactcheck-examination"),
        process_(executable,
                 {"examine", name_of(source.kind),
                  // A word of its own that begins with '-' would be a flag.
                  "--text=" + source.text, "--answer-fd",
                  std::to_string(process::WorkerProcess::kInheritedFd)},
                 answer_.fd()) {}

  std::string answer() {
    const std::string limit = watch_to_the_end();
    const int status = process_.reap();
    std::string text = answer_.text(kLongestAnswer);
    // The exit code says nothing: a library may end the process in its own ways afterwards.
    if (!limit.empty()) refuse(limit);
    if (text.empty()) refuse("ended in " + process::describe_status(status) + last_words());
    return text;
  }

 private:
  std::string watch_to_the_end() {
    process::InterruptGuard interrupts;
    const Clock::time_point start = Clock::now();
    while (!process_.has_ended()) {
      std::this_thread::sleep_for(kPollInterval);
      if (interrupts.interrupted()) {
        process_.kill();
        process_.reap();
        interrupts.pass_on();
      }
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      std::string limit = broken_limit(seconds);
      if (limit.empty()) continue;
      process_.kill();
      return limit;
    }
    return "";
  }

  std::string broken_limit(double seconds) const {
    if (seconds > seconds_) return "said nothing for " + text::shown(seconds_) + " s (time limit)";
    if (process_.resident_bytes() > memory_limit_)
      return "took more than " + std::to_string(memory_limit_ >> 20) + " MiB (memory limit)";
    if (process_.output_bytes() > kOutputLimit) return "wrote without end (output limit)";
    return "";
  }

  std::string last_words() const {
    const std::string words = text::printable_line(process_.error_text());
    return words.empty() ? "" : ": " + words;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(described(source_) + " " + what + " when it was asked what it is");
  }

  const PluginSource& source_;
  std::uint64_t memory_limit_;
  double seconds_;
  process::MemoryFile answer_;
  process::WorkerProcess process_;
};

Declaration declaration_of(const PluginSource& source) {
  return source.kind == PluginKind::kLibrary ? PluginLibrary(source.text).declare()
                                             : declare_command(source.text);
}

Json answer_of(const PluginSource& source) {
  try {
    return {{"declaration", to_json(declaration_of(source))}};
  } catch (...) {
    return {{"fault", text::current_exception_text()}};
  }
}

void write_all(int fd, const std::string& text) {
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t written = write(fd, rest.data(), rest.size());
    if (written <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

// A sentence of ours names its source already.
[[noreturn]] void refuse(const PluginSource& source, const std::string& fault) {
  const std::string name = described(source);
  throw InputError(fault.rfind(name, 0) == 0 ? fault : name + " cannot be used: " + fault);
}

}  // namespace

Plugin examine_plugin(const PluginSource& source, const std::filesystem::path& executable,
                      const suite::RunSettings& settings) {
  Plugin plugin;
  plugin.source = source;
  plugin.content = content_of(source);
  const std::string text = Examination(source, executable, settings).answer();
  // What the child has written was in reach of the plug-in.
  const std::string document = described(source);
  const text::JsonValue value = text::parse_json(text, document);
  const text::JsonField answer(value, document);
  if (value.kind != text::JsonValue::Kind::kObject) answer.refuse("an object");
  if (answer.has("fault")) refuse(source, answer.at("fault").text());
  plugin.declaration = read_declaration(answer.at("declaration"));
  return plugin;
}

int run_examination(const PluginSource& source, int answer_fd) {
  process::end_with_supervisor();
  write_all(answer_fd, answer_of(source).dump(-1, ' ', false, Json::error_handler_t::replace));
  _exit(0);  // its destructors may hang
}

}  // namespace contactcheck::plugin
