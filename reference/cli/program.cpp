#include "reference/cli/program.h"

#include <signal.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "reference/cli/commands.h"
#include "reference/cli/mesh_options.h"
#include "reference/cli/report_folder.h"
#include "reference/reduce/probe_worker.h"
#include "reference/run/interrupts.h"
#include "reference/run/printable.h"
#include "reference/run/worker.h"

namespace contactcheck {
namespace {

constexpr int kBadUsage = 2;

std::string join_command_line(int argc, char** argv) {
  std::string text = "contactcheck";
  for (int i = 1; i < argc; ++i) text += std::string(" ") + argv[i];
  return text;
}

// One line, whatever the input that it quotes holds.
void say(const std::string& sentence) {
  std::string line = sentence;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  std::fprintf(stderr, "contactcheck: %s\n", line.c_str());
}

// Paths and names go into JSON, which takes UTF-8 alone.
void require_utf8(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) try {
      nlohmann::json(argv[i]).dump();
    } catch (const nlohmann::json::exception&) {
      throw InputError("word " + std::to_string(i) + " of the command line is not UTF-8: \"" +
                       printable_line(argv[i]) + "\"");
    }
}

// A disk that is full: a list that is cut short is no list. (Who closes the stream wants none.)
void require_output_written() {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!written && errno != EBADF)
    throw InputError(std::string("cannot write to standard output: ") + std::strerror(errno));
}

struct Choices {
  RunArguments run;
  ListArguments list;
  ExportArguments exported;
  std::string results_file, job_file;
  std::vector<std::string> formats = all_report_formats();
  std::string report_out = "out";
  std::vector<std::string> families;
  std::uint64_t pairs = 0, pair_seed = PairSpec{}.seed;
  ReduceArguments reduce;
  GateArguments gate;
  std::string baseline_file;
  std::string probe_detector;
  std::string diff_before, diff_after;
  AbArguments ab;
  bool no_timing = false, write_truth = false, write_defects = false;
  int progress_fd = -1, channel_fd = -1;
};

// CLI11's own range (2.1) lets NaN pass.
std::string seconds_in_range(const std::string& text) {
  constexpr double kLeast = 0.1, kMost = 1e6;
  double value = 0.0;
  const bool number = CLI::detail::lexical_cast(text, value);
  return number && value >= kLeast && value <= kMost
             ? ""
             : "\"" + text + "\" is not a number from 0.1 to 1000000";
}

// What ends a detector that goes astray.
void add_limits(CLI::App& command, double& seconds, std::uint64_t& mib,
                const std::string& default_seconds) {
  command
      .add_option("--call-limit", seconds,
                  "seconds that one call of a detector may take (default " + default_seconds +
                      "); beyond, it has ended in an error")
      ->check(seconds_in_range)
      ->type_name("SECONDS");
  command
      .add_option("--memory-limit", mib,
                  "resident memory of a worker process (default 4096); the detector that passes it "
                  "has ended in an error")
      ->check(CLI::Range(64, 1 << 30))
      ->type_name("MIB");
}

void add_threads(CLI::App& command, Choices& c) {
  command
      .add_option("--threads", c.run.threads,
                  "threads of detectors that can use them, and that deform the bodies of "
                  "simulated scenes (default 1); results do not depend on it, times do")
      ->check(CLI::Range(1, 256));
}

void add_pairs(CLI::App& run, Choices& c) {
  CLI::Option* pairs =
      run.add_option(
             "--pairs", c.pairs,
             "so many random hard pairs of triangles as a scene of their own, random-pairs, "
             "beside the targets or alone; the oracle is held against rational arithmetic "
             "on each; detectors: those of the suite hard")
          ->check(CLI::Range(std::uint64_t{1}, kMostPairs))
          ->type_name("N");
  run.add_option("--seed", c.pair_seed, "of the random pairs (default 1)")
      ->check(CLI::Range(std::uint64_t{0}, kLargestPairSeed))
      ->type_name("S")
      ->needs(pairs);
}

