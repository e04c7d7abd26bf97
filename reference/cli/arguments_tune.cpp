#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"
#include "reference/scene/simulation_spec.h"

namespace contactcheck::cli {
namespace {

constexpr std::uint64_t kMostContacts = std::uint64_t{1} << 53;

void add_error_limits(CLI::App& tune, TuneArguments& arguments) {
  tune.add_option(
          "--max-missed", arguments.max_missed,
          "maximum number of missed contacts over all frames, at the question's level (default 0)")
      ->check(whole_in(0, kMostContacts))
      ->type_name("N");
  tune.add_option("--max-spurious", arguments.max_spurious,
                  "maximum number of spurious contacts (default: any number)")
      ->check(whole_in(0, kMostContacts))
      ->type_name("N");
  tune.add_option("--max-hover", arguments.max_hover,
                  "true distance, in metres, at which contact may first be reported (default: any)")
      ->check(number_in(0.0, 1e9, "0 on"))
      ->type_name("METRES");
  tune.add_option("--max-late", arguments.max_late,
                  "frames that a first report may be late or early (default: any number)")
      ->check(whole_in(0, 1000000))
      ->type_name("N");
  tune.add_option(
          "--max-deviation", arguments.max_deviation,
          "with --lattice or --deformer: how far a vertex may be from where the scene's own model "
          "takes it, in metres (default: any distance)")
      ->check(number_in(0.0, 1e9, "0 on"))
      ->type_name("METRES");
  tune.add_option("--budget-ms", arguments.budget_ms,
                  "what a frame may cost; exit code 1 when nothing is both accurate and cheap "
                  "enough")
      ->check(number_in(0.0, 1e9, "0 on"))
      ->type_name("MS");
}

void add_space(CLI::App& tune, TuneArguments& arguments) {
  tune.add_option(
          "--question", arguments.question,
          "what the detector is for: body (which bodies touch), cells or triangles (default "
          "body)")
      ->check(CLI::IsMember({"body", "cells", "triangles"}));
  tune.add_option("--detector", arguments.detectors,
                  "a detector to try, repeatable; its options are varied, but for those that the "
                  "name sets; default: all that answer the question; with '/' or .so in its name "
                  "a shared library of your own (reference/plugin/README.md)")
      ->allow_extra_args(false);
  add_commands(tune, arguments.commands);
  tune.add_option("--lattice", arguments.lattices,
                  "also try lattices of FACTOR times the scene's cells, repeatable: a coarser "
                  "model is another surface, see --max-deviation")
      ->check(number_in(0.01, 100.0, "0.01 to 100"))
      ->type_name("FACTOR")
      ->allow_extra_args(false);
  std::vector<std::string> deformers = scene::model_names();
  deformers.push_back("all");
  tune.add_option("--deformer", arguments.deformers,
                  "of a simulated scene: try it with bodies deformed by this model too, "
                  "repeatable; every cost is then that of a step, its simulation included")
      ->check(CLI::IsMember(deformers))
      ->allow_extra_args(false);
}

}  // namespace

void add_tune(CommandLine& line) {
  const auto arguments = std::make_shared<TuneArguments>();
  CLI::App* tune = line.app.add_subcommand(
      "tune", "the cheapest detector and options that are accurate enough for a scene");
  tune->add_option("target", arguments->target, "a scene, a scene file or a recording")->required();
  add_error_limits(*tune, *arguments);
  add_space(*tune, *arguments);
  tune->add_option(
          "--frames", arguments->frames,
          "frames to choose by (default: the scene's, at most 30; of a simulated scene half of "
          "its own); the choice is confirmed on others")
      ->check(whole_in(4, 100000));
  tune->add_option("--processes", arguments->processes,
                   "passes through the frames, each in a fresh process (default 5)")
      ->check(whole_in(1, 100));
  CLI::Option* most =
      tune->add_option("--most", arguments->most,
                       "measurements at most, those that are made again too (default: no limit)")
          ->check(whole_in(1, 1000000));
  tune->add_flag("--exhaustive", arguments->exhaustive, "measure every configuration")
      ->excludes(most);
  add_limits(*tune, arguments->call_limit, arguments->memory_limit_mib);
  tune->add_option("--out", arguments->out,
                   "folder for tune.json, tune.md and chosen.json, which run takes (default out)");
  tune->add_flag("--quiet", arguments->quiet, "no progress, no tables");
  tune->footer(
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
