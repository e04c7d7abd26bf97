#include "reference/suite/run_plan.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/types/check.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/drawn_scene.h"
#include "reference/scene/simulate_scene.h"
#include "reference/scene/suite_file.h"
#include "reference/suite/drawn_targets.h"
#include "reference/suite/run_identity.h"
#include "reference/text/file_text.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

// Defaults for meshes: libraries, the paper's last method without and with triangles, and ours.
const Names kForMeshes = {"fcl-aabb",   "embree",           "bullet-gimpact",
                          "bullet-vf",  "ffd-aabb-sphere2", "ffd-aabb-sphere2+tri",
                          "full-refit", "ffd-lazy"};

// Defaults for one mesh that meets itself: detectors of self-contact.
const Names kForItself = {"fcl-aabb", "embree", "full-refit", "ffd-lazy"};

// More, of a scene that is judged between frames.
const Names kForSteps = {"fcl-ccd", "embree-swept", "swept-aabb"};

void add_new(const std::string& name, Names& names) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

const OptionInfo* option_of(const DetectorCatalog& catalog, const DetectorSpec& spec,
                            const std::string& option) {
  for (const OptionInfo& o : catalog.find(spec.id)->options)
    if (o.name == option) return &o;
  return nullptr;
}

/// Names as given on the command line or by a suite, made those that run.
class DetectorNames {
 public:
  DetectorNames(const RunTargets& wanted, const DetectorCatalog& catalog)
      : wanted_(wanted), catalog_(catalog) {}

  Names resolved(const Names& given) {
    Names out;
    for (const std::string& name : given)
      for (const std::string& with_isa : with_isas(catalog_.parse(name).name))
        add_new(with_threads(with_isa), out);
    return out;
  }

  // An option that no detector takes would be a silent lie about what ran.
  void require_use_of_isas() const {
    if (!wanted_.isas.empty() && !isas_used_)
      throw InputError("--isa " + wanted_.isas.front() +
                       ": no detector of this run has instruction sets to choose from");
  }

 private:
  // What the name says already stays.
  std::string with(const std::string& name, const std::string& option,
                   const std::string& value) const {
    const DetectorSpec spec = catalog_.parse(name);
    const OptionInfo* info = option_of(catalog_, spec, option);
    if (info == nullptr || spec.options.at(option) != info->default_value) return name;
    const char* const mark = name.find(':') == std::string::npos ? ":" : ",";
    return catalog_.parse(name + mark + option + "=" + value).name;
  }

  std::string with_threads(const std::string& name) const {
    return with(name, "threads", std::to_string(wanted_.threads));
  }

  Names with_isas(const std::string& name) {
    if (wanted_.isas.empty()) return {name};
    if (option_of(catalog_, catalog_.parse(name), "isa") != nullptr) isas_used_ = true;
    Names out;
    for (const std::string& isa : wanted_.isas) add_new(with(name, "isa", isa), out);
    return out;
  }

  const RunTargets& wanted_;
  const DetectorCatalog& catalog_;
  bool isas_used_ = false;
};

bool is_file(const SceneTask& task, const fs::path& file) {
  const auto* own = std::get_if<fs::path>(&task.source);
  return own != nullptr && *own == file;
}

/// Puts a plan together, target by target.
class RunPlanner {
 public:
  RunPlanner(const RunTargets& wanted, const DetectorCatalog& catalog)
      : wanted_(wanted), catalog_(catalog), names_(wanted, catalog) {}

  RunPlan plan() {
    Names targets;  // those that are not drawn
    for (const std::string& name : wanted_.targets)
      if (!add_drawn(name)) targets.push_back(name);
    const bool any_drawn = targets.size() < wanted_.targets.size();
    if (wanted_.count && !any_drawn)
      throw InputError("--count: no target of this run is the suite drawn, whose scenes it counts");
    if (wanted_.steps && !any_drawn)
      throw InputError("--steps: no target of this run is the suite drawn, whose steps it draws");
    if (!wanted_.meshes.meshes.empty() && !any_drawn) {
      add_meshes(targets.empty() && !wanted_.pairs);
    } else if (wanted_.targets.empty() && !wanted_.pairs) {
      targets.push_back("default");
    }
    for (const std::string& name : targets) add_target(name);
    if (wanted_.pairs)
      plan_.scenes.push_back(
          {"", *wanted_.pairs, names_.resolved(given_or(detectors_for_scenes("hard"))), {}});
    names_.require_use_of_isas();
    return std::move(plan_);
  }

  /// Places of the scenes whose detectors nobody has chosen.
  const std::set<std::size_t>& usual() const { return usual_; }

 private:
  // Detectors that are asked for run in place of all others.
  Names given_or(const Names& usual) const {
    return wanted_.detectors.empty() ? usual : wanted_.detectors;
  }

  // Those of a suite for scenes that it does not name; read only where they are needed.
  Names detectors_for_scenes(const char* suite) const {
    if (!wanted_.detectors.empty()) return {};
    return scene::load_suite(scene::find_target(suite, fixtures_).file).detectors;
  }

