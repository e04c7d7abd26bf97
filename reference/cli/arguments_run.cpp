#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "core/types/check.h"
#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"
#include "reference/scene/amount.h"
#include "reference/scene/drawn_scene.h"
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

std::string motions_help() {
  std::string out = "how they meet (default approach):";
  for (const scene::NamedMotion& motion : scene::named_motions())
    out += std::string(&motion == &scene::named_motions().front() ? " " : "; ") + motion.name +
           ": " + motion.says;
  return out;
}

// --mesh, --motion, --size, --save-scene. Both must outlive the parsing.
void add_mesh_options(CLI::App& run, RunArguments& arguments) {
  scene::MeshSceneRequest& request = arguments.meshes;
  CLI::Option* mesh =
      run.add_option_function<std::vector<std::string>>(
             "--mesh",
             [&request](const std::vector<std::string>& files) {
               request.meshes.assign(files.begin(), files.end());
             },
             "a mesh file (OBJ, PLY, OFF, STL, others through assimp), twice or more: they "
             "become a scene, each in a lattice of about 150 kept cells, beside the targets or "
             "alone; 2 s, 60 frames unless --frames says otherwise. With the suite drawn: once "
             "or more, in place of its meshes")
          ->allow_extra_args(false)
          ->type_name("FILE");
  run.add_option("--motion", request.motion, motions_help())->type_name("NAME")->needs(mesh);
  run.add_option_function<std::string>(
         "--size", [&request](const std::string& text) { request.size = size_of(text); },
         "largest side of each mesh in metres (default 1), or file: as it is there")
      ->type_name("METRES")
      ->needs(mesh);
  run.add_option("--save-scene", arguments.save_scene,
                 "keep the scenes of the run (drawn, of meshes, or from files) as scene files, to "
                 "be edited and run again: one in the file of this name, several in the folder; a "
                 "file that is there is not written over")
      ->type_name("PATH");
}

struct RunWords {
  RunArguments run;
  bool no_timing = false;
  std::uint64_t pairs = 0;

  RunArguments arguments() const {
    RunArguments out = run;
    out.timing = !no_timing;
    if (pairs > 0) out.pairs = scene::PairSpec{pairs, run.seed};
    return out;
  }
};

void add_threads(CLI::App& command, std::uint32_t& threads) {
  command
      .add_option("--threads", threads,
                  "threads of detectors that can use them, and that deform the bodies of "
                  "simulated scenes (default 1); results do not depend on it, times do")
      ->check(whole_in(1, 256));
}

void add_pairs(CLI::App& run, RunWords& words) {
  run.add_option("--pairs", words.pairs,
                 "add a scene of N random hard triangle pairs, random-pairs, to the targets, or "
                 "run it alone; the oracle is checked against rational arithmetic on each; "
                 "detectors: those of the suite hard")
      ->check(whole_in(1, scene::kMostPairs))
      ->type_name("N");
  run.add_option("--seed", words.run.seed,
                 "of the drawn scenes, of the random pairs, of the order in which detectors are "
                 "timed and of the frames "
                 "that are timed cold (default 1)")
      ->check(whole_in(0, scene::kLargestPairSeed))
      ->type_name("S");
}

void add_count(CLI::App& run, RunWords& words) {
  run.add_option_function<std::size_t>(
         "--count", [&words](const std::size_t& count) { words.run.count = count; },
         "scenes of the suite drawn, drawn-S-1 to drawn-S-N of the seed S (default 20)")
      ->check(whole_in(1, scene::kMostDrawnScenes))
      ->type_name("N");
}

// `arguments` must outlive the command.
void add_shard(CLI::App& run, RunArguments& arguments) {
  run.add_option_function<std::string>(
         "--shard",
         [&arguments](const std::string& text) { arguments.shard = suite::parse_shard(text); },
         "run only shard K of N (scenes are assigned round-robin); merge assembles the results of "
         "all shards")
      ->type_name("K/N");
}

}  // namespace

