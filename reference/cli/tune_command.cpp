#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/own_detectors.h"
#include "reference/process/exit_codes.h"
#include "reference/process/interrupts.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/simulation_spec.h"
#include "reference/suite/kept_work.h"
#include "reference/suite/out_lock.h"
#include "reference/suite/run_identity.h"
#include "reference/text/counted.h"
#include "reference/tune/chosen_file.h"
#include "reference/tune/tune_text.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

fs::path scene_file(const std::string& name) {
  const scene::Target target = scene::find_target(name, scene::fixtures_directory());
  if (target.kind == scene::TargetKind::kSuite)
    throw InputError("\"" + name + "\" is a suite; tune takes one scene");
  return target.file;
}

Question question_named(const std::string& name) {
  for (const Question question : {Question::kTriangles, Question::kCells})
    if (name == name_of(question)) return question;
  return Question::kBody;
}

tune::Limits limits_of(const TuneArguments& arguments) {
  tune::Limits limits;
  limits.missed = arguments.max_missed.value_or(0);
  limits.spurious = arguments.max_spurious;
  limits.hover = arguments.max_hover;
  limits.late_frames = arguments.max_late;
  limits.deviation = arguments.max_deviation;
  return limits;
}

suite::RunSettings settings_of(const TuneArguments& arguments) {
  suite::RunSettings settings;
  settings.processes = arguments.processes;
  settings.one_pass_beyond = 0.0;  // pairs need as many passes of all
  settings.call_limit = arguments.call_limit;
  settings.memory_limit = arguments.memory_limit_mib << 20;
  return settings;
}

std::vector<std::string> deformers_of(const TuneArguments& arguments) {
  std::vector<std::string> deformers;
  for (const std::string& name : arguments.deformers) {
    if (name == "all") return scene::model_names();
    if (std::find(deformers.begin(), deformers.end(), name) == deformers.end())
      deformers.push_back(name);
  }
  return deformers;
}

tune::TuningRequest make_request(const TuneArguments& arguments, const OwnDetectors& own) {
  tune::TuningRequest request;
  request.target = arguments.target;
  request.scene_file = scene_file(arguments.target);
  request.space.question = question_named(arguments.question);
  request.space.detectors = own.names;
  std::vector<double>& lattices = request.space.lattices;  // the scene's own is there
  for (const double lattice : arguments.lattices)
    if (std::find(lattices.begin(), lattices.end(), lattice) == lattices.end())
      lattices.push_back(lattice);
  request.deformers = deformers_of(arguments);
  for (const plugin::Plugin& plugin : own.plugins)
    (plugin.source.kind == plugin::PluginKind::kLibrary ? request.libraries
                                                        : request.commands)[plugin.declaration.id] =
        plugin.source.text;
  request.limits = limits_of(arguments);
  request.budget_ms = arguments.budget_ms;
  request.search.most = arguments.most;
  request.exhaustive = arguments.exhaustive;
  request.frames = arguments.frames;
  request.settings = settings_of(arguments);
  request.settings.plugins = own.records();
  request.settings.plugin_ids = own.ids();
  request.out = arguments.out;
  request.executable = fs::read_symlink("/proc/self/exe");
  request.known_defects = results::read_known_defects(hard_cases_folder());
  request.command = arguments.command_line;
  return request;
}

// Everything that a search goes by.
std::string identity_of_search(const TuneArguments& arguments, const OwnDetectors& own,
                               const tune::TuningRequest& request) {
  std::string words = arguments.command_line + " ";
  for (const std::string flag : {" --resume ", " --overwrite ", " --quiet "})
    for (std::size_t at; (at = words.find(flag)) != std::string::npos;)
      words.replace(at, flag.size(), " ");
  std::string lines =
      "words: " + words + "\nscene: " +
      suite::content_of(request.scene_file, scene::load_any_scene(request.scene_file)) + "\n";
  for (const plugin::Plugin& plugin : own.plugins)
    lines += plugin.declaration.id + ": " + plugin.content + "\n";
  for (const auto& [setting, value] : suite::named_settings(request.settings))
    lines += setting + ": " + value + "\n";
  return suite::identity_of(lines + suite::machine_lines());
}

// A line that is overwritten on a terminal, one per step elsewhere.
void show(const tune::TuningProgress& progress) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const std::string what =
      !progress.simulating.empty() ? "simulating with " + progress.simulating
      : progress.confirming
          ? "confirming on held-out frames"
          : std::to_string(progress.measured) + " of " + std::to_string(progress.candidates) +
                " configurations measured" +
                (progress.best.empty() ? "" : "; cheapest so far: " + progress.best);
  std::fprintf(stderr, terminal ? "\r\033[K%s" : "%s\n", what.c_str());
  std::fflush(stderr);
}

// What tune.json names is there before it.
void write_files(const tune::Tuning& tuning, const tune::TuningRequest& request) {
  if (tuning.chosen)
    write_file_atomically(tune::chosen_file(request), tune::chosen_suite(tuning, request));
  write_file_atomically(request.out / "tune.json", tune::to_json(tuning, request).dump(1) + "\n");
  write_file_atomically(request.out / "tune.md", tune::tuning_markdown(tuning, request));
}

}  // namespace

int tune_command(const TuneArguments& arguments, const DetectorCatalog& catalog) {
  const OwnDetectors own =
      load_own_detectors(arguments.detectors, arguments.commands, settings_of(arguments), catalog);
  tune::TuningRequest request = make_request(arguments, own);
  check_out(arguments.out);
  const suite::OutLock lock(arguments.out);
  suite::KeptParts kept({arguments.out, identity_of_search(arguments, own, request),
                         arguments.command_line, arguments.resume, arguments.overwrite},
                        "kept-runs", [](std::size_t parts) {
                          return "a search that did not end has left " +
                                 text::counted(parts, "measured run");
                        });
  process::say_when_interrupted(
      "contactcheck: interrupted; measured runs are kept: repeat the command with --resume to go "
      "on\n");
  if (arguments.resume && !arguments.quiet)
    std::fprintf(stderr, "resumed: %s\n", text::counted(kept.found(), "measured run").c_str());
  request.kept = &kept;
  const tune::Tuning tuning =
      tune::tune(request, own.catalog, [&](const tune::TuningProgress& progress) {
        if (!arguments.quiet) show(progress);
      });
  if (!arguments.quiet && isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
  write_files(tuning, request);
  kept.clear();
  if (!arguments.quiet) std::printf("%s\n", tune::tuning_text(tuning, request).c_str());
  std::printf("%s  %s%s%s\n", (arguments.out / "tune.json").c_str(),
              (arguments.out / "tune.md").c_str(), tuning.chosen ? "  " : "",
              tuning.chosen ? tune::chosen_file(request).c_str() : "");
  return tuning.within_budget(request.budget_ms) ? 0 : process::kExitNo;
}

}  // namespace contactcheck::cli
