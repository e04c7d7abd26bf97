#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <set>
#include <utility>

#include "core/deform/atomic_file.h"
#include "core/detect/registry.h"
#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/event_lines.h"
#include "reference/cli/own_detectors.h"
#include "reference/cli/progress_display.h"
#include "reference/cli/report_folder.h"
#include "reference/cli/run_and_report.h"
#include "reference/cli/run_tasks.h"
#include "reference/report/report_files.h"
#include "reference/report/terminal.h"
#include "reference/run/exit_codes.h"
#include "reference/run/interrupts.h"
#include "reference/run/out_lock.h"
#include "reference/run/run_identity.h"
#include "reference/run/suite_run.h"
#include "reference/run/worker.h"
#include "reference/scene/any_scene.h"
#include "reference/scene/scene.h"
#include "reference/simulate/simulate_scene.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;

void check_simulation_of(const SceneTask& task, const DetectorCatalog& catalog,
                         const Scene& scene) {
  try {
    check_simulation(catalog, scene);
  } catch (const InputError& e) {
    throw InputError((task.file.empty() ? "" : task.file.string() + ": ") + e.what());
  }
}

void read_scene(std::size_t frames, const DetectorCatalog& catalog, SceneTask& task) {
  if (task.pairs) {
    task.id = kPairsSceneId;
    task.content = content_of(*task.pairs);
    task.frames = RandomPairs(*task.pairs).frames();
    return;
  }
  const Scene scene =
      task.text ? load_scene_text(*task.text, frames) : load_any_scene(task.file, frames);
  check_simulation_of(task, catalog, scene);
  task.id = scene.id;
  task.frames = scene.frames;
  task.content = task.text ? content_of(*task.text, scene) : content_of(task.file, scene);
}

// Every scene is read before anything runs: a bad one ends the run before it has written a byte.
void check_scenes(std::size_t frames, const DetectorCatalog& catalog,
                  std::vector<SceneTask>& tasks) {
  std::set<std::string> ids;
  for (SceneTask& task : tasks) {
    read_scene(frames, catalog, task);
    if (!ids.insert(task.id).second)
      throw InputError("two scenes of this run have the id \"" + task.id + "\"");
  }
}

void print_outcome(const RunArguments& arguments, const ReportedRun& run_and_reports) {
  const results::Results& results = run_and_reports.results;
  if (!arguments.quiet) {
    const std::string tables = terminal_tables(results, isatty(STDOUT_FILENO) != 0);
    std::fwrite(tables.data(), 1, tables.size(), stdout);
  }
  for (const results::Run& run : results.runs)
    if (run.status == results::Status::kAbsent)
      std::printf("absent: %s: %s\n", run.detector.c_str(), run.message.c_str());
  if (results.resumed)
    for (const std::string& scene : *results.resumed)
      std::printf("resumed: %s: finished by an earlier run\n", scene.c_str());
  std::printf("%s%s  %s\n", arguments.quiet ? "" : "\n", (arguments.out / "results.json").c_str(),
              run_and_reports.reports.c_str());
}

/// Shows a run's progress to people and to machines.
class Watcher {
 public:
  explicit Watcher(const RunArguments& arguments)
      : display(arguments.quiet, isatty(STDERR_FILENO) != 0), events(arguments.json_lines) {}

  SuiteListener listener() {
    return {[this](const SuiteProgress& progress) { show(progress); },
            [this](const SceneEnd& end) {
              if (events.wanted()) events.print(scene_event(end));
            }};
  }

  ProgressDisplay display;
  EventLines events;

 private:
  void show(const SuiteProgress& progress) {
    const Clock::time_point now = Clock::now();
    // Scenes that are taken over from an earlier run took no time.
    if (!first_share_) first_share_ = progress.share;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const auto left = seconds_left(elapsed, *first_share_, progress.share);
    display.show(progress, left);
    events.progress(progress, left);
  }

  using Clock = std::chrono::steady_clock;
  const Clock::time_point start_ = Clock::now();
  std::optional<double> first_share_;
};