void add_run(CLI::App& app, Choices& c) {
  CLI::App* run = app.add_subcommand("run", "run detectors on scenes and judge every answer");
  run->add_option(
      "targets", c.run.targets,
      "suites, scenes or files (.json scene or suite, .ccr recording); default: default");
  run->add_option("--detector", c.run.detectors, "a detector, repeatable; default: the suite's")
      ->allow_extra_args(false);
  run->add_option("--frames", c.run.frames, "frames per scene, same duration")
      ->check(CLI::Range(1, 100000));
  run->add_option("--repeat", c.run.repeats, "timed repeats per frame (default 5)")
      ->check(CLI::Range(1, 1000));
  run->add_option("--processes", c.run.processes, "fresh processes that are timed (default 1)")
      ->check(CLI::Range(1, 100));
  run->add_option("--out", c.run.out,
                  "folder for results.json, reports, cases, contacts, recordings "
                  "(default out)");
  run->add_flag("--closed-loop", c.run.closed_loop,
                "simulated scenes: let every detector drive the simulation too, and time whole "
                "steps");
  add_threads(*run, c);
  run->add_option("--isa", c.run.isas,
                  "instruction set of detectors that have a choice (default best), repeatable: "
                  "every such detector runs with each")
      ->allow_extra_args(false)
      ->type_name("NAME");
  add_mesh_options(*run, c.run);
  add_pairs(*run, c);
  add_limits(*run, c.run.call_limit, c.run.memory_limit_mib, "60");
  run->add_flag("--no-timing", c.no_timing, "judge only");
  run->add_flag("--resume", c.run.resume,
                "take over the scenes that an interrupted run with the same settings has finished "
                "in --out");
  run->add_flag("--quiet", c.run.quiet, "no progress, no tables");
  run->add_flag("--json-lines", c.run.json_lines,
                "for machines: what happens, as one JSON object a line, and nothing else, on "
                "standard output (events start, progress, scene and end; fixtures/README.md)");
  run->footer(
      "Examples:\n"
      "  contactcheck run\n"
      "  contactcheck run bunny-touch --detector fcl-aabb --detector ffd-aabb-sphere2+tri\n"
      "  contactcheck run out/recordings/bunny-touch.ccr --no-timing\n"
      "  contactcheck run --mesh a.obj --mesh b.obj --motion approach --save-scene mine.json\n"
      "  contactcheck run contact --detector ffd-lazy --isa AVX2 --isa SSE4\n"
      "  contactcheck run hard --pairs 1000000 --seed 7 --no-timing\n"
      "  contactcheck run references --resume\n"
      "  contactcheck run default --json-lines --quiet | my-dashboard");
}

void add_reproduce(CLI::App& app, Choices& c) {
  CLI::App* reproduce =
      app.add_subcommand("reproduce", "simulate the paper's scenes; its tables beside ours");
  reproduce->add_option("scenes", c.run.targets, "some of its scenes; default: the suite paper");
  reproduce->add_option("--frames", c.run.frames, "frames per scene, same step")
      ->check(CLI::Range(1, 100000));
  reproduce->add_option("--repeat", c.run.repeats, "timed repeats per step (default 5)")
      ->check(CLI::Range(1, 1000));
  add_threads(*reproduce, c);
  reproduce->add_option("--out", c.run.out,
                        "folder for reproduction.md, reproduction.json and all that run writes "
                        "(default out)");
  reproduce->add_flag("--quiet", c.run.quiet, "no progress, no table");
  reproduce->footer(
      "Examples:\n"
      "  contactcheck reproduce\n"
      "  contactcheck reproduce paper-rabbit --frames 60");
}

void add_reduce(CLI::App& app, Choices& c) {
  CLI::App* reduce = app.add_subcommand(
      "reduce", "shrink a disagreement to the fewest triangles and the simplest numbers");
  reduce
      ->add_option("case", c.reduce.target,
                   "a case file of run; or a scene, family or recording (with @FRAME or @VALUE "
                   "behind it, else its first frame with a disagreement) and --detector")
      ->required();
  reduce->add_option("--detector", c.reduce.detector, "the detector; default: the case's");
  reduce->add_option("--level", c.reduce.level,
                     "a disagreement at this level; default: the case's, or the finest");
  reduce->add_option("--kind", c.reduce.kind, "missed, spurious or error; default: the case's")
      ->check(CLI::IsMember({"missed", "spurious", "error"}));
  reduce
      ->add_option("--out", c.reduce.out,
                   "file of the minimal case, a family of one value that run takes (default: "
                   "NNNN.min.json beside the case; of a scene in out/cases)")
      ->type_name("FILE");
  reduce->add_option("--budget", c.reduce.budget, "candidates that may be tried (default 20000)")
      ->check(CLI::Range(1, 100000000))
      ->type_name("N");
  add_limits(*reduce, c.reduce.call_limit, c.reduce.memory_limit_mib, "10");
  reduce->footer(
      "Triangles keep their dimension, a missed crossing stays a crossing, and a pair in general\n"
      "position stays in it. The detector runs in a process of its own: crashes and hangs are\n"
      "reduced as well.\n"
      "Examples:\n"
      "  contactcheck reduce out/cases/0001.json\n"
      "  contactcheck reduce hard-balls-scale@1 --detector fcl-obbrss --out minimal.json\n"
      "  contactcheck run minimal.json --detector fcl-obbrss --no-timing");
}

