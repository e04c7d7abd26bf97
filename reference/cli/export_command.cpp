#include <cstdio>
#include <functional>
#include <set>

#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/judge/export_folder.h"
#include "reference/judge/scene_export.h"
#include "reference/process/interrupts.h"
#include "reference/queries/scene_queries.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/scene.h"
#include "reference/scene/simulate_scene.h"
#include "reference/scene/suite_file.h"
#include "reference/scene/sweep_poses.h"
#include "reference/suite/out_folder.h"
#include "reference/text/counted.h"
#include "reference/text/file_text.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

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
  if (!fs::exists(fs::symlink_status(folder)) || judge::is_export(folder) ||
      queries::is_query_export(folder))
    return;
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
template <typename Write>
auto export_whole(const std::string& id, const fs::path& out, const Write& write) {
  const suite::ScratchFolder scratch(out);
  const fs::path made = scratch.path() / id, target = out / id;
  const auto summary = write(made);
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

void print_queries(const fs::path& file, const queries::ExportedQueries& counts,
                   bool certificates) {
  std::printf("%s: %s", file.c_str(), text::counted(counts.written, "query", "queries").c_str());
  if (counts.written < counts.found) std::printf(" of %zu", counts.found);
  std::printf(", %s (%zu at the start)", text::counted(counts.contacts, "contact").c_str(),
              counts.starts_in_contact);
  if (certificates) std::printf(", %zu without proof", counts.written - counts.proved);
  std::printf("\n");
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
  fs::path last;
  for (const fs::path& file : files) {
    scene::Scene scene = scene::load_any_scene(file, arguments.frames);
    scene::record_simulation(
        catalog, [&](std::size_t) { look(); }, scene);
    scene::place_sweep([&](std::size_t) { look(); }, scene);
    last = scene.id;
    const fs::path folder = arguments.out / last;
    if (arguments.queries) {
      const auto write = [&](const fs::path& made) {
        fs::create_directories(made);
        if (arguments.sample.certificates) judge::write_check_script(made);
        return queries::export_queries(scene, arguments.sample, made, look);
      };
      const queries::QueryExport summary = export_whole(scene.id, arguments.out, write);
      const bool proofs = arguments.sample.certificates;
      print_queries(folder / "vertex-face.csv", summary.vertex_face, proofs);
      print_queries(folder / "edge-edge.csv", summary.edge_edge, proofs);
    } else {
      const auto write = [&](const fs::path& made) {
        return judge::export_scene(scene, arguments.every, made, look);
      };
      print_summary(folder, export_whole(scene.id, arguments.out, write));
    }
  }
  const std::string made =
      (arguments.out / (files.size() == 1 ? last : fs::path("SCENE"))).string();
  if (arguments.queries)
    std::printf("to judge detectors on them: contactcheck queries %s/*.csv\n", made.c_str());
  if (!arguments.queries || arguments.sample.certificates)
    std::printf("to check them: python3 %s/check.py\n", made.c_str());
  return 0;
}

}  // namespace contactcheck::cli
