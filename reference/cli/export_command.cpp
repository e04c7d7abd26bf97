#include <cstdio>
#include <functional>
#include <set>

#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/judge/scene_export.h"
#include "reference/process/interrupts.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/scene.h"
#include "reference/scene/simulate_scene.h"
#include "reference/scene/suite_file.h"
#include "reference/scene/sweep_poses.h"
#include "reference/suite/out_folder.h"
#include "reference/text/file_text.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using judge::ExportSummary;

std::vector<fs::path> files_of(const std::vector<std::string>& targets) {
  const fs::path fixtures = scene::fixtures_directory();
  std::vector<fs::path> files;
  for (const std::string& name : targets) {
    const scene::Target target = scene::find_target(name, fixtures);
    if (target.kind != scene::TargetKind::kSuite) {
      files.push_back(target.file);
      continue;
    }
    for (const scene::SuiteScene& scene : scene::load_suite(target.file).scenes)
      files.push_back(scene::file_of(scene, fixtures));
  }
  return files;
}

// An earlier export makes place for this one; anything else stays, and nothing is written.
void require_free(const fs::path& folder) {
  if (!fs::exists(fs::symlink_status(folder)) || judge::is_export(folder)) return;
  throw InputError("--out: " + text::in_quotes(folder.string()) +
                   " is there already and is no export: nothing there is replaced");
}

// Every scene is read before anything is written, so that a bad one ends the command at once.
void check_scenes(const ExportArguments& arguments, const std::vector<fs::path>& files) {
  std::set<std::string> ids;
  for (const fs::path& file : files) {
    const scene::Scene scene = scene::load_any_scene(file, arguments.frames);
    if (!ids.insert(scene.id).second)
      throw InputError("two scenes of this export have the id " + text::in_quotes(scene.id));
    require_free(arguments.out / scene.id);
  }
}

// Into a scratch folder first: under its name an export is whole, or it is not there.
judge::ExportSummary export_whole(const scene::Scene& scene, std::size_t every, const fs::path& out,
                                  const std::function<void()>& before_frame) {
  const suite::ScratchFolder scratch(out);
  const fs::path made = scratch.path() / scene.id, target = out / scene.id;
  const judge::ExportSummary summary = judge::export_scene(scene, every, made, before_frame);
  std::error_code error;
  if (fs::exists(target)) fs::rename(target, scratch.path() / "replaced", error);
  if (error)
    throw InputError("cannot replace " + text::in_quotes(target.string()) + ": " + error.message());
  suite::rename_file(made, target);
  return summary;
}

void print_summary(const fs::path& folder, const judge::ExportSummary& summary) {
  std::printf(
      "%s: %zu frames; %zu pairs of triangles touch, %zu more have boxes that meet; "
      "contact_hash 0x%016llx\n",
      folder.c_str(), summary.frames, summary.contacts, summary.gaps,
      static_cast<unsigned long long>(summary.contact_hash));
  std::fflush(stdout);
}

}  // namespace

int export_command(const ExportArguments& arguments, const DetectorCatalog& catalog) {
  const std::vector<fs::path> files = files_of(arguments.targets);
  check_scenes(arguments, files);
  check_out(arguments.out);
  process::InterruptGuard guard;
  const auto look = [&guard] {
    if (guard.interrupted()) guard.pass_on();
  };
  for (const fs::path& file : files) {
    scene::Scene scene = scene::load_any_scene(file, arguments.frames);
    scene::record_simulation(
        catalog, [&](std::size_t) { look(); }, scene);
    scene::place_sweep([&](std::size_t) { look(); }, scene);
    print_summary(arguments.out / scene.id,
                  export_whole(scene, arguments.every, arguments.out, look));
  }
  std::printf("to check them: python3 %s/SCENE/check.py\n", arguments.out.c_str());
  return 0;
}

}  // namespace contactcheck::cli
