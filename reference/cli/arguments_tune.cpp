#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"
#include "reference/scene/scene.h"
#include "reference/scene/simulation_spec.h"

namespace contactcheck::cli {
namespace {

constexpr std::uint64_t kMostContacts = std::uint64_t{1} << 53;

void add_error_limits(CLI::App& tune, TuneArguments& arguments) {
  tune.add_option("--max-missed", arguments.max_missed,
                  "maximum number of missed contacts (default 0)")
      ->check(whole_in(0, kMostContacts))
      ->type_name("N");
  tune.add_option("--max-spurious", arguments.max_spurious, "maximum number of spurious contacts")
      ->check(whole_in(0, kMostContacts))
      ->type_name("N");
  tune.add_option("--max-hover", arguments.max_hover,
                  "largest true distance at first report (default: any)")
      ->check(number_in(0.0, 1e9, "0 on"))
      ->type_name("METRES");
  tune.add_option("--max-late", arguments.max_late, "frames a first report may be late or early")
      ->check(whole_in(0, 1000000))
      ->type_name("N");
  tune.add_option("--max-deviation", arguments.max_deviation,
                  "largest vertex offset by another --lattice or --deformer")
      ->check(number_in(0.0, 1e9, "0 on"))
      ->type_name("METRES");
  tune.add_option("--budget-ms", arguments.budget_ms, "largest cost of a frame")
      ->check(number_in(0.0, 1e9, "0 on"))
      ->type_name("MS");
}

void add_space(CLI::App& tune, TuneArguments& arguments) {
  tune.add_option("--question", arguments.question, "body, cells or triangles (default body)")
      ->check(CLI::IsMember({"body", "cells", "triangles"}))
      ->type_name("NAME");
  tune.add_option("--detector", arguments.detectors,
                  "detector to try, repeatable; FILE.so is a plug-in (default: all)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  add_commands(tune, arguments.commands);
  tune.add_option("--lattice", arguments.lattices,
                  "try FACTOR times the scene's cells, too, repeatable")
      ->check(number_in(0.01, 100.0, "0.01 to 100"))
      ->type_name("FACTOR")
      ->allow_extra_args(false);
  std::vector<std::string> deformers = scene::model_names();
  deformers.push_back("all");
  tune.add_option("--deformer", arguments.deformers,
                  "simulated scene: try this deformer, too, or all")
      ->check(CLI::IsMember(deformers))
      ->type_name("NAME")
      ->allow_extra_args(false);
}

}  // namespace

void add_tune(CommandLine& line) {
  const auto arguments = std::make_shared<TuneArguments>();
  CLI::App* tune = line.app.add_subcommand(
      "tune", "Finds the cheapest detector and options that are accurate enough");
  tune->add_option("target", arguments->target, "scene, scene file or recording")->required();
  add_error_limits(*tune, *arguments);
  add_space(*tune, *arguments);
  tune->add_option("--frames", arguments->frames, "frames to choose by (default: at most 30)")
      ->check(whole_in(4, scene::kMostFrames));
  tune->add_option("--processes", arguments->processes,
                   "passes, each in a fresh process (default 5)")
      ->check(whole_in(1, 100));
  CLI::Option* most =
      tune->add_option("--most", arguments->most, "maximum number of measurements (default: any)")
          ->check(whole_in(1, 1000000));
  tune->add_flag("--exhaustive", arguments->exhaustive, "measure every configuration")
      ->excludes(most);
  add_limits(*tune, arguments->call_limit, arguments->memory_limit_mib);
  tune->add_option("--out", arguments->out,
                   "folder for tune.json, tune.md, chosen.json (default out)")
      ->type_name("DIR");
  tune->add_flag("--resume", arguments->resume,
                 "take over what an interrupted search in --out has measured");
  tune->add_flag("--overwrite", arguments->overwrite, "discard that");
  tune->add_flag("--quiet", arguments->quiet, "print no progress and no tables");
  tune->footer(
      "A detector's options are varied, except those that its name sets. The choice is confirmed\n"
      "on other frames. With --deformer every cost is that of a step, its simulation included.\n"
      "Exit code 1 when nothing meets the limits.\n"
      "Examples:\n"
      "  contactcheck tune bunny-touch --max-missed 0 --max-hover 0.005\n"
      "  contactcheck tune mine.json --detector ffd-aabb-sphere2 --lattice 0.5 --max-deviation "
      "0.01\n"
      "  contactcheck tune paper-rabbit --deformer all --question triangles\n"
      "  contactcheck tune out/recordings/paper-rabbit.ccr --question triangles --budget-ms 2");
  choose(*tune, line, [arguments, &line] {
    arguments->command_line = line.words;
    return tune_command(*arguments, line.catalog);
  });
}

}  // namespace contactcheck::cli
