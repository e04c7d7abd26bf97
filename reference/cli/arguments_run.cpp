#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "core/types/check.h"
#include "reference/cli/arguments.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/scene/amount.h"
#include "reference/scene/drawn_scene.h"
#include "reference/scene/scene.h"
#include "reference/text/file_text.h"

namespace contactcheck::cli {
namespace {

// The options of `run` that make a scene out of mesh files.

constexpr double kLargestSize = 1e6;  // metres, as in scene files

std::optional<double> size_of(const std::string& text) {
  if (text == "file") return std::nullopt;
  const std::optional<double> size = scene::parse_double(text);
  if (!size || !(*size > 0.0) || !(*size <= kLargestSize))
    throw InputError("--size: " + text::in_quotes(text) +
                     " is neither \"file\" nor a number of metres above 0, at most 1000000");
  return size;
}

struct RunWords {
  RunArguments run;
  bool no_timing = false;
  std::uint64_t pairs = 0;
  std::string needs_mesh;  ///< an option that is for meshes alone and was given

  RunArguments arguments() const {
    RunArguments out = run;
    out.timing = !no_timing;
    if (pairs > 0) out.pairs = scene::PairSpec{pairs, run.seed};
    // A mesh file among the targets is one of --mesh.
    std::vector<std::string> targets;
    for (const std::string& target : run.targets)
      if (names_mesh(target))
        out.meshes.meshes.emplace_back(target);
      else
        targets.push_back(target);
    out.targets = targets;
    if (!needs_mesh.empty() && out.meshes.meshes.empty())
      throw InputError(needs_mesh + " requires --mesh or a mesh file");
    return out;
  }
};

// --mesh, --motion, --size, --repair, --save-scene. `words` must outlive the parsing.
void add_mesh_options(CLI::App& run, RunWords& words) {
  scene::MeshSceneRequest& request = words.run.meshes;
  run.add_option_function<std::vector<std::string>>(
         "--mesh",
         [&request](const std::vector<std::string>& files) {
           request.meshes.assign(files.begin(), files.end());
         },
         "mesh file; also without --mesh")
      ->allow_extra_args(false)
      ->type_name("FILE");
  run.add_option_function<std::string>(
         "--motion",
         [&words](const std::string& name) {
           words.run.meshes.motion = name;
           words.needs_mesh = "--motion";
         },
         "approach (default), press, twist, pass; of one mesh: fold, twist")
      ->type_name("NAME");
  run.add_option_function<std::string>(
         "--size",
         [&words](const std::string& text) {
           words.run.meshes.size = size_of(text);
           words.needs_mesh = "--size";
         },
         "largest side of each mesh, or file: as in the file (default 1)")
      ->type_name("METRES");
  run.add_flag_callback(
      "--repair",
      [&words] {
        words.run.meshes.repair = true;
        words.needs_mesh = "--repair";
      },
      "fill polygons of --mesh that cross themselves with fans");
  run.add_option("--save-scene", words.run.save_scene,
                 "keep the scenes as scene files; nothing is overwritten")
      ->type_name("PATH");
}

void add_threads(CLI::App& command, std::uint32_t& threads) {
  command.add_option("--threads", threads, "threads of detectors and of deformation (default 1)")
      ->check(whole_in(1, 256));
}

void add_pairs(CLI::App& run, RunWords& words) {
  run.add_option("--pairs", words.pairs, "add N random hard triangle pairs as scene random-pairs")
      ->check(whole_in(1, scene::kMostPairs))
      ->type_name("N");
  run.add_option("--seed", words.run.seed, "seed of all that is random (default 1)")
      ->check(whole_in(0, scene::kLargestPairSeed))
      ->type_name("S");
}

void add_count(CLI::App& run, RunWords& words) {
  run.add_option_function<std::size_t>(
         "--count", [&words](const std::size_t& count) { words.run.count = count; },
         "number of drawn scenes (default 20)")
      ->check(whole_in(1, scene::kMostDrawnScenes))
      ->type_name("N");
  run.add_flag("--steps", words.run.steps, "drawn scenes are judged between frames");
}

// `arguments` must outlive the command.
void add_resume(CLI::App& run, RunArguments& arguments) {
  run.add_flag("--resume", arguments.resume,
               "take over the scenes that an earlier run has finished in --out");
  run.add_flag("--overwrite", arguments.overwrite,
               "discard what an interrupted run has finished in --out");
}

// `arguments` must outlive the command.
void add_shard(CLI::App& run, RunArguments& arguments) {
  run.add_option_function<std::string>(
         "--shard",
         [&arguments](const std::string& text) { arguments.shard = suite::parse_shard(text); },
         "run only shard K of N; merge assembles the results")
      ->type_name("K/N");
}

}  // namespace

void add_run(CommandLine& line) {
  const auto words = std::make_shared<RunWords>();
  RunArguments& arguments = words->run;
  arguments.command_line = line.words;
  CLI::App* run =
      line.app.add_subcommand("run", "Runs detectors on scenes and judges every answer");
  run->add_option("targets", arguments.targets,
                  "suites, scenes, .json, .ccr or mesh files (default: default)");
  run->add_option("--detector", arguments.detectors,
                  "detector, repeatable; FILE.so is a plug-in (default: the suite's)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  run->add_option("--detectors", arguments.detectors_of, "add the detectors of this suite")
      ->type_name("SUITE");
  add_commands(*run, arguments.commands);
  run->add_option("--frames", arguments.frames, "frames per scene, same duration")
      ->check(whole_in(1, scene::kMostFrames));
  run->add_option("--processes", arguments.processes,
                  "timed passes, each in a fresh process (default 3)")
      ->check(whole_in(1, 100))
      ->type_name("N");
  run->add_option("--out", arguments.out, "folder for all files (default out)")->type_name("DIR");
  run->add_flag("--closed-loop", arguments.closed_loop,
                "simulated scenes: every detector drives the simulation, too");
  add_threads(*run, arguments.threads);
  run->add_option("--isa", arguments.isas, "instruction set, repeatable (default: the best)")
      ->allow_extra_args(false)
      ->type_name("NAME");
  add_mesh_options(*run, *words);
  add_pairs(*run, *words);
  add_count(*run, *words);
  add_limits(*run, arguments.call_limit, arguments.memory_limit_mib);
  run->add_flag("--no-timing", words->no_timing, "judge only");
  run->add_flag("--reduce", arguments.reduce,
                "make minimal cases of each detector's first wrong answers");
  add_resume(*run, arguments);
  add_shard(*run, arguments);
  run->add_flag("--quiet", arguments.quiet, "print no progress and no tables");
  run->add_flag("--explain", arguments.explain, "print what the columns mean; alone: only that");
  run->add_flag("--json-lines", arguments.json_lines,
                "print events as JSON lines, nothing else (fixtures/README.md)");
  run->footer(
      "Two or more mesh files become a scene: each in a lattice of about 150 kept cells,\n"
      "60 frames in 2 s. From 5 passes on, ratios have 95 % intervals; a detector that takes over\n"
      "2 s for a pass has one. A call or process beyond a limit ends in status error.\n"
      "Examples:\n"
      "  contactcheck run\n"
      "  contactcheck run bunny-touch --detector fcl-aabb --detector ffd-aabb-sphere2+tri\n"
      "  contactcheck run out/recordings/bunny-touch.ccr --no-timing\n"
      "  contactcheck run --mesh a.obj --mesh b.obj --motion approach --save-scene mine.json\n"
      "  contactcheck run contact --detector ffd-lazy --isa AVX2 --isa SSE4\n"
      "  contactcheck run drawn --seed 7 --count 200 --save-scene drawn-7\n"
      "  contactcheck run drawn-7-3 --no-timing\n"
      "  contactcheck run drawn --steps --seed 7 --count 100\n"
      "  contactcheck run hard --pairs 1000000 --seed 7 --no-timing\n"
      "  contactcheck run bunny-touch --detector ./libmine.so:leaf=8 --detector fcl-aabb\n"
      "  contactcheck run bunny-touch --detector-cmd \"python3 mine.py\" --detector fcl-aabb\n"
      "  contactcheck run references --resume\n"
      "  contactcheck run references --shard 2/3 --out part2\n"
      "  contactcheck run default --json-lines --quiet | my-dashboard");
  choose(*run, line, [words, &line] { return run_command(words->arguments(), line.catalog); });
}

void add_reproduce(CommandLine& line) {
  const auto arguments = std::make_shared<RunArguments>();
  arguments->command_line = line.words;
  CLI::App* reproduce = line.app.add_subcommand(
      "reproduce", "Simulates the paper's scenes and compares its tables with ours");
  reproduce->add_option("scenes", arguments->targets, "scenes of the suite paper (default: all)");
  reproduce->add_option("--frames", arguments->frames, "frames per scene, same time step")
      ->check(whole_in(1, scene::kMostFrames));
  reproduce->add_option("--repeat", arguments->step_repeats, "timed repeats per step (default 5)")
      ->check(whole_in(1, 1000));
  add_threads(*reproduce, arguments->threads);
  reproduce
      ->add_option("--out", arguments->out,
                   "folder: reproduction.md, reproduction.json, files of run (default out)")
      ->type_name("DIR");
  add_resume(*reproduce, *arguments);
  reproduce->add_flag("--quiet", arguments->quiet, "print no progress and no table");
  reproduce->footer(
      "Examples:\n"
      "  contactcheck reproduce\n"
      "  contactcheck reproduce paper-rabbit --frames 60");
  choose(*reproduce, line,
         [arguments, &line] { return reproduce_command(*arguments, line.catalog); });
}

}  // namespace contactcheck::cli
