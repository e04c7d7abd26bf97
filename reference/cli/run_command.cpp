#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/event_lines.h"
#include "reference/cli/own_detectors.h"
#include "reference/cli/progress_display.h"
#include "reference/cli/report_folder.h"
#include "reference/cli/run_and_report.h"
#include "reference/process/exit_codes.h"
#include "reference/process/interrupts.h"
#include "reference/reduce/defect_search.h"
#include "reference/report/formats/terminal.h"
#include "reference/results/rerun.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/scene.h"
#include "reference/suite/drawn_targets.h"
#include "reference/suite/out_lock.h"
#include "reference/suite/run_plan.h"
#include "reference/suite/suite_run.h"
#include "reference/suite/worker.h"
#include "reference/text/counted.h"
#include "reference/text/file_text.h"
#include "reference/text/json_value.h"
#include "reference/text/lists.h"
#include "reference/text/shell_word.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

/// What `reduce` could make small, and what it is.
struct Reducible {
  std::string detector, sentence;
  fs::path target;
};

// Wrong answers, then errors that ended the judging of a frame: `reduce` asks frames, not steps.
std::vector<Reducible> reducible(const results::Results& results, const fs::path& out) {
  std::vector<Reducible> found;
  for (const results::Disagreement& d : results.disagreements)
    if (d.detector != "oracle" && reduce::can_be_reduced(d.level))
      found.push_back({d.detector,
                       (d.kind == "missed" ? "missed a" : "reported a spurious") +
                           (" contact in " + d.scene) + ", frame " + std::to_string(d.frame) +
                           ", level " + d.level,
                       out / d.case_file});
  for (const results::Run& run : results.runs) {
    if (!results::failed_in_a_frame(run)) continue;
    const std::string frame = std::to_string(*run.failed_frame);
    found.push_back({run.detector, "gave no answer in " + run.scene + ", frame " + frame,
                     (out / run.recording).string() + "@" + frame});
  }
  return found;
}

// The first that can be reduced; one of a plug-in before all others. A case names its detector, but
// for a plug-in the command must load it, and a recording names none.
void print_next(const RunArguments& arguments, const results::Results& results) {
  const std::vector<Reducible> all = reducible(results, arguments.out);
  const auto first = [&](bool of_plugins) {
    return std::find_if(all.begin(), all.end(), [&](const Reducible& one) {
      const results::Plugin* const plugin = results.plugin_of(one.detector);
      return of_plugins ? plugin != nullptr && !plugin->transient : plugin == nullptr;
    });
  };
  auto next = first(true);
  if (next == all.end()) next = first(false);
  if (next == all.end()) return;
  const bool named =
      results.plugin_of(next->detector) == nullptr && next->target.extension() == ".json";
  std::string words = named ? "" : " " + results::detector_words(results, next->detector);
  // Who waits less for an answer need not wait longer for each of many.
  if (arguments.call_limit < ReduceArguments{}.call_limit)
    words += " --call-limit " + text::shown(arguments.call_limit);
  // As it was called: after a build it is on no path.
  std::printf("%s %s\nnext: %s reduce %s%s\n", next->detector.c_str(), next->sentence.c_str(),
              text::in_shell(program_invocation_name).c_str(),
              text::in_shell(next->target.string()).c_str(), words.c_str());
}

void print_outcome(const RunArguments& arguments, const ReportedRun& run_and_reports) {
  const results::Results& results = run_and_reports.results;
  if (!arguments.quiet) {
    const std::string tables =
        report::terminal_tables(results, isatty(STDOUT_FILENO) != 0, arguments.explain);
    std::fwrite(tables.data(), 1, tables.size(), stdout);
  }
  for (const results::Run& run : results.runs)
    if (run.status == results::Status::kAbsent)
      std::printf("absent: %s: %s\n", run.detector.c_str(), run.message.c_str());
  std::printf("%s%s  %s\n", arguments.quiet ? "" : "\n", (arguments.out / "results.json").c_str(),
              run_and_reports.reports.c_str());
  if (!arguments.quiet && !arguments.reduce) print_next(arguments, results);
}

/// Shows a run's progress to people and to machines.
class Watcher {
 public:
  Watcher(const RunArguments& arguments, std::size_t scenes)
      : display(arguments.quiet, isatty(STDERR_FILENO) != 0),
        events(arguments.json_lines),
        out_(arguments.out),
        scenes_(scenes) {}

  suite::SuiteListener listener() {
    suite::SuiteListener out;
    out.resumed = [this](const std::vector<std::string>& ids) { say_resumed(ids); };
    out.progress = [this](const suite::SuiteProgress& progress) { show(progress); };
    out.scene_end = [this](const suite::SceneEnd& end) {
      if (events.wanted()) events.print(scene_event(end));
    };
    return out;
  }

  ProgressDisplay display;
  EventLines events;

