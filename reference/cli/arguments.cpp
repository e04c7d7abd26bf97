#include "reference/cli/arguments.h"

#include <CLI/CLI.hpp>
#include <utility>

namespace contactcheck {
namespace {

// CLI11's own range (2.1) lets NaN pass.
std::string seconds_in_range(const std::string& text) {
  constexpr double kLeast = 0.1, kMost = 1e6;
  double value = 0.0;
  const bool number = CLI::detail::lexical_cast(text, value);
  return number && value >= kLeast && value <= kMost
             ? ""
             : "\"" + text + "\" is not a number from 0.1 to 1000000";
}

}  // namespace

void choose(CLI::App& command, CommandLine& line, std::function<int()> what) {
  command.callback([&line, what = std::move(what)] { line.chosen = what; });
}

void add_limits(CLI::App& command, double& seconds, std::uint64_t& mib,
                const std::string& default_seconds) {
  command
      .add_option("--call-limit", seconds,
                  "seconds that one call of a detector may take (default " + default_seconds +
                      "); beyond, it has ended in an error")
      ->check(seconds_in_range)
      ->type_name("SECONDS");
  command
      .add_option("--memory-limit", mib,
                  "resident memory of a worker process (default 4096); the detector that passes it "
                  "has ended in an error")
      ->check(CLI::Range(64, 1 << 30))
      ->type_name("MIB");
}

}  // namespace contactcheck
