#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"
#include "reference/results/statistics.h"
#include "reference/scene/scene.h"

namespace contactcheck::cli {
namespace {

struct DiffWords {
  std::string before, after;
  bool fail = false;
};

void add_ab_limits(CLI::App& ab, AbArguments& arguments) {
  ab.add_option("--slower-than", arguments.slower_than,
                "allowed time(head) / time(base) (default 1.1)")
      ->check(number_in(1.0, 1e9, "1 to 1000000000"))
      ->type_name("RATIO");
  ab.add_option("--floor-us", arguments.floor_us,
                "microseconds per frame that never matter (default 20)")
      ->check(number_in(0.0, 1e9, "0 to 1000000000"))
      ->type_name("US");
  ab.add_flag("--accuracy-may-change", arguments.accuracy_may_change,
              "report changed answers, but do not fail");
  ab.add_flag("--github", arguments.github, "write GitHub annotations and a job summary");
}

}  // namespace

void add_ab(CommandLine& line) {
  const auto arguments = std::make_shared<AbArguments>();
  CLI::App* ab = line.app.add_subcommand(
      "ab", "Compares builds or detectors: is HEAD slower, does it answer differently");
  ab->add_option("base", arguments->base, "old program, or a detector: name, library or command")
      ->required();
  ab->add_option("head", arguments->head, "new program, or a detector: name, library or command")
      ->required();
  ab->add_option("targets", arguments->targets,
                 "suites, scenes or files, as of run (default: default)");
  ab->add_option("--detector", arguments->detectors, "detector, repeatable (default: the suite's)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  ab->add_option("--rounds", arguments->rounds, "rounds, each runs both (default 7)")
      ->check(whole_in(results::kFewestForInterval, 1000));
  ab->add_option("--frames", arguments->frames, "frames per scene, same duration")
      ->check(whole_in(1, scene::kMostFrames));
  add_ab_limits(*ab, *arguments);
  ab->add_option("--out", arguments->out, "folder for the last round's results (default out/ab)")
      ->type_name("DIR");
  ab->add_flag("--resume", arguments->resume,
               "take over the rounds of an interrupted comparison in --out");
  ab->add_flag("--overwrite", arguments->overwrite, "discard them");
  ab->add_flag("--quiet", arguments->quiet, "print no progress");
  ab->footer(
      "Rounds are base head, head base, ..., each in fresh processes. A ratio is the geometric\n"
      "mean over rounds, with its 95 % interval. A detector fails only when all of that is beyond\n"
      "the limit and the excess beyond the floor.\n"
      "Its own question counts, in playback: all frames in order, nothing flushed.\n"
      "Exit code 1 when a detector is slower, or when answers differ.\n"
      "Examples:\n"
      "  contactcheck ab ../main/build/release/contactcheck build/release/contactcheck "
      "bunny-touch\n"
      "  contactcheck ab ./libmine-old.so ./libmine.so bunny-touch\n"
      "  contactcheck ab 'python3 old.py' 'python3 new.py' bunny-touch\n"
      "  contactcheck ab fcl-aabb embree contact");
  choose(*ab, line, [arguments, &line] {
    arguments->command_line = line.words;
    return ab_command(*arguments, line.catalog);
  });
}

void add_diff(CommandLine& line) {
  const auto words = std::make_shared<DiffWords>();
  CLI::App* diff =
      line.app.add_subcommand("diff", "Compares two results: worse, better, new, gone");
  diff->add_option("before", words->before, "results.json")->required();
  diff->add_option("after", words->after, "results.json")->required();
  diff->footer(
      "Answers are compared exactly, times as speed-ups over a common reference.\n"
      "Example:\n  contactcheck diff old/results.json out/results.json");
  diff->add_flag("--fail", words->fail, "exit code 1 when an answer is worse or a row is gone");
  choose(*diff, line, [words] { return diff_command(words->before, words->after, words->fail); });
}

}  // namespace contactcheck::cli
