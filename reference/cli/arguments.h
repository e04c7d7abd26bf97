// The subcommands' words on the command line. Each function adds one or two of them with their
// options and help; the one that is given leaves what is to be done in `chosen`.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/detect/registry.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace contactcheck::cli {

struct CommandLine {
  CLI::App& app;
  const DetectorCatalog& catalog;
  std::string words;            ///< as they were given, for the record
  std::function<int()> chosen;  ///< returns the exit code; empty before the words are parsed
};

/// What the program is, and all its subcommands, in the order of --help.
void describe_program(CommandLine& line);

void add_run(CommandLine& line);
void add_check(CommandLine& line);
void add_queries(CommandLine& line);
void add_init(CommandLine& line);
void add_merge(CommandLine& line);
void add_reproduce(CommandLine& line);
void add_reduce(CommandLine& line);
void add_export(CommandLine& line);
void add_gate(CommandLine& line);
void add_accept(CommandLine& line);
void add_ab(CommandLine& line);
void add_tune(CommandLine& line);
void add_list(CommandLine& line);
void add_report(CommandLine& line);
void add_diff(CommandLine& line);
void add_truth(CommandLine& line);
void add_defects(CommandLine& line);
/// What the program starts itself with; no help names it.
void add_workers(CommandLine& line);

/// The subcommand `command` does `what`.
void choose(CLI::App& command, CommandLine& line, std::function<int()> what);

/// --detector-cmd: detectors that are talked to over pipes; one string or a list of them.
void add_commands(CLI::App& command, std::string& detector);
void add_commands(CLI::App& command, std::vector<std::string>& detectors);

/// What CLI11 asks of a value: a number from `least` to `most`, else a sentence that says
/// `allowed`. (CLI11's own checks, 2.1, let NaN pass.)
std::function<std::string(const std::string&)> number_in(double least, double most,
                                                         const std::string& allowed);

/// What CLI11 asks of a whole number: decimal digits from `least` to `most`. (CLI11's own range
/// takes a leading 0 for octal: --frames 010 would be 8.)
CLI::Validator whole_in(std::uint64_t least, std::uint64_t most);

/// --call-limit and --memory-limit: what ends a detector that goes astray.
/// The values that they have now are the defaults.
void add_limits(CLI::App& command, double& seconds, std::uint64_t& mib);

}  // namespace contactcheck::cli