void add_export(CLI::App& app, Choices& c) {
  CLI::App* exported = app.add_subcommand(
      "export", "the exact truth of scenes, with certificates that a short script checks");
  exported
      ->add_option("targets", c.exported.targets,
                   "suites, scenes, families or files (.json scene or suite, .ccr recording)")
      ->required();
  exported->add_option("--frames", c.exported.frames, "frames per scene, same duration")
      ->check(CLI::Range(1, 100000));
  exported
      ->add_option("--every", c.exported.every,
                   "of the frames, write only the first of every so many (default 1)")
      ->check(CLI::Range(1, 100000));
  exported->add_option("--out", c.exported.out,
                       "folder for a folder per scene: surfaces (PLY), certificates, check.py "
                       "(default out/export)");
  exported->footer(
      "Examples:\n"
      "  contactcheck export bunny-touch && python3 out/export/bunny-touch/check.py\n"
      "  contactcheck export default --every 10 --out /tmp/truth");
}

void add_gate(CLI::App& app, Choices& c) {
  CLI::App* gate =
      app.add_subcommand("gate", "hold results against the rules of a policy; what a CI job calls");
  gate->add_option("results", c.gate.results, "a results.json")->required();
  gate->add_option("--policy", c.gate.policy,
                   "rules, as fixtures/policies/README.md describes them")
      ->required()
      ->type_name("FILE");
  gate->add_option("--baseline", c.gate.baseline,
                   "results of an earlier run, as accept writes them; what they have must be there")
      ->type_name("RESULTS");
  gate->add_option("--junit", c.gate.junit, "JUnit XML: a test case per rule, scene and detector")
      ->type_name("FILE");
  gate->add_flag("--github", c.gate.github,
                 "annotations for GitHub Actions, and a job summary in the file that "
                 "GITHUB_STEP_SUMMARY names");
  gate->footer(
      "Exit code 1 when the policy is broken.\n"
      "Examples:\n"
      "  contactcheck gate out/results.json --policy fixtures/policies/default.json\n"
      "  contactcheck gate out/results.json --policy fixtures/policies/ci.json \\\n"
      "      --baseline fixtures/baselines/ci.json --junit out/gate.xml --github");
  CLI::App* accept =
      app.add_subcommand("accept", "make results the baseline that later gates compare with");
  accept->add_option("results", c.results_file, "a results.json")->required();
  accept->add_option("--as", c.baseline_file, "the baseline's file; what it changes is printed")
      ->required()
      ->type_name("FILE");
  accept->footer(
      "Example:\n  contactcheck accept out/results.json --as fixtures/baselines/ci.json");
}

// CLI11's own checks (2.1) let NaN pass.
CLI::Validator number_from(double least) {
  return CLI::Validator(
      [least](const std::string& text) {
        double value = 0.0;
        const bool number = CLI::detail::lexical_cast(text, value);
        return number && value >= least && value <= 1e9
                   ? std::string()
                   : "\"" + text + "\" is not a number from " + (least == 0.0 ? "0" : "1") +
                         " to 1000000000";
      },
      "");
}

void add_ab_limits(CLI::App& ab, Choices& c) {
  ab.add_option("--slower-than", c.ab.slower_than,
                "time(head) / time(base) that is allowed (default 1.1)")
      ->check(number_from(1.0))
      ->type_name("RATIO");
  ab.add_option("--floor-us", c.ab.floor_us,
                "microseconds a frame that do not matter, whatever the ratio (default 20)")
      ->check(number_from(0.0))
      ->type_name("US");
  ab.add_flag("--accuracy-may-change", c.ab.accuracy_may_change,
              "name other answers, but do not fail for them");
  ab.add_flag("--github", c.ab.github,
              "GitHub annotations, and a job summary in the file $GITHUB_STEP_SUMMARY");
}

