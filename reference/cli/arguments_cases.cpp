#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"

namespace contactcheck::cli {

void add_reduce(CommandLine& line) {
  const auto arguments = std::make_shared<ReduceArguments>();
  CLI::App* reduce = line.app.add_subcommand(
      "reduce", "shrink a disagreement to the fewest triangles and the simplest numbers");
  reduce
      ->add_option("case", arguments->target,
                   "a case file of run; or a scene, family or recording (with @FRAME or @VALUE "
                   "behind it, else its first frame with a disagreement) and --detector")
      ->required();
  reduce->add_option("--detector", arguments->detector,
                     "the detector, or a shared library; default: the case's");
  add_commands(*reduce, arguments->command);
  reduce->add_option("--level", arguments->level,
                     "a disagreement at this level; default: the case's, or the finest");
  reduce->add_option("--kind", arguments->kind, "missed, spurious or error; default: the case's")
      ->check(CLI::IsMember({"missed", "spurious", "error"}));
  reduce
      ->add_option("--out", arguments->out,
                   "file of the minimal case, a family of one value that run takes (default: "
                   "NNNN.min.json beside the case; of a scene in out/cases)")
      ->type_name("FILE");
  reduce->add_option("--budget", arguments->budget, "candidates that may be tried (default 20000)")
      ->check(whole_in(1, 100000000))
      ->type_name("N");
  add_limits(*reduce, arguments->call_limit, arguments->memory_limit_mib);
  reduce->footer(
      "Triangles keep their dimension, a missed crossing stays a crossing, and a pair in general\n"
      "position stays in it. The detector runs in a process of its own: crashes and hangs are\n"
      "reduced as well.\n"
      "Examples:\n"
      "  contactcheck reduce out/cases/0001.json\n"
      "  contactcheck reduce hard-balls-scale@1 --detector fcl-obbrss --out minimal.json\n"
      "  contactcheck run minimal.json --detector fcl-obbrss --no-timing");
  choose(*reduce, line, [arguments, &line] { return reduce_command(*arguments, line.catalog); });
}

void add_export(CommandLine& line) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* exported = line.app.add_subcommand(
      "export", "the exact truth of scenes, with certificates that a short script checks");
  exported
      ->add_option("targets", arguments->targets,
                   "suites, scenes, families or files (.json scene or suite, .ccr recording)")
      ->required();
  exported->add_option("--frames", arguments->frames, "frames per scene, same duration")
      ->check(whole_in(1, 100000));
  exported->add_option("--every", arguments->every, "write every Nth frame (default 1)")
      ->check(whole_in(1, 100000));
  exported->add_option("--out", arguments->out,
                       "folder for a folder per scene: surfaces (PLY), certificates, check.py "
                       "(default out/export)");
  exported->footer(
      "Examples:\n"
      "  contactcheck export bunny-touch && python3 out/export/bunny-touch/check.py\n"
      "  contactcheck export default --every 10 --out /tmp/truth");
  choose(*exported, line, [arguments, &line] { return export_command(*arguments, line.catalog); });
}

}  // namespace contactcheck::cli