void add_run(CommandLine& line) {
  const auto words = std::make_shared<RunWords>();
  RunArguments& arguments = words->run;
  arguments.command_line = line.words;
  CLI::App* run = line.app.add_subcommand("run", "run detectors on scenes and judge every answer");
  run->add_option(
      "targets", arguments.targets,
      "suites, scenes or files (.json scene, suite or rules of drawn scenes, .ccr recording); "
      "default: default");
  run->add_option("--detector", arguments.detectors,
                  "a detector, repeatable; default: the suite's; with '/' or .so in its name a "
                  "shared library of your own (reference/plugin/README.md)")
      ->allow_extra_args(false);
  add_commands(*run, arguments.commands);
  run->add_option("--frames", arguments.frames, "frames per scene, same duration")
      ->check(whole_in(1, 100000));
  run->add_option("--processes", arguments.processes,
                  "timed passes through all frames, each in a fresh process; from 5 on there are "
                  "95 % intervals (default 3, and 1 of detectors that take over 2 s for it)")
      ->check(whole_in(1, 100))
      ->type_name("N");
  run->add_option("--out", arguments.out,
                  "folder for results.json, reports, cases, contacts, recordings "
                  "(default out); of one run at a time");
  run->add_flag("--closed-loop", arguments.closed_loop,
                "simulated scenes: let every detector drive the simulation too, and time whole "
                "steps");
  add_threads(*run, arguments.threads);
  run->add_option("--isa", arguments.isas,
                  "instruction set of detectors that have a choice (default best), repeatable: "
                  "every such detector runs with each")
      ->allow_extra_args(false)
      ->type_name("NAME");
  add_mesh_options(*run, arguments);
  add_pairs(*run, *words);
  add_count(*run, *words);
  add_limits(*run, arguments.call_limit, arguments.memory_limit_mib);
  run->add_flag("--no-timing", words->no_timing, "judge only");
  run->add_flag("--reduce", arguments.reduce,
                "reduce the first wrong answer of each detector, level and kind to a minimal case, "
                "as the command reduce does");
  run->add_flag("--resume", arguments.resume,
                "take over the scenes that an interrupted run with the same settings has finished "
                "in --out");
  add_shard(*run, arguments);
  run->add_flag("--quiet", arguments.quiet, "no progress, no tables");
  run->add_flag("--json-lines", arguments.json_lines,
                "for machines: what happens, as one JSON object a line, and nothing else, on "
                "standard output (events start, progress, scene and end; fixtures/README.md)");
  run->footer(
      "Examples:\n"
      "  contactcheck run\n"
      "  contactcheck run bunny-touch --detector fcl-aabb --detector ffd-aabb-sphere2+tri\n"
      "  contactcheck run out/recordings/bunny-touch.ccr --no-timing\n"
      "  contactcheck run --mesh a.obj --mesh b.obj --motion approach --save-scene mine.json\n"
      "  contactcheck run contact --detector ffd-lazy --isa AVX2 --isa SSE4\n"
      "  contactcheck run drawn --seed 7 --count 200 --save-scene drawn-7\n"
      "  contactcheck run drawn-7-3 --no-timing\n"
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
  CLI::App* reproduce =
      line.app.add_subcommand("reproduce", "simulate the paper's scenes; its tables beside ours");
  reproduce->add_option("scenes", arguments->targets,
                        "some of its scenes; default: the suite paper");
  reproduce->add_option("--frames", arguments->frames, "frames per scene, same step")
      ->check(whole_in(1, 100000));
  reproduce->add_option("--repeat", arguments->step_repeats, "timed repeats per step (default 5)")
      ->check(whole_in(1, 1000));
  add_threads(*reproduce, arguments->threads);
  reproduce->add_option("--out", arguments->out,
                        "folder for reproduction.md, reproduction.json and all that run writes "
                        "(default out)");
  reproduce->add_flag("--quiet", arguments->quiet, "no progress, no table");
  reproduce->footer(
      "Examples:\n"
      "  contactcheck reproduce\n"
      "  contactcheck reproduce paper-rabbit --frames 60");
  choose(*reproduce, line,
         [arguments, &line] { return reproduce_command(*arguments, line.catalog); });
}

}  // namespace contactcheck::cli
