#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"
#include "reference/scene/scene.h"

namespace contactcheck::cli {

void add_reduce(CommandLine& line) {
  const auto arguments = std::make_shared<ReduceArguments>();
  CLI::App* reduce = line.app.add_subcommand(
      "reduce", "Shrinks a wrong answer to the fewest triangles and simplest numbers");
  reduce
      ->add_option("case", arguments->target,
                   "case file of run, or a scene[@FRAME] with --detector")
      ->required();
  reduce->add_option("--detector", arguments->detector, "detector or FILE.so (default: the case's)")
      ->type_name("NAME");
  add_commands(*reduce, arguments->command);
  reduce
      ->add_option("--level", arguments->level,
                   "level of the wrong answer (default: the case's, or the finest)")
      ->type_name("LEVEL");
  reduce->add_option("--kind", arguments->kind, "missed, spurious or error (default: the case's)")
      ->check(CLI::IsMember({"missed", "spurious", "error"}))
      ->type_name("KIND");
  reduce
      ->add_option("--out", arguments->out,
                   "minimal case, a family that run takes (default: beside the case)")
      ->type_name("FILE");
  reduce
      ->add_option("--print", arguments->language,
                   "test on stdout: c++ (default), c, javascript or python")
      ->check(CLI::IsMember({"c++", "c", "javascript", "python"}))
      ->type_name("LANGUAGE");
  reduce->add_option("--budget", arguments->budget, "candidates to try at most (default 20000)")
      ->check(whole_in(1, 100000000))
      ->type_name("N");
  add_limits(*reduce, arguments->call_limit, arguments->memory_limit_mib);
  reduce->footer(
      "Triangles keep their dimension, a missed crossing stays a crossing, and a pair in general\n"
      "position stays in it. The detector runs in a separate process: crashes and hangs are\n"
      "reduced as well.\n"
      "Examples:\n"
      "  contactcheck reduce out/cases/0001.json --print python > test_contact.py\n"
      "  contactcheck reduce hard-balls-scale@1 --detector fcl-obbrss --out minimal.json\n"
      "  contactcheck run minimal.json --detector fcl-obbrss --no-timing");
  choose(*reduce, line, [arguments, &line] { return reduce_command(*arguments, line.catalog); });
}

void add_export(CommandLine& line) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* exported = line.app.add_subcommand(
      "export", "Writes frames and ground truth with certificates and their checker");
  exported
      ->add_option("targets", arguments->targets,
                   "suites, scenes, families, .json or .ccr files; frames of bodies")
      ->required();
  exported->add_option("--frames", arguments->frames, "frames per scene, same duration")
      ->check(whole_in(1, scene::kMostFrames));
  exported->add_option("--every", arguments->every, "write every Nth frame (default 1)")
      ->check(whole_in(1, scene::kMostFrames));
  CLI::Option* between =
      exported->add_flag("--between", arguments->between,
                         "prove what meets between frames instead: vertices move straight");
  between->excludes("--every");
  exported->add_flag("--weld", arguments->weld, "vertices at one place in the first frame are one")
      ->needs(between);
  CLI::Option* queries = exported->add_flag(
      "--queries", arguments->queries, "instead of frames: queries between them, with their truth");
  queries->excludes("--every")->excludes(between);
  exported
      ->add_option("--sample", arguments->sample.most, "at most N queries of a kind, drawn by seed")
      ->check(whole_in(1, std::uint64_t{1} << 32))
      ->needs(queries);
  exported->add_option("--seed", arguments->sample.seed, "of the sample (default 1)")
      ->check(whole_in(0, ~std::uint64_t{0}))
      ->needs(queries);
  exported
      ->add_flag("--certificates", arguments->sample.certificates,
                 "also write a proof of each query's truth, and check.py")
      ->needs(queries);
  exported
      ->add_option("--out", arguments->out,
                   "folder for surfaces, certificates, check.py (default out/export)")
      ->type_name("DIR");
  exported->footer(
      "With --between every pair of bodies has a proof in every step, on straight paths between\n"
      "these frames: that nothing meets, or one contact. A scene with levels of self-contact also\n"
      "has proofs for every body with itself: triangles, and vertices or edges, that share no "
      "vertex.\n"
      "Examples:\n"
      "  contactcheck export bunny-touch && python3 out/export/bunny-touch/check.py\n"
      "  contactcheck export default --every 10 --out /tmp/truth\n"
      "  contactcheck export cloth_*.obj ball.obj --between && python3 out/export/frames/check.py\n"
      "  contactcheck export bunny-touch --queries --sample 10000 --certificates");
  choose(*exported, line, [arguments, &line] { return export_command(*arguments, line.catalog); });
}

}  // namespace contactcheck::cli
