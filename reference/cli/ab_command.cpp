#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "core/detect/registry.h"
#include "core/types/check.h"
#include "core/types/suggestion.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/github_job.h"
#include "reference/cli/own_detectors.h"
#include "reference/gate/output.h"
#include "reference/judge/frame_check.h"
#include "reference/process/exit_codes.h"
#include "reference/process/interrupts.h"
#include "reference/process/worker_process.h"
#include "reference/results/ab.h"
#include "reference/results/results_file.h"
#include "reference/results/results_json.h"
#include "reference/suite/kept_work.h"
#include "reference/suite/out_lock.h"
#include "reference/suite/run_identity.h"
#include "reference/suite/run_plan.h"
#include "reference/text/counted.h"
#include "reference/text/printable.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

/// How one side is run.
struct AbSide {
  std::string name;                ///< "base" or "head"
  std::filesystem::path program;   ///< absolute
  std::vector<std::string> flags;  ///< that name its detectors
  std::string detector;            ///< of a side that is one; empty: a program with its own
  std::string content;             ///< of the program or plug-in: another one is another side
};

/// A program, or a detector that this one runs.
enum class SideKind { kProgram, kLibrary, kCommand, kBuiltIn };

// A program may lie anywhere, so its path says nothing; but none is called "x.so", and a text of
// several words that is no file can only be a command.
SideKind kind_of(const std::string& text, const DetectorCatalog& catalog) {
  const std::string id = text.substr(0, text.find(':'));
  if (id.ends_with(".so")) return SideKind::kLibrary;
  if (catalog.find(id) != nullptr) return SideKind::kBuiltIn;
  const bool words = text.find(' ') != std::string::npos;
  return words && !fs::exists(text) ? SideKind::kCommand : SideKind::kProgram;
}

// "" where there is no such file.
std::string content_of_file(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) ? suite::hash_of_file(file) : "";
}

// Name and content of a side that is a detector.
std::pair<std::string, std::string> examined(const std::string& text, SideKind kind,
                                             const DetectorCatalog& catalog) {
  if (kind == SideKind::kBuiltIn) return {catalog.parse(text).name, ""};
  const bool library = kind == SideKind::kLibrary;
  const OwnDetectors own = load_own_detectors(
      library ? std::vector{text} : std::vector<std::string>(),
      library ? std::vector<std::string>() : std::vector{text}, suite::RunSettings{}, catalog);
  return {own.catalog.parse(own.names.front()).name, own.plugins.front().content};
}

AbSide side_of(const char* name, const std::string& text, SideKind kind,
               const AbArguments& arguments, const DetectorCatalog& catalog) {
  AbSide side = {name, fs::absolute(text), {}, "", ""};
  if (kind == SideKind::kProgram) {
    if (!fs::is_regular_file(side.program) || access(side.program.c_str(), X_OK) != 0) {
      std::vector<std::string> ids;
      for (const DetectorInfo& info : catalog.all()) ids.push_back(info.id);
      const std::string near = suggestion(text, ids);
      throw InputError(std::string(name) + " \"" + text + "\" is not a program that can be run" +
                       (near.empty() ? "" : "; " + near.substr(0, near.size() - 1)));
    }
    side.content = suite::hash_of_file(side.program);
  } else {
    side.program = fs::read_symlink("/proc/self/exe");
    side.flags = {kind == SideKind::kCommand ? "--detector-cmd" : "--detector", text};
    std::tie(side.detector, side.content) = examined(text, kind, catalog);
  }
  for (const std::string& detector : arguments.detectors) {
    if (detector == text)
      throw InputError("--detector " + detector + ": " + name + " is this detector already");
    side.flags.push_back("--detector");
    side.flags.push_back(detector);
    if (names_library(detector))
      side.content += content_of_file(detector.substr(0, detector.find(':')));
  }
  return side;
}

// Base and head. @throws InputError: no program that can be run, no detector that can be used, or
// one of each
std::vector<AbSide> ab_sides(const AbArguments& arguments, const DetectorCatalog& catalog) {
  const std::string base = arguments.base.string(), head = arguments.head.string();
  const SideKind kind = kind_of(base, catalog), other = kind_of(head, catalog);
  const auto what = [](SideKind k) { return k == SideKind::kProgram ? "a program" : "a detector"; };
  // First of all, that there is such a program: a misspelt detector is none.
  std::vector<AbSide> sides = {side_of("base", base, kind, arguments, catalog),
                               side_of("head", head, other, arguments, catalog)};
  if ((kind == SideKind::kProgram) != (other == SideKind::kProgram))
    throw InputError("base \"" + base + "\" is " + what(kind) + " and head \"" + head + "\" is " +
                     what(other) + "; ab compares two programs or two detectors");
  return sides;
}

constexpr auto kPollInterval = std::chrono::milliseconds(20);

/// One of the two builds.
class Build {
 public:
  /// `row`: what the rows of a side that is a detector are called, to be compared.
  Build(const AbSide& side, std::string row, const AbArguments& arguments)
      : name_(side.name),
        program_(side.program),
        out_(fs::absolute(arguments.out) / side.name),
        detector_(side.detector),
        row_(std::move(row)) {
    words_ = {"run", "--quiet", "--processes", "1"};
    if (arguments.frames > 0) add("--frames", std::to_string(arguments.frames));
    words_.insert(words_.end(), side.flags.begin(), side.flags.end());
    add("--out", out_.string());
    words_.insert(words_.end(), arguments.targets.begin(), arguments.targets.end());
  }

