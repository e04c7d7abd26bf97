#include "reference/cli/run_tasks.h"

#include <algorithm>

#include "core/types/check.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/suite_file.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

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
  DetectorNames(const RunArguments& arguments, const DetectorCatalog& catalog)
      : arguments_(arguments), catalog_(catalog) {}

  Names resolved(const Names& given) {
    Names out;
    for (const std::string& name : given)
      for (const std::string& with_isa : with_isas(catalog_.parse(name).name))
        add_new(with_threads(with_isa), out);
    return out;
  }

  // An option that nobody takes would be a silent lie about what ran.
  void require_use_of_isas() const {
    if (!arguments_.isas.empty() && !isas_used_)
      throw InputError("--isa " + arguments_.isas.front() +
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
    return with(name, "threads", std::to_string(arguments_.threads));
  }

  Names with_isas(const std::string& name) {
    if (arguments_.isas.empty()) return {name};
    if (option_of(catalog_, catalog_.parse(name), "isa") != nullptr) isas_used_ = true;
    Names out;
    for (const std::string& isa : arguments_.isas) add_new(with(name, "isa", isa), out);
    return out;
  }

  const RunArguments& arguments_;
  const DetectorCatalog& catalog_;
  bool isas_used_ = false;
};

class TaskMaker {
 public:
  TaskMaker(const RunArguments& arguments, const DetectorCatalog& catalog)
      : arguments_(arguments), catalog_(catalog), names_(arguments, catalog) {}

  RunTasks make() {
    Names targets = arguments_.targets;
    const bool meshes = !arguments_.meshes.meshes.empty();
    if (targets.empty() && !arguments_.pairs && !meshes) targets.push_back("default");
    if (meshes) add_meshes();
    for (const std::string& name : targets) {
      const Target target = find_target(name, fixtures_);
      if (target.kind == TargetKind::kSuite) {
        add_suite(load_suite(target.file));
      } else {
        add_scene(target.file, given_or_of("default"));
      }
    }
    if (arguments_.pairs) add_pairs(*arguments_.pairs);
    names_.require_use_of_isas();
    return std::move(tasks_);
  }

 private:
  // Of the command line; only where it names none is the suite needed.
  Names given_or_of(const char* suite) const {
    if (!arguments_.detectors.empty()) return arguments_.detectors;
    return load_suite(find_target(suite, fixtures_).file).detectors;
  }

  void add_suite(const Suite& suite) {
    for (const SuiteScene& scene : suite.scenes)
      add_scene(file_of(scene, fixtures_),
                scene.detectors.empty() ? suite.detectors : scene.detectors);
    for (const SuiteGoal& wanted : suite.goals) {
      results::Goal& goal = tasks_.goals.emplace_back();
      goal = {wanted.name,
              wanted.scene,
              catalog_.parse(wanted.detector).name,
              wanted.part,
              {},
              {},
              {},
              wanted.at_least,
              wanted.at_most};
      if (wanted.kind == SuiteGoal::Kind::kPerPair) goal.per = "pair";
      if (wanted.kind == SuiteGoal::Kind::kOverScene) goal.over_scene = wanted.other;
      if (wanted.kind != SuiteGoal::Kind::kOver) continue;
      goal.over = catalog_.parse(wanted.other).name;
      for (SceneTask& task : tasks_.scenes)
        if (task.file == find_scene(goal.scene, fixtures_)) add_new(goal.over, task.references);
    }
  }

  void add_scene(const fs::path& file, const Names& detectors) {
    const Names& chosen = arguments_.detectors.empty() ? detectors : arguments_.detectors;
    const Names resolved = names_.resolved(chosen);
    for (const SceneTask& task : tasks_.scenes)
      if (task.file == file) return;
    tasks_.scenes.push_back({"", file, resolved, {}});
  }

  // Paths in the text are relative to where it will lie, so that it can be kept as it is.
  void add_meshes() {
    const fs::path& kept = arguments_.save_scene;
    SceneTask task;
    task.detectors = names_.resolved(given_or_of("default"));
    task.text = mesh_scene(arguments_.meshes,
                           kept.empty() ? fs::current_path() : fs::absolute(kept).parent_path());
    tasks_.scenes.push_back(std::move(task));
  }

  void add_pairs(const PairSpec& pairs) {
    SceneTask task;
    task.detectors = names_.resolved(given_or_of("hard"));
    task.pairs = pairs;
    tasks_.scenes.push_back(std::move(task));
  }

  const RunArguments& arguments_;
  const DetectorCatalog& catalog_;
  const fs::path fixtures_ = fixtures_directory();
  DetectorNames names_;
  RunTasks tasks_;
};

}  // namespace

RunTasks make_tasks(const RunArguments& arguments, const DetectorCatalog& catalog) {
  return TaskMaker(arguments, catalog).make();
}

}  // namespace contactcheck