void add_ab(CLI::App& app, Choices& c) {
  CLI::App* ab = app.add_subcommand(
      "ab", "run two builds of this program in turns: is head slower, does it answer otherwise");
  ab->add_option("base", c.ab.base, "the program as it was")->required();
  ab->add_option("head", c.ab.head, "the program as it is")->required();
  ab->add_option("targets", c.ab.targets, "suites, scenes or files, as of run; default: default");
  ab->add_option("--detector", c.ab.detectors, "a detector, repeatable; default: the suite's")
      ->allow_extra_args(false);
  ab->add_option("--rounds", c.ab.rounds, "how often each of them runs (default 7)")
      ->check(CLI::Range(3, 1000));
  ab->add_option("--frames", c.ab.frames, "frames per scene, same duration")
      ->check(CLI::Range(1, 100000));
  ab->add_option("--repeat", c.ab.repeats, "timed repeats per frame and round (default 3)")
      ->check(CLI::Range(1, 1000));
  add_ab_limits(*ab, c);
  ab->add_option("--out", c.ab.out, "folder for the last round's results (default out/ab)");
  ab->add_flag("--quiet", c.ab.quiet, "no progress");
  ab->footer(
      "Rounds are base head, head base, ..., each in fresh processes. A detector fails only when\n"
      "the whole 95 % interval of its ratio over rounds is beyond the limit and the excess beyond\n"
      "the floor. Its own question counts, with cold caches.\n"
      "Exit code 1 when a detector is slower, or when answers differ.\n"
      "Example:\n"
      "  contactcheck ab ../main/build/release/contactcheck build/release/contactcheck "
      "bunny-touch");
}

void add_others(CLI::App& app, Choices& c) {
  CLI::App* list = app.add_subcommand("list", "scenes, suites and detectors, with one line each");
  list->add_flag("--suites", c.list.suites, "suites only");
  list->add_flag("--scenes", c.list.scenes, "scenes only");
  list->add_flag("--families", c.list.families, "families of hard cases only");
  list->add_flag("--detectors", c.list.detectors,
                 "detectors only, with what each claims and its options");
  list->footer("Examples:\n  contactcheck list\n  contactcheck list --detectors");
  CLI::App* report = app.add_subcommand("report", "write the report of an old results.json again");
  report
      ->add_option("results", c.results_file,
                   "a results.json; the HTML report's 3D view draws the recordings and contacts "
                   "beside it")
      ->required();
  report->add_option("--format", c.formats, "formats: csv, html, md (default: all)")
      ->delimiter(',');
  report->add_option("--out", c.report_out, "folder (default out)");
  report->footer(
      "Examples:\n"
      "  contactcheck report out/results.json --out /tmp/report\n"
      "  contactcheck report out/results.json --format csv,md");
  CLI::App* diff = app.add_subcommand("diff", "two results side by side: worse, better, new, gone");
  diff->add_option("before", c.diff_before, "a results.json")->required();
  diff->add_option("after", c.diff_after, "another")->required();
  diff->footer(
      "Answers are compared exactly, times as speed-ups over a common reference.\n"
      "Example:\n  contactcheck diff old/results.json out/results.json");
  CLI::App* truth =
      app.add_subcommand("truth", "what is really there in each case of a family of hard cases");
  truth->add_option("families", c.families, "their ids; default: all");
  truth->add_flag(
      "--write", c.write_truth,
      "keep the answers in fixtures/hard/expected.json, which tests hold the oracle to");
  truth->footer("Example:\n  contactcheck truth hard-vertex-face");
  CLI::App* defects =
      app.add_subcommand("defects", "known defects of libraries beside those that a run shows");
  defects->add_option("results", c.results_file, "a results.json, of the suite hard")->required();
  defects->add_flag("--write", c.write_defects,
                    "make fixtures/hard/known-defects.json say what the run shows");
  defects->footer(
      "Exit code 1 when a listed defect did not show or an unlisted one did.\n"
      "Example:\n  contactcheck run hard --no-timing\n  contactcheck defects out/results.json");
  CLI::App* worker = app.add_subcommand("worker", "")->group("");
  worker->add_option("job", c.job_file)->required();
  worker->add_option("--progress-fd", c.progress_fd);
  CLI::App* probe = app.add_subcommand("probe", "")->group("");
  probe->add_option("detector", c.probe_detector)->required();
  probe->add_option("--channel-fd", c.channel_fd)->required();
}

