#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/detect/registry.h"
#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/github_job.h"
#include "reference/cli/own_detectors.h"
#include "reference/gate/output.h"
#include "reference/process/exit_codes.h"
#include "reference/process/interrupts.h"
#include "reference/process/worker_process.h"
#include "reference/results/ab.h"
#include "reference/results/results_file.h"
#include "reference/suite/out_lock.h"
#include "reference/text/printable.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

/// How one side is run.
struct AbSide {
  std::string name;                    ///< "base" or "head"
  std::filesystem::path program;       ///< absolute
  std::vector<std::string> detectors;  ///< of its command line
};

// A program may lie anywhere: its path alone says nothing, but none is called so.
bool is_library(const std::string& text) { return text.substr(0, text.find(':')).ends_with(".so"); }

AbSide program_side(const char* name, const std::string& text, const AbArguments& arguments) {
  const fs::path program = fs::absolute(text);
  if (!fs::is_regular_file(program) || access(program.c_str(), X_OK) != 0)
    throw InputError(std::string(name) + " \"" + text + "\" is not a program that can be run");
  return {name, program, arguments.detectors};
}

AbSide library_side(const char* name, const std::string& text, const AbArguments& arguments) {
  // A name without a folder is a file here, as for any other library.
  AbSide side = {name, fs::read_symlink("/proc/self/exe"), {text}};
  side.detectors.insert(side.detectors.end(), arguments.detectors.begin(),
                        arguments.detectors.end());
  return side;
}

std::string detector_name(const std::string& library, const DetectorCatalog& catalog) {
  const OwnDetectors own = load_own_detectors({library}, {}, suite::RunSettings{}, catalog);
  return own.catalog.parse(own.names.front()).name;
}

// Rows are compared by their names.
void require_one_detector(const AbArguments& arguments, const DetectorCatalog& catalog) {
  const std::string base = detector_name(arguments.base, catalog),
                    head = detector_name(arguments.head, catalog);
  if (base == head) return;
  throw InputError("base \"" + arguments.base.string() + "\" is the detector \"" + base +
                   "\" and head \"" + arguments.head.string() + "\" is \"" + head +
                   "\"; ab compares two builds of one detector with the same options");
}

// Base and head. @throws InputError: no program that can be run, no library that can be used, a
// program against a library, libraries whose detectors have different names
std::vector<AbSide> ab_sides(const AbArguments& arguments, const DetectorCatalog& catalog) {
  const bool of_libraries = is_library(arguments.base);
  if (of_libraries != is_library(arguments.head))
    throw InputError("base \"" + arguments.base.string() + "\" and head \"" +
                     arguments.head.string() +
                     "\" are a library and a program; ab compares two of a kind");
  if (of_libraries) require_one_detector(arguments, catalog);
  const auto side = of_libraries ? library_side : program_side;
  return {side("base", arguments.base, arguments), side("head", arguments.head, arguments)};
}

constexpr auto kPollInterval = std::chrono::milliseconds(20);

/// One of the two builds.
class Build {
 public:
  Build(const AbSide& side, const AbArguments& arguments)
      : name_(side.name), program_(side.program), out_(fs::absolute(arguments.out) / side.name) {
    words_ = {"run", "--quiet", "--processes", "1"};
    if (arguments.frames > 0) add("--frames", std::to_string(arguments.frames));
    for (const std::string& detector : side.detectors) add("--detector", detector);
    add("--out", out_.string());
    words_.insert(words_.end(), arguments.targets.begin(), arguments.targets.end());
  }

  results::Results run() const {
    // What an earlier round has left must not pass for this one's.
    std::error_code ignored;
    fs::remove(out_ / "results.json", ignored);
    run_to_the_end();
    return results::results_in(out_ / "results.json");
  }

 private:
  void add(const char* flag, const std::string& value) {
    words_.push_back(flag);
    words_.push_back(value);
  }

  void run_to_the_end() const {
    const process::MemoryFile nothing(
        "contactcheck-nothing");  // a descriptor that the program ignores
    process::WorkerProcess process(program_, words_, nothing.fd());
    process::InterruptGuard interrupts;
    while (!process.has_ended()) {
      std::this_thread::sleep_for(kPollInterval);
      if (!interrupts.interrupted()) continue;
      process.kill();
      process.reap();
      interrupts.pass_on();
    }
    const int status = process.reap();
    // 3: a detector ended in an error, which its row says; the results are whole.
    const bool done = WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 3);
    if (done) return;
    const std::string words = text::printable_line(process.error_text());
    throw InputError(name_ + " \"" + program_.string() + "\" ended in " +
                     process::describe_status(status) + (words.empty() ? "" : ": " + words));
  }

  std::string name_;
  fs::path program_, out_;
  std::vector<std::string> words_;
};

// Base head, head base, base head, ...: what slows the machine down for a while hits both. Every
// run is a fresh process with results of its own in OUT/base or OUT/head, where the last ones
// stay. `sides`: base and head. `on_round` is called with the number of each round, from 0.
// @throws InputError when a program cannot be started, is refused its input or leaves no results
// that can be read; Interrupted
std::vector<results::AbRound> run_rounds(const std::vector<AbSide>& sides,
                                         const AbArguments& arguments,
                                         const std::function<void(std::size_t)>& on_round) {
  const Build base(sides.at(0), arguments), head(sides.at(1), arguments);
  std::vector<results::AbRound> rounds(arguments.rounds);
  for (std::size_t r = 0; r < rounds.size(); ++r) {
    on_round(r);
    const bool base_first = r % 2 == 0;
    if (base_first) rounds[r].base = base.run();
    rounds[r].head = head.run();
    if (!base_first) rounds[r].base = base.run();
  }
  return rounds;
}

// Before anything runs: a summary that cannot be written would be noticed too late.
fs::path required_summary_file() {
  fs::path file = github_summary_file();
  if (file.empty())
    throw InputError("--github: the environment names no file in GITHUB_STEP_SUMMARY");
  return file;
}

void tell_github(const fs::path& file, const results::AbJudgement& judgement,
                 const results::AbSetting& setting) {
  for (const std::string& failure : results::ab_failures(judgement, setting))
    std::fputs(gate::github_annotation("error", "contactcheck ab", failure).c_str(), stdout);
  append_github_summary(file, results::ab_markdown(judgement, setting));
}

results::AbSetting setting_of(const AbArguments& arguments) {
  return {arguments.base.string(),
          arguments.head.string(),
          arguments.rounds,
          {arguments.slower_than, arguments.floor_us},
          arguments.accuracy_may_change};
}

}  // namespace

int ab_command(const AbArguments& arguments, const DetectorCatalog& catalog) {
  const fs::path summary = arguments.github ? required_summary_file() : "";
  const std::vector<AbSide> sides = ab_sides(arguments, catalog);
  check_out(arguments.out);
  const suite::OutLock lock(arguments.out);
  const std::vector<results::AbRound> rounds = run_rounds(sides, arguments, [&](std::size_t round) {
    if (!arguments.quiet) std::fprintf(stderr, "round %zu of %zu\n", round + 1, arguments.rounds);
  });
  const results::AbSetting setting = setting_of(arguments);
  const results::AbJudgement judgement = results::judge_ab(rounds, setting.limits);
  std::fputs(results::ab_text(judgement, setting).c_str(), stdout);
  if (arguments.github) tell_github(summary, judgement, setting);
  return setting.fails(judgement) ? process::kExitNo : 0;
}

}  // namespace contactcheck::cli
