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

/// What a child of this program, which examines the source, has written within its limits.
std::string answer_of_child(const PluginSource& source, const std::filesystem::path& executable,
                            const suite::RunSettings& settings) {
  const double most_seconds = std::min(settings.call_limit, kMostSeconds);
  process::MemoryFile answer("contactcheck-examination");
  process::WorkerProcess process(executable,
                                 {"examine", name_of(source.kind),
                                  // A text that begins with '-' would be a flag.
                                  "--text=" + source.text, "--answer-fd",
                                  std::to_string(process::WorkerProcess::kInheritedFd)},
                                 answer.fd());
  std::string fault;  // the limit that it has passed
  {
    process::InterruptGuard interrupts;
    const Clock::time_point start = Clock::now();
    while (fault.empty() && !process.has_ended()) {
      std::this_thread::sleep_for(kPollInterval);
      if (interrupts.interrupted()) {
        process.kill();
        process.reap();
        interrupts.pass_on();
      }
      if (std::chrono::duration<double>(Clock::now() - start).count() > most_seconds)
        fault = "said nothing for " + text::shown(most_seconds) + " s (time limit)";
      else if (process.resident_bytes() > settings.memory_limit)
        fault =
            "took more than " + std::to_string(settings.memory_limit >> 20) + " MiB (memory limit)";
      else if (process.output_bytes() > process::kWorkerOutputLimit)
        fault = "wrote without end (output limit)";
    }
    if (!fault.empty()) process.kill();
  }
  const int status = process.reap();
  std::string text = answer.text(kLongestAnswer);
  // The exit code says nothing: a library may end the process by itself afterwards.
  if (fault.empty() && text.empty()) {
    fault = process::ended_text(status, process.error_text());
  }
  if (!fault.empty())
    throw InputError(described(source) + " " + fault + " when it was asked what it is");
  return text;
}

void write_all(int fd, const std::string& text) {
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t written = write(fd, rest.data(), rest.size());
    if (written <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

Plugin examine_plugin(const PluginSource& source, const std::filesystem::path& executable,
                      const suite::RunSettings& settings) {
  Plugin plugin;
  plugin.source = source;
  plugin.content = content_of(source);
  const std::string text = answer_of_child(source, executable, settings);
  // What the child has written was in reach of the plug-in.
  const std::string document = described(source);
  const text::JsonValue value = text::parse_json(text, document);
  const text::JsonField answer(value, document);
  if (value.kind != text::JsonValue::Kind::kObject) answer.refuse("an object");
  if (answer.has("fault")) {
    const std::string fault = answer.at("fault").text();
    const bool names_source = fault.rfind(document, 0) == 0;  // a sentence of ours does
    throw InputError(names_source ? fault : document + " cannot be used: " + fault);
  }
  plugin.declaration = read_declaration(answer.at("declaration"));
  return plugin;
}

int run_examination(const PluginSource& source, int answer_fd) {
  process::end_with_supervisor();
  Json answer;
  try {
    answer["declaration"] =
        to_json(source.kind == PluginKind::kLibrary ? PluginLibrary(source.text).declare()
                                                    : declare_command(source.text));
  } catch (...) {
    answer["fault"] = text::current_exception_text();
  }
  write_all(answer_fd, answer.dump(-1, ' ', false, Json::error_handler_t::replace));
  _exit(0);  // its destructors may hang
}

}  // namespace contactcheck::plugin