// After all scenes were read: shards of one run know the same scenes.
void take_shard(const Shard& shard, SuiteRequest& request) {
  request.shard = ShardOfRun{shard, std::move(request.tasks)};
  const std::vector<SceneTask>& run = request.shard->run;
  if (run.size() < shard.of)
    throw InputError("--shard " + shard.name() + ": this run has " + std::to_string(run.size()) +
                     (run.size() == 1 ? " scene" : " scenes") +
                     ", and a scene is run in one piece: at most so many shards are possible");
  request.tasks.clear();
  for (std::size_t i = 0; i < run.size(); ++i)
    if (shard.holds(i)) request.tasks.push_back(run[i]);
}

RunSettings settings_of(const RunArguments& arguments) {
  RunSettings settings;
  settings.frames = arguments.frames;
  settings.step_repeats = arguments.step_repeats;
  settings.seed = arguments.seed;
  if (arguments.processes) {
    settings.processes = *arguments.processes;
    settings.one_pass_beyond = 0.0;
  }
  settings.timing = arguments.timing;
  settings.closed_loop = arguments.closed_loop;
  settings.threads = arguments.threads;
  settings.call_limit = arguments.call_limit;
  settings.memory_limit = arguments.memory_limit_mib << 20;
  return settings;
}

RunArguments with_names(RunArguments arguments, const std::vector<std::string>& names) {
  arguments.detectors = names;
  return arguments;
}

// Somebody may have worked on a file that is there.
void save_scene(const fs::path& file, const std::vector<SceneTask>& tasks) {
  if (file.empty()) return;
  for (const SceneTask& task : tasks) {
    if (!task.text) continue;
    if (!fs::exists(file)) {
      write_file_atomically(file, task.text->text);
    } else if (read_text_file(file) != task.text->text) {
      throw InputError("--save-scene: \"" + file.string() +
                       "\" is there already and is not written over");
    }
  }
}

SuiteRequest make_request(const RunArguments& arguments, const DetectorCatalog& catalog) {
  SuiteRequest request;
  request.settings = settings_of(arguments);
  const OwnDetectors own =
      bring_in(arguments.detectors, arguments.commands, request.settings, catalog);
  request.settings.plugins = own.records();
  request.settings.plugin_ids = own.ids();
  request.plugins = plugins_in_results(own.plugins);
  RunTasks tasks = make_tasks(with_names(arguments, own.names), own.catalog);
  request.tasks = std::move(tasks.scenes);
  request.goals = std::move(tasks.goals);
  check_scenes(arguments.frames, own.catalog, request.tasks);
  if (arguments.shard) take_shard(*arguments.shard, request);
  check_out(arguments.out);
  save_scene(arguments.save_scene, request.shard ? request.shard->run : request.tasks);
  request.resume = arguments.resume;
  request.out = arguments.out;
  request.executable = fs::read_symlink("/proc/self/exe");
  request.command = arguments.command_line;
  request.known_defects = read_known_defects(known_defects_file());
  return request;
}

}  // namespace

int exit_code_of(const SuiteOutcome& outcome) {
  if (outcome.oracle_wrong > 0) {
    std::fprintf(stderr,
                 "contactcheck: internal error: rational arithmetic contradicts the oracle on %llu "
                 "random pairs; results.json names the cases\n",
                 static_cast<unsigned long long>(outcome.oracle_wrong));
    return kExitInternal;
  }
  return outcome.unlisted_error ? kExitUnlistedError : 0;
}

ReportedRun run_and_report(const RunArguments& arguments, const DetectorCatalog& catalog,
                           SuiteOutcome* outcome) {
  const SuiteRequest request = make_request(arguments, catalog);
  OutLock lock(request.out);
  Watcher watcher(arguments);
  watcher.events.print(start_event(request));
  results::Results results = run_suite(request, watcher.listener(), outcome);
  watcher.display.finish();
  const auto files = report_texts(results, arguments.out, all_report_formats());
  write_report(arguments.out, files);
  return {std::move(results), report_paths(arguments.out, files), std::move(lock)};
}

int run_command(const RunArguments& arguments, const DetectorCatalog& catalog) {
  say_when_interrupted(
      "contactcheck: interrupted; finished scenes are kept: repeat the command with --resume to "
      "continue\n");
  SuiteOutcome outcome;
  const ReportedRun reported = run_and_report(arguments, catalog, &outcome);
  const int code = exit_code_of(outcome);
  if (arguments.json_lines) {
    EventLines(true).print(end_event(arguments.out, code));
  } else {
    print_outcome(arguments, reported);
  }
  return code;
}

}  // namespace contactcheck