 private:
  // Also where nothing else is said: whoever resumes wants to know that there was something.
  void say_resumed(const std::vector<std::string>& ids) const {
    constexpr std::size_t kMost = 5;
    if (ids.empty())
      std::fprintf(stderr, "resumed: nothing: no scene of this run is finished in %s\n",
                   out_.c_str());
    else
      std::fprintf(stderr, "resumed: %zu of %s, finished in %s: %s\n", ids.size(),
                   text::counted(scenes_, "scene").c_str(), out_.c_str(),
                   text::shortened(ids, kMost).c_str());
  }
  void show(const suite::SuiteProgress& progress) {
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
  fs::path out_;
  std::size_t scenes_;
};

// A run records its frames: these alone would take the place of all.
void keep_recordings(const RunArguments& arguments, const std::vector<suite::SceneTask>& tasks) {
  for (const suite::SceneTask& task : tasks) {
    const auto* file = std::get_if<fs::path>(&task.source);
    std::error_code ignored;
    if (arguments.frames > 0 && file != nullptr && file->extension() == ".ccr" &&
        fs::equivalent(*file, arguments.out / "recordings" / (task.id + ".ccr"), ignored))
      throw InputError("--frames: " + text::in_quotes(file->string()) +
                       " would lose its other frames; name another --out");
  }
}

// After all scenes were read: shards of one run know the same scenes.
void take_shard(const suite::Shard& shard, suite::SuiteRequest& request) {
  request.shard = suite::ShardOfRun{shard, std::move(request.tasks)};
  const std::vector<suite::SceneTask>& run = request.shard->run;
  if (run.size() < shard.of)
    throw InputError("--shard " + shard.name() + ": this run has " +
                     text::counted(run.size(), "scene") +
                     ", and a scene is run in one piece: at most so many shards are possible");
  request.tasks.clear();
  for (std::size_t i = 0; i < run.size(); ++i)
    if (shard.holds(i)) request.tasks.push_back(run[i]);
}

suite::RunSettings settings_of(const RunArguments& arguments) {
  suite::RunSettings settings;
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

// With the detectors of --detectors, which run before those named.
suite::RunTargets with_names(const RunArguments& arguments, const std::vector<std::string>& names) {
  suite::RunTargets out = arguments;
  out.detectors.clear();
  if (!arguments.detectors_of.empty()) out.detectors = suite::detectors_of(arguments.detectors_of);
  out.detectors.insert(out.detectors.end(), names.begin(), names.end());
  return out;
}

const std::vector<suite::SceneTask>& whole_run(const suite::SuiteRequest& request) {
  return request.shard ? request.shard->run : request.tasks;
}

suite::SuiteRequest make_request(const RunArguments& arguments, const DetectorCatalog& catalog) {
  suite::SuiteRequest request;
  request.settings = settings_of(arguments);
  const OwnDetectors own =
      load_own_detectors(arguments.detectors, arguments.commands, request.settings, catalog);
  request.settings.plugins = own.records();
  request.settings.plugin_ids = own.ids();
  request.plugins = plugin::plugins_in_results(own.plugins);
  suite::RunPlan plan = suite::plan_run(with_names(arguments, own.names), own.catalog);
  request.tasks = std::move(plan.scenes);
  request.goals = std::move(plan.goals);
  keep_recordings(arguments, request.tasks);
  if (arguments.shard) take_shard(*arguments.shard, request);
  check_out(arguments.out);
  suite::save_scenes(arguments.save_scene, whole_run(request), request.tasks);
  request.resume = arguments.resume;
  request.overwrite = arguments.overwrite;
  request.out = arguments.out;
  request.executable = fs::read_symlink("/proc/self/exe");
  request.command = arguments.command_line;
  request.known_defects = results::read_known_defects(hard_cases_folder());
  return request;
}

}  // namespace

int exit_code_of(const suite::SuiteOutcome& outcome) {
  if (outcome.oracle_wrong > 0) {
    std::fprintf(stderr,
                 "contactcheck: internal error: rational arithmetic contradicts the oracle on %llu "
                 "random pairs; results.json names the cases\n",
                 static_cast<unsigned long long>(outcome.oracle_wrong));
    return process::kExitInternal;
  }
  return outcome.unlisted_error ? process::kExitUnlistedError : 0;
}

ReportedRun run_and_report(const RunArguments& arguments, const DetectorCatalog& catalog,
                           suite::SuiteOutcome* outcome) {
  const suite::SuiteRequest request = make_request(arguments, catalog);
  suite::OutLock lock(request.out);
  const bool of_meshes = std::any_of(whole_run(request).begin(), whole_run(request).end(),
                                     [](const suite::SceneTask& task) {
                                       return std::holds_alternative<scene::SceneText>(task.source);
                                     });
  if (of_meshes && !arguments.quiet && !arguments.json_lines)
    for (const std::string& note : scene::mesh_notes(arguments.meshes))
      std::fprintf(stderr, "%s\n", note.c_str());
  Watcher watcher(arguments, request.tasks.size());
  watcher.events.print(start_event(request));
  results::Results results = suite::run_suite(request, watcher.listener(), outcome);
  watcher.display.finish();
  suite::save_redrawn(arguments.save_scene, whole_run(request), request.tasks, results);
  const auto files = report_texts(results, arguments.out, all_report_formats());
  write_report(arguments.out, files);
  return {std::move(results), report_paths(arguments.out, files), std::move(lock)};
}

int run_command(const RunArguments& arguments, const DetectorCatalog& catalog) {
  // By itself it is a question, not a run of the suite `default`.
  if (arguments.explain && arguments.targets.empty() && arguments.meshes.meshes.empty() &&
      arguments.detectors.empty() && arguments.commands.empty() && !arguments.pairs) {
    std::fputs(report::column_legend().c_str(), stdout);
    return 0;
  }
  process::say_when_interrupted(
      "contactcheck: interrupted; finished scenes are kept: repeat the command with --resume to "
      "continue\n");
  suite::SuiteOutcome outcome;
  const ReportedRun reported = run_and_report(arguments, catalog, &outcome);
  const int code = exit_code_of(outcome);
  if (!arguments.json_lines) print_outcome(arguments, reported);
  if (arguments.reduce) reduce_first_errors(reported.results, arguments, catalog);
  if (arguments.json_lines) EventLines(true).print(end_event(arguments.out, code));
  return code;
}

}  // namespace contactcheck::cli
