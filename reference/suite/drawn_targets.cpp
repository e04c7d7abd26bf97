#include "reference/suite/drawn_targets.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/draw_rules.h"
#include "reference/scene/drawn_scene.h"
#include "reference/text/file_text.h"
#include "reference/text/json_value.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;

constexpr const char *kSuite = "drawn", *kStepSuite = "drawn-steps";
constexpr std::size_t kUsualCount = 20;

bool is_file(const std::string& name) {
  std::error_code ignored;
  return fs::path(name).extension() == ".json" && fs::is_regular_file(name, ignored);
}

// "7-3": seed and number, without leading zeros.
std::optional<std::pair<std::uint64_t, std::uint64_t>> numbers_of(const std::string& text) {
  std::uint64_t seed = 0, number = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, seed);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != '-') return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, number);
  if (second.ec != std::errc() || second.ptr != end || seed > scene::kLargestDrawSeed ||
      number < 1 || number > scene::kMostDrawnScenes ||
      text != std::to_string(seed) + "-" + std::to_string(number))
    return std::nullopt;
  return std::pair(seed, number);
}

void check_flags(const std::string& name, const RunTargets& wanted) {
  if (wanted.frames > 0)
    throw InputError("--frames: the scenes of " + text::in_quotes(name) +
                     " are drawn with their frames and cannot be given others");
  const scene::MeshSceneRequest usual;
  if (wanted.meshes.motion != usual.motion || wanted.meshes.size != usual.size)
    throw InputError("--motion and --size: the scenes of " + text::in_quotes(name) +
                     " are drawn with motions and sizes of their own");
  for (const fs::path& mesh : wanted.meshes.meshes) scene::check_drawn_mesh(mesh);
}

bool names_files(const text::JsonValue& value) {
  if (value.kind == text::JsonValue::Kind::kObject &&
      (value.find("file") != nullptr || value.find("recording") != nullptr))
    return true;
  return std::any_of(value.items.begin(), value.items.end(), names_files);
}

// The scene file, as it may lie in the folder.
std::string text_of(const SceneTask& task, const fs::path& folder) {
  if (const auto* text = std::get_if<scene::SceneText>(&task.source)) return text->text;
  if (const auto* drawn = std::get_if<scene::DrawnSpec>(&task.source))
    return scene::draw_scene(*drawn, folder).text.text;
  const auto* file = std::get_if<fs::path>(&task.source);
  if (file == nullptr || file->extension() == ".ccr")
    throw InputError("--save-scene: scene " + text::in_quotes(task.id) +
                     " is no scene file and cannot be kept as one");
  const std::string text = text::read_file_bytes(*file, "scene file");
  std::error_code ignored;
  if (names_files(text::parse_json(text, file->string())) &&
      !fs::equivalent(fs::absolute(*file).parent_path(), folder, ignored))
    throw InputError("--save-scene: " + text::in_quotes(file->string()) +
                     " names files by their place from its own folder: save it there");
  return text;
}

// Where the scene files of this run lie.
fs::path folder_of(const fs::path& path, const std::vector<SceneTask>& run) {
  return run.size() == 1 ? fs::absolute(path).parent_path() : fs::absolute(path);
}

fs::path place_of(const fs::path& path, const std::vector<SceneTask>& run, const SceneTask& task) {
  return run.size() == 1 ? path : path / (task.id + ".json");
}

bool is_in(const std::vector<SceneTask>& tasks, const std::string& id) {
  return std::any_of(tasks.begin(), tasks.end(),
                     [&](const SceneTask& task) { return task.id == id; });
}

}  // namespace

std::optional<DrawnTarget> find_drawn(const std::string& name, const RunTargets& wanted) {
  scene::DrawnSpec spec;
  std::size_t first = 1, last = wanted.count.value_or(kUsualCount);
  spec.seed = wanted.seed;
  const bool named_steps = name == kStepSuite || name.starts_with(std::string(kStepSuite) + "-");
  const std::string suite = named_steps ? kStepSuite : kSuite;
  fs::path file = scene::fixtures_directory() /
                  (std::string(named_steps || wanted.steps ? kStepSuite : kSuite) + ".json");
  if (name.starts_with(suite + "-") && !is_file(name)) {
    const auto numbers = numbers_of(name.substr(suite.size() + 1));
    if (!numbers)
      throw InputError(text::in_quotes(name) + " is no drawn scene: " + suite +
                       "-S-I is scene I of seed S, with I from 1 to " +
                       std::to_string(scene::kMostDrawnScenes));
    spec.seed = numbers->first;
    first = last = numbers->second;
  } else if (is_file(name)) {
    const std::string text = text::read_file_bytes(name, "scene file");
    if (!scene::holds_draw_rules(text::parse_json(text, "scene file " + text::in_quotes(name))))
      return std::nullopt;
    file = name;
  } else if (name != suite) {
    return std::nullopt;
  }
  spec.rules = text::read_file_bytes(file, "rules file");
  spec.rules_name = "rules file " + text::in_quotes(file.string());
  spec.meshes = wanted.meshes.meshes;
  const scene::DrawRules rules = scene::parse_draw_rules(spec.rules, spec.rules_name);
  if (wanted.steps && !rules.steps)
    throw InputError("--steps: the " + spec.rules_name + " has no \"steps\"");
  DrawnTarget out;
  out.detectors = rules.detectors;
  check_flags(name, wanted);
  for (std::size_t number = first; number <= last; ++number) {
    spec.number = number;
    out.scenes.push_back(spec);
  }
  return out;
}

void save_scenes(const fs::path& path, const std::vector<SceneTask>& run,
                 const std::vector<SceneTask>& own) {
  if (path.empty()) return;
  const fs::path folder = folder_of(path, run);
  std::vector<std::pair<fs::path, std::string>> files;  // all are made before one is written
  for (const SceneTask& task : run) {
    if (std::holds_alternative<scene::DrawnSpec>(task.source) && !is_in(own, task.id)) continue;
    const fs::path file = place_of(path, run, task);
    std::string text = text_of(task, folder);
    if (!fs::exists(file)) {
      files.emplace_back(file, std::move(text));
    } else if (read_text_file(file) != text) {
      throw InputError("--save-scene: \"" + file.string() +
                       "\" is there already and is not written over");
    }
  }
  std::error_code error;
  if (run.size() > 1) fs::create_directories(path, error);
  if (error)
    throw InputError("--save-scene: folder " + text::in_quotes(path.string()) +
                     " cannot be made: " + error.message());
  for (const auto& [file, text] : files) write_file_atomically(file, text);
}

void save_redrawn(const fs::path& path, const std::vector<SceneTask>& run,
                  const std::vector<SceneTask>& own, const results::Results& results) {
  if (path.empty()) return;
  for (const results::Scene& scene : results.scenes) {
    if (!scene.drawn || scene.drawn->redrawn == 0 || !scene.unjudged.empty()) continue;
    for (SceneTask task : own) {
      auto* const drawn = std::get_if<scene::DrawnSpec>(&task.source);
      if (drawn == nullptr || task.id != scene.id) continue;
      drawn->redrawn = scene.drawn->redrawn;
      write_file_atomically(place_of(path, run, task),
                            scene::draw_scene(*drawn, folder_of(path, run)).text.text);
    }
  }
}

}  // namespace contactcheck::suite
