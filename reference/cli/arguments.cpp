#include "reference/cli/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <utility>

#include "reference/cli/command_words.h"

namespace contactcheck::cli {
namespace {

// In the order of --help.
constexpr void (*kSubcommands[])(CommandLine&) = {
    add_run,  add_check,  add_queries, add_init,  add_merge,   add_reproduce,
    add_tune, add_reduce, add_export,  add_gate,  add_accept,  add_ab,
    add_list, add_report, add_diff,    add_truth, add_defects, add_workers};

template <typename Commands>
void add_command_option(CLI::App& command, Commands& commands) {
  command
      .add_option("--detector-cmd", commands,
                  "detector that is a command with pipes (reference/plugin/README.md)")
      ->allow_extra_args(false)
      ->type_name("CMD");
}

}  // namespace

void add_commands(CLI::App& command, std::string& detector) {
  add_command_option(command, detector);
}

void add_commands(CLI::App& command, std::vector<std::string>& detectors) {
  add_command_option(command, detectors);
}

void describe_program(CommandLine& line) {
  line.app.name("contactcheck");
  line.app.description(
      "Tests collision detectors for deformable meshes against exact ground truth.");
  line.app.formatter(help_formatter());
  line.app.require_subcommand(1);
  line.app.set_version_flag("--version", CONTACTCHECK_VERSION);
  line.app.footer(
      "Exit codes: 0 done, 1 a check fails, 2 bad usage, bad input or output that cannot be\n"
      "written, 3 status error of a detector that is no known defect.\n"
      "Example:\n  contactcheck run bunny-touch");
  for (const auto& add : kSubcommands) add(line);
}

CLI::Validator whole_in(std::uint64_t least, std::uint64_t most) {
  const std::string low = std::to_string(least), high = std::to_string(most);
  const auto fault = [=](const std::string& text) -> std::string {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most)
      return "Value " + text + " not in range " + low + " to " + high;
    if (text.size() > 1 && text.front() == '0')
      return "Value " + text + " begins with 0; it must be a decimal number";
    return "";
  };
  return CLI::Validator(fault, "UINT in [" + low + " - " + high + "]");
}

void choose(CLI::App& command, CommandLine& line, std::function<int()> what) {
  command.callback([&line, what = std::move(what)] { line.chosen = what; });
}

std::function<std::string(const std::string&)> number_in(double least, double most,
                                                         const std::string& allowed) {
  return [=](const std::string& text) {
    double value = 0.0;
    const bool number = CLI::detail::lexical_cast(text, value);
    return number && value >= least && value <= most
               ? std::string()
               : "\"" + text + "\" is not a number from " + allowed;
  };
}

void add_limits(CLI::App& command, double& seconds, std::uint64_t& mib) {
  command
      .add_option("--call-limit", seconds,
                  fmt::format("time limit for one detector call (default {:g})", seconds))
      ->check(number_in(0.1, 1e6, "0.1 to 1000000"))
      ->type_name("SECONDS");
  command
      .add_option("--memory-limit", mib,
                  fmt::format("memory limit of a worker process (default {})", mib))
      ->check(whole_in(64, 1 << 30))
      ->type_name("MIB");
}

}  // namespace contactcheck::cli