int dispatch(CLI::App& app, Choices& c, const DetectorCatalog& catalog) {
  if (app.got_subcommand("worker")) return run_worker(c.job_file, catalog, c.progress_fd);
  if (app.got_subcommand("probe")) return run_probe_worker(c.probe_detector, catalog, c.channel_fd);
  if (app.got_subcommand("reduce")) return reduce_command(c.reduce, catalog);
  if (app.got_subcommand("list")) return list_command(c.list, catalog);
  if (app.got_subcommand("truth")) return truth_command(c.families, c.write_truth);
  if (app.got_subcommand("export")) return export_command(c.exported, catalog);
  if (app.got_subcommand("defects")) return defects_command(c.results_file, c.write_defects);
  if (app.got_subcommand("diff")) return diff_command(c.diff_before, c.diff_after);
  if (app.got_subcommand("ab")) return ab_command(c.ab);
  if (app.got_subcommand("report")) return report_command(c.results_file, c.formats, c.report_out);
  if (app.got_subcommand("gate")) return gate_command(c.gate);
  if (app.got_subcommand("accept")) return accept_command(c.results_file, c.baseline_file);
  c.run.timing = !c.no_timing;
  if (c.pairs > 0) c.run.pairs = PairSpec{c.pairs, c.pair_seed};
  if (app.got_subcommand("reproduce")) return reproduce_command(c.run, catalog);
  return run_command(c.run, catalog);
}

int refuse(const CLI::App& app, const CLI::ParseError& error) {
  // CLI11 would say that a subcommand is missing, and not which word it does not know.
  if (app.get_subcommands().empty() && !app.remaining().empty()) {
    const std::string word = app.remaining().front();
    say(std::string("unknown ") + (word.rfind('-', 0) == 0 ? "flag" : "command") + " \"" + word +
        "\"; contactcheck --help names all");
  } else {
    say(error.what());
  }
  return kBadUsage;
}

int parse_and_dispatch(int argc, char** argv, const DetectorCatalog& catalog) {
  CLI::App app("Judges collision detectors of deformable bodies against an exact oracle.");
  app.name("contactcheck");
  app.require_subcommand(1);
  app.set_version_flag("--version", CONTACTCHECK_VERSION);
  app.footer(
      "Exit codes: 0 done, 1 a check says no, 2 bad usage or input, 3 a detector ended in an error "
      "that is no known defect.\n"
      "Example:\n  contactcheck run bunny-touch");
  Choices choices;
  choices.run.command_line = join_command_line(argc, argv);
  add_run(app, choices);
  add_reproduce(app, choices);
  add_reduce(app, choices);
  add_export(app, choices);
  add_gate(app, choices);
  add_ab(app, choices);
  add_others(app, choices);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return e.get_exit_code() == 0 ? app.exit(e) : refuse(app, e);
  }
  return dispatch(app, choices, catalog);
}

// A worker's streams are its supervisor's to look after.
bool is_worker(int argc, char** argv) {
  return argc > 1 && (std::strcmp(argv[1], "worker") == 0 || std::strcmp(argv[1], "probe") == 0);
}

int main_with_errors(int argc, char** argv, const DetectorCatalog& catalog) {
  // A file that meets a limit is a failed write with a sentence of its own, and no death.
  signal(SIGXFSZ, SIG_IGN);
  try {
    require_utf8(argc, argv);
    const int code = parse_and_dispatch(argc, argv, catalog);
    if (!is_worker(argc, argv)) require_output_written();
    return code;
  } catch (const InputError& e) {
    say(e.what());
  } catch (const std::filesystem::filesystem_error& e) {
    say(e.path1().string() + ": " + e.code().message());
  }
  return kBadUsage;
}

}  // namespace

int contactcheck_main(int argc, char** argv, const DetectorCatalog& catalog) {
  try {
    return main_with_errors(argc, argv, catalog);
  } catch (const Interrupted& e) {
    die_of(e);
  } catch (const std::exception& e) {
    say(std::string("internal error: ") + e.what());
    return kExitInternal;
  }
}

}  // namespace contactcheck