  results::Results run() const {
    // What an earlier round, or one that was interrupted, has left must not pass for this one's.
    std::error_code ignored;
    fs::remove(out_ / "results.json", ignored);
    fs::remove_all(out_ / "partial", ignored);
    run_to_the_end();
    results::Results results = results::results_in(out_ / "results.json");
    for (results::Run& run : results.runs) {
      if (run.detector != detector_ || detector_ == row_) continue;
      run.detector = row_;
      // Two detectors may have depths of two kinds, and one of them none.
      run.geometry.depth = run.geometry.normal_deg = {};
    }
    return results;
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
  std::string detector_, row_;
  std::vector<std::string> words_;
};

// Of the scenes that are named, as this program reads them; of files at least the bytes.
std::string scenes_line(const AbArguments& arguments, const DetectorCatalog& catalog) {
  std::string line = "scenes:";
  for (const std::string& target : arguments.targets)
    line += " " + target + " " + content_of_file(target);
  try {
    suite::RunTargets wanted;
    wanted.targets = arguments.targets;
    wanted.frames = arguments.frames;
    wanted.detectors = {judge::kFrameDetector};
    if (!arguments.targets.empty())
      for (const suite::SceneTask& task : suite::plan_run(wanted, catalog).scenes)
        line += " " + task.content;
  } catch (const InputError&) {
    // What it cannot read a program of another version may.
  }
  return line + "\n";
}

// All but the number of rounds: more may be added.
std::string identity_of_ab(const std::vector<AbSide>& sides, const AbArguments& arguments,
                           const DetectorCatalog& catalog) {
  std::string lines;
  for (const AbSide& side : sides) {
    lines += side.name + ": " + side.program.string() + " " + side.content;
    for (const std::string& flag : side.flags) lines += " " + flag;
    lines += "\n";
  }
  lines += scenes_line(arguments, catalog) + "frames: " + std::to_string(arguments.frames) + "\n";
  return suite::identity_of(lines + suite::machine_lines());
}

// Base head, head base, base head, ...: what slows the machine down for a while hits both. Every
// run is a fresh process with results of its own in OUT/base or OUT/head, where the last ones
// stay. `sides`: base and head. `on_round` is called with the number of each round, from 0.
// @throws InputError when a program cannot be started, is refused its input or leaves no results
// that can be read; Interrupted
std::vector<results::AbRound> run_rounds(const std::vector<AbSide>& sides,
                                         const AbArguments& arguments, suite::KeptParts& kept,
                                         const std::function<void(std::size_t)>& on_round) {
  const std::string &old_name = sides.at(0).detector, &new_name = sides.at(1).detector;
  const std::string row = old_name == new_name ? new_name : old_name + " -> " + new_name;
  const Build base(sides.at(0), row, arguments), head(sides.at(1), row, arguments);
  std::vector<results::AbRound> rounds(arguments.rounds);
  for (std::size_t r = 0; r < rounds.size(); ++r) {
    // A round is kept whole: its halves are compared because they ran beside each other.
    const std::string what = "round " + std::to_string(r + 1);
    if (const auto part = kept.take(what)) {
      rounds[r] = {results::from_json(part->at("base")), results::from_json(part->at("head"))};
      continue;
    }
    on_round(r);
    const bool base_first = r % 2 == 0;
    if (base_first) rounds[r].base = base.run();
    rounds[r].head = head.run();
    if (!base_first) rounds[r].base = base.run();
    kept.keep(what, {{"base", results::to_json(rounds[r].base)},
                     {"head", results::to_json(rounds[r].head)}});
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

results::AbSetting setting_of(const AbArguments& arguments, const std::vector<AbSide>& sides) {
  return {arguments.base.string(),
          arguments.head.string(),
          arguments.rounds,
          {arguments.slower_than, arguments.floor_us},
          arguments.accuracy_may_change,
          sides.at(0).detector != sides.at(1).detector};
}

}  // namespace

int ab_command(const AbArguments& arguments, const DetectorCatalog& catalog) {
  const fs::path summary = arguments.github ? required_summary_file() : "";
  const std::vector<AbSide> sides = ab_sides(arguments, catalog);
  check_out(arguments.out);
  const suite::OutLock lock(arguments.out);
  suite::KeptParts kept({arguments.out, identity_of_ab(sides, arguments, catalog),
                         arguments.command_line, arguments.resume, arguments.overwrite},
                        "kept-rounds", [](std::size_t parts) {
                          return "a comparison that did not end has left " +
                                 text::counted(parts, "whole round");
                        });
  process::say_when_interrupted(
      "contactcheck: interrupted; whole rounds are kept: repeat the command with --resume to go "
      "on\n");
  if (arguments.resume && !arguments.quiet)
    std::fprintf(stderr, "resumed: %zu of %s\n", std::min(kept.found(), arguments.rounds),
                 text::counted(arguments.rounds, "round").c_str());
  const std::vector<results::AbRound> rounds =
      run_rounds(sides, arguments, kept, [&](std::size_t round) {
        if (!arguments.quiet)
          std::fprintf(stderr, "round %zu of %zu\n", round + 1, arguments.rounds);
      });
  const results::AbSetting setting = setting_of(arguments, sides);
  const results::AbJudgement judgement = results::judge_ab(rounds, setting.limits);
  std::fputs(results::ab_text(judgement, setting).c_str(), stdout);
  if (arguments.github) tell_github(summary, judgement, setting);
  kept.clear();
  return setting.fails(judgement) ? process::kExitNo : 0;
}

}  // namespace contactcheck::cli
