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
  std::string name;                ///< "base" or "head"
  std::filesystem::path program;   ///< absolute
  std::vector<std::string> flags;  ///< that name its detectors
};

enum class BuildKind { kProgram, kLibrary, kCommand };

constexpr const char* kKindNames[] = {"a program", "a library", "a command"};

// A program may lie anywhere, so its path says nothing; but none is called "x.so", and a text of
// several words that is no file can only be a command.
BuildKind kind_of(const std::string& text) {
  if (text.substr(0, text.find(':')).ends_with(".so")) return BuildKind::kLibrary;
  const bool words = text.find(' ') != std::string::npos;
  return words && !fs::exists(text) ? BuildKind::kCommand : BuildKind::kProgram;
}

AbSide side_of(const char* name, const std::string& text, BuildKind kind,
               const AbArguments& arguments) {
  AbSide side = {name, fs::absolute(text), {}};
  if (kind == BuildKind::kProgram) {
    if (!fs::is_regular_file(side.program) || access(side.program.c_str(), X_OK) != 0)
      throw InputError(std::string(name) + " \"" + text + "\" is not a program that can be run");
  } else {
    side.program = fs::read_symlink("/proc/self/exe");
    side.flags = {kind == BuildKind::kLibrary ? "--detector" : "--detector-cmd", text};
  }
  for (const std::string& detector : arguments.detectors) {
    side.flags.push_back("--detector");
    side.flags.push_back(detector);
  }
  return side;
}

std::string detector_name(const std::string& text, BuildKind kind, const DetectorCatalog& catalog) {
  const bool library = kind == BuildKind::kLibrary;
  const OwnDetectors own = load_own_detectors(
      library ? std::vector{text} : std::vector<std::string>(),
      library ? std::vector<std::string>() : std::vector{text}, suite::RunSettings{}, catalog);
  return own.catalog.parse(own.names.front()).name;
}

// Base and head. @throws InputError: no program that can be run, no library or command that can be
// used, two of different kinds, detectors with different names
std::vector<AbSide> ab_sides(const AbArguments& arguments, const DetectorCatalog& catalog) {
  const std::string base = arguments.base.string(), head = arguments.head.string();
  const BuildKind kind = kind_of(base), other = kind_of(head);
  if (kind != other)
    throw InputError("base \"" + base + "\" is " + kKindNames[static_cast<int>(kind)] +
                     " and head \"" + head + "\" is " + kKindNames[static_cast<int>(other)] +
                     "; ab compares two of a kind");
  if (kind != BuildKind::kProgram) {
    // Rows are compared by their names.
    const std::string old_name = detector_name(base, kind, catalog),
                      new_name = detector_name(head, kind, catalog);
    if (old_name != new_name)
      throw InputError("base \"" + base + "\" is the detector \"" + old_name + "\" and head \"" +
                       head + "\" is \"" + new_name +
                       "\"; ab compares two builds of one detector with the same options");
  }
  return {side_of("base", base, kind, arguments), side_of("head", head, kind, arguments)};
}

constexpr auto kPollInterval = std::chrono::milliseconds(20);

/// One of the two builds.
class Build {
 public:
  Build(const AbSide& side, const AbArguments& arguments)
      : name_(side.name), program_(side.program), out_(fs::absolute(arguments.out) / side.name) {
    words_ = {"run", "--quiet", "--processes", "1"};
    if (arguments.frames > 0) add("--frames", std::to_string(arguments.frames));
    words_.insert(words_.end(), side.flags.begin(), side.flags.end());
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
