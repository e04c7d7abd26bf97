#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/cli/commands.h"

namespace contactcheck::cli {

void add_check(CommandLine& line) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* check =
      line.app.add_subcommand("check", "Says which frames of a simulation have contacts");
  check
      ->add_option("files", arguments->frames,
                   "numbered meshes; a mesh and its PC2 or MDD file; a recording")
      ->required();
  check
      ->add_option("--allow", arguments->allow, "contact, self, depth=METRES or impact; repeatable")
      ->allow_extra_args(false)
      ->type_name("WHAT");
  check
      ->add_option("--frames", arguments->rules.patterns,
                   "which number is the frame's: 'ball{body}_{frame}.obj'; repeatable")
      ->allow_extra_args(false)
      ->type_name("PATTERN");
  check
      ->add_option("--cache-space", arguments->rules.cache_space,
                   "space of PC2 and MDD: file (as it is) or mesh (led to it)")
      ->check(CLI::IsMember({"file", "mesh"}))
      ->type_name("SPACE");
  check->add_flag("--between", arguments->between,
                  "contact between frames, too: vertices move straight from frame to frame");
  check->add_flag("--repair", arguments->rules.repair,
                  "fill polygons that cross themselves by fans");
  check->add_flag("--weld", arguments->weld, "vertices at one place in the first frame are one");
  check->add_option("--out", arguments->out, "folder of what is written (default out)")
      ->type_name("DIR");
  check
      ->add_option("--keep", arguments->keep,
                   "write OUT/frame-17.ccr, to judge detectors by; 3-4: both ends of a step")
      ->allow_extra_args(false)
      ->type_name("FRAME");
  check->add_flag("--resume", arguments->resume,
                  "take over frames that an earlier check has left in --out");
  check->add_flag("--overwrite", arguments->overwrite,
                  "discard what an interrupted check has left in --out");
  check->add_flag("--json-lines", arguments->json_lines, "events on standard output");
  check->add_flag("--quiet", arguments->quiet, "no progress bar");
  check->footer(
      "Exit code 1 when a frame, or with --between a step, has a contact that is not allowed.\n"
      "A contact of a certified surface depth up to METRES is allowed by --allow depth=METRES.\n"
      "With --allow impact, contacts between frames are listed and do not change the exit code.\n"
      "check.csv and check.json in --out have every contact, check.html shows them.\n"
      "Example:\n  contactcheck check cloth_*.obj ball.obj --allow depth=0.002");
  choose(*check, line, [arguments, &line] { return check_command(*arguments, line.catalog); });
}

}  // namespace contactcheck::cli
