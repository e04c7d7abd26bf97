#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <set>

#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/judge/export_folder.h"
#include "reference/judge/scene_export.h"
#include "reference/judge/step_export.h"
#include "reference/process/interrupts.h"
#include "reference/queries/scene_queries.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/frame_files.h"
#include "reference/scene/scene.h"
#include "reference/scene/simulate_scene.h"
#include "reference/scene/suite_file.h"
#include "reference/scene/sweep_poses.h"
#include "reference/suite/drawn_targets.h"
#include "reference/suite/out_folder.h"
#include "reference/text/counted.h"
#include "reference/text/file_text.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

// The frames of one simulation, or whatever names scenes.
std::vector<scene::SceneSource> sources_of(const ExportArguments& arguments) {
  const auto meshes = std::ranges::count_if(arguments.targets, names_mesh);
  if (meshes > 0) {
    if (!arguments.between)
      throw InputError(
          "mesh files are frames, of which export writes proofs of steps with --between" +
          std::string(
              arguments.queries
                  ? "; for queries, `check FRAMES --keep 3-4` writes a step as a recording, "
                    "which export --queries takes"
                  : ""));
    if (static_cast<std::size_t>(meshes) < arguments.targets.size())
      throw InputError("export takes frames as mesh files, or scenes, and not both at once");
    const scene::FrameFiles frames =
        scene::frame_files({arguments.targets.begin(), arguments.targets.end()},
                           scene::FrameRules(), "frames", {Level::kBody, Level::kSelf});
    refuse_left_out(frames);
    return {frames.scene};
  }
  const fs::path fixtures = scene::fixtures_directory();
  std::vector<scene::SceneSource> sources;
  suite::RunTargets drawing;
  drawing.frames = arguments.frames;
  for (const std::string& name : arguments.targets) {
    if (name.starts_with("drawn-") && fs::path(name).extension().empty())
      if (const auto drawn = suite::find_drawn(name, drawing)) {
        sources.insert(sources.end(), drawn->scenes.begin(), drawn->scenes.end());
        continue;
      }
    const scene::Target target = scene::find_target(name, fixtures);
    if (target.kind != scene::TargetKind::kSuite) {
      sources.emplace_back(target.file);
      continue;
    }
    for (const scene::SuiteScene& scene : scene::load_suite(target.file).scenes)
      sources.emplace_back(scene::file_of(scene, fixtures));
  }
  return sources;
}

scene::Scene load(const scene::SceneSource& source, const ExportArguments& arguments) {
  scene::Scene scene = scene::load_any_scene(source, arguments.frames);
  if (arguments.weld) scene::weld(scene);
  return scene;
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
void check_scenes(const ExportArguments& arguments,
                  const std::vector<scene::SceneSource>& sources) {
  std::set<std::string> ids;
  for (const scene::SceneSource& source : sources) {
    const scene::Scene scene = load(source, arguments);
    if (arguments.between) judge::require_steps(scene);
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

// The same words as check --between has: the frames may be joined by other paths.
void print_steps(const fs::path& folder, const scene::Scene& scene,
                 const judge::StepExportSummary& summary) {
  constexpr const char* kPaths = "on straight paths between these frames";
  constexpr std::size_t kMostShown = 10;
  const auto name = [&](std::uint32_t body) { return scene.bodies[body].name; };
  for (std::size_t i = 0; i < summary.contacts.size() && i < kMostShown; ++i) {
    const judge::ExportedContact& c = summary.contacts[i];
    const std::string bodies =
        name(c.bodies.a) + (c.bodies.a == c.bodies.b ? " with itself" : " and " + name(c.bodies.b));
    std::printf("frame %zu to %zu, %s: contact at %s of the step, %s\n", c.step, c.step + 1,
                bodies.c_str(), fmt::format("{:.6g}", c.earliest).c_str(), kPaths);
  }
  if (summary.contacts.size() > kMostShown)
    std::printf("... and %s\n",
                text::counted(summary.contacts.size() - kMostShown, "more contact").c_str());
  std::printf("%s: %s, %s: %zu pairs of bodies proven apart, %zu in contact, %zu without proof\n",
              folder.c_str(), text::counted(summary.steps, "step").c_str(), kPaths, summary.apart,
              summary.contacts.size(), summary.unproved);
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
  const std::vector<scene::SceneSource> sources = sources_of(arguments);
  check_scenes(arguments, sources);
  check_out(arguments.out);
  process::InterruptGuard guard;
  const auto look = [&guard] {
    if (guard.interrupted()) guard.pass_on();
  };
  fs::path last;
  for (const scene::SceneSource& source : sources) {
    scene::Scene scene = load(source, arguments);
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
    } else if (arguments.between) {
      const auto write = [&](const fs::path& made) {
        return judge::export_steps(scene, made, look);
      };
      print_steps(folder, scene, export_whole(scene.id, arguments.out, write));
    } else {
      const auto write = [&](const fs::path& made) {
        return judge::export_scene(scene, arguments.every, made, look);
      };
      print_summary(folder, export_whole(scene.id, arguments.out, write));
    }
  }
  const std::string made =
      (arguments.out / (sources.size() == 1 ? last : fs::path("SCENE"))).string();
  if (arguments.queries)
    std::printf("to judge detectors on them: contactcheck queries %s/*.csv\n", made.c_str());
  if (!arguments.queries || arguments.sample.certificates)
    std::printf("to check them: python3 %s/check.py\n", made.c_str());
  return 0;
}

}  // namespace contactcheck::cli