  bool add_drawn(const std::string& name) {
    const std::optional<DrawnTarget> drawn = find_drawn(name, wanted_);
    if (!drawn) return false;
    const Names resolved = names_.resolved(given_or(drawn->detectors));
    for (const scene::DrawnSpec& spec : drawn->scenes)
      plan_.scenes.push_back({"", spec, resolved, {}});
    return true;
  }

  // Paths in the text are relative to where it will lie, so that it can be kept as it is.
  void add_meshes(bool alone) {
    const fs::path& kept = wanted_.save_scene;
    const fs::path folder = kept.empty() ? fs::current_path()
                            : alone      ? fs::absolute(kept).parent_path()
                                         : fs::absolute(kept);
    const Names& usual = wanted_.meshes.meets_itself() ? kForItself : kForMeshes;
    plan_.scenes.push_back(
        {"", scene::mesh_scene(wanted_.meshes, folder), names_.resolved(given_or(usual)), {}});
  }

  void add_target(const std::string& name) {
    const scene::Target target = scene::find_target(name, fixtures_);
    if (target.kind != scene::TargetKind::kSuite) {
      const std::size_t place = plan_.scenes.size();
      add_scene(target.file, detectors_for_scenes("default"));
      if (wanted_.detectors.empty() && plan_.scenes.size() > place) usual_.insert(place);
      return;
    }
    const scene::Suite suite = scene::load_suite(target.file);
    for (const scene::SuiteScene& scene : suite.scenes)
      add_scene(scene::file_of(scene, fixtures_),
                scene.detectors.empty() ? suite.detectors : scene.detectors);
    for (const scene::SuiteGoal& goal : suite.goals) add_goal(goal);
  }

  void add_scene(const fs::path& file, const Names& usual) {
    const Names resolved = names_.resolved(given_or(usual));
    for (const SceneTask& task : plan_.scenes)
      if (is_file(task, file)) return;
    plan_.scenes.push_back({"", file, resolved, {}});
  }

  void add_goal(const scene::SuiteGoal& wanted) {
    results::Goal& goal = plan_.goals.emplace_back();
    goal = {wanted.name,
            wanted.scene,
            catalog_.parse(wanted.detector).name,
            wanted.part,
            {},
            {},
            {},
            wanted.at_least,
            wanted.at_most};
    if (wanted.kind == scene::SuiteGoal::Kind::kPerPair) goal.per = "pair";
    if (wanted.kind == scene::SuiteGoal::Kind::kOverScene) goal.over_scene = wanted.other;
    if (wanted.kind != scene::SuiteGoal::Kind::kOver) return;
    goal.over = catalog_.parse(wanted.other).name;
    for (SceneTask& task : plan_.scenes)
      if (is_file(task, scene::find_scene(goal.scene, fixtures_)))
        add_new(goal.over, task.references);
  }

  const RunTargets& wanted_;
  const DetectorCatalog& catalog_;
  const fs::path fixtures_ = scene::fixtures_directory();
  DetectorNames names_;
  RunPlan plan_;
  std::set<std::size_t> usual_;
};

// Reads them, and fills in what a run knows of each.
void check_scenes(std::size_t frames, const DetectorCatalog& catalog,
                  const std::set<std::size_t>& usual, std::vector<SceneTask>& tasks) {
  std::set<std::string> ids;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    SceneTask& task = tasks[i];
    scene::Scene scene;
    if (const auto* drawn = std::get_if<scene::DrawnSpec>(&task.source)) {
      // Made where it is run: to make a thousand of them here takes minutes.
      scene.id = scene::drawn_id(*drawn);
      scene.frames = static_cast<std::size_t>(draw_parameters(*drawn).parameters.at("frames"));
    } else {
      scene = scene::load_any_scene(task.source, frames);
    }
    try {
      scene::check_simulation(catalog, scene);
    } catch (const InputError& e) {
      const auto* file = std::get_if<fs::path>(&task.source);
      throw InputError((file == nullptr ? "" : file->string() + ": ") + e.what());
    }
    if (usual.contains(i) && any_impact(scene.levels))
      for (const std::string& name : kForSteps) add_new(name, task.detectors);
    task.id = scene.id;
    task.frames = scene.frames;
    task.content = content_of(task.source, scene);
    if (!ids.insert(task.id).second)
      throw InputError("two scenes of this run have the id \"" + task.id + "\"");
  }
}

}  // namespace

RunPlan plan_run(const RunTargets& wanted, const DetectorCatalog& catalog) {
  RunPlanner planner(wanted, catalog);
  RunPlan plan = planner.plan();
  check_scenes(wanted.frames, catalog, planner.usual(), plan.scenes);
  return plan;
}

std::vector<std::string> detectors_of(const std::string& name) {
  const scene::Target target = scene::find_target(name, scene::fixtures_directory());
  if (target.kind != scene::TargetKind::kSuite)
    throw InputError("--detectors: " + text::in_quotes(name) + " is no suite");
  const scene::Suite suite = scene::load_suite(target.file);
  std::vector<std::string> out = suite.detectors;
  for (const scene::SuiteScene& scene : suite.scenes)
    for (const std::string& detector : scene.detectors) add_new(detector, out);
  return out;
}

}  // namespace contactcheck::suite
