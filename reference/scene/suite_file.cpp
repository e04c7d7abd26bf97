#include "reference/scene/suite_file.h"

#include <algorithm>

#include "reference/scene/catalogue.h"
#include "reference/text/file_text.h"
#include "reference/text/id_check.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {
namespace {

namespace fs = std::filesystem;

void require_new(const text::JsonField& field, const std::string& name,
                 const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) != names.end()) field.refuse("named once only");
}

std::vector<std::string> parse_detectors(const text::JsonField& field) {
  std::vector<std::string> names;
  for (const text::JsonField& item : field.items(1)) {
    const std::string name = item.text();
    require_new(item, name, names);
    names.push_back(name);
  }
  return names;
}

// The folder as it is, so that a ".." in `path` leads out of it even where a link led in.
fs::path beside(const fs::path& suite, const fs::path& path) {
  return (fs::canonical(fs::absolute(suite).parent_path()) / path).lexically_normal();
}

fs::path parse_scene_path(const text::JsonField& field, const fs::path& suite) {
  const fs::path path = field.text();
  if (path.extension() != ".json" && path.extension() != ".ccr")
    field.refuse("the path of a scene file (.json) or of a recording (.ccr)");
  return beside(suite, path);
}

// "ID", or an object where the scene names its detectors or is a file.
SuiteScene parse_scene(const text::JsonField& field, const fs::path& suite) {
  SuiteScene scene;
  if (!field.is(text::JsonValue::Kind::kObject)) {
    scene.id = text::parse_id(field);
    return scene;
  }
  field.only_keys({"scene", "file", "detectors"});
  const bool by_file = field.exactly_one_of({"scene", "file"}) == "file";
  if (by_file)
    scene.file = parse_scene_path(field.at("file"), suite);
  else
    scene.id = text::parse_id(field.at("scene"));
  if (!by_file || field.has("detectors")) scene.detectors = parse_detectors(field.at("detectors"));
  return scene;
}

std::vector<SuiteScene> parse_scenes(const text::JsonField& field, const fs::path& suite) {
  std::vector<SuiteScene> scenes;
  std::vector<std::string> names;
  for (const text::JsonField& item : field.items(1)) {
    scenes.push_back(parse_scene(item, suite));
    const SuiteScene& scene = scenes.back();
    const std::string name = scene.file.empty() ? scene.id : scene.file.string();
    require_new(item, name, names);
    names.push_back(name);
  }
  return scenes;
}

SuiteGoal parse_goal(const text::JsonField& field) {
  constexpr text::NumberRange kAboveZero{0.0, true};
  field.only_keys(
      {"goal", "scene", "detector", "over", "over_scene", "per", "part", "at_least", "at_most"});
  SuiteGoal goal;
  goal.name = field.at("goal").text();
  goal.scene = text::parse_id(field.at("scene"));
  goal.detector = field.at("detector").text();
  const std::string kind = field.exactly_one_of({"over", "over_scene", "per"});
  if (kind == "over") {
    goal.other = field.at("over").text();
  } else if (kind == "over_scene") {
    goal.kind = SuiteGoal::Kind::kOverScene;
    goal.other = text::parse_id(field.at("over_scene"));
  } else {
    goal.kind = SuiteGoal::Kind::kPerPair;
    field.at("per").one_of({"pair"});
  }
  goal.part = field.at("part").one_of({"playback", "cold", "contact_frames"});
  const std::string bound = field.exactly_one_of({"at_least", "at_most"});
  (bound == "at_least" ? goal.at_least : goal.at_most) = field.at(bound).number(kAboveZero);
  return goal;
}

}  // namespace

Suite load_suite(const fs::path& file) {
  const std::string document = "suite file " + text::in_quotes(file.string());
  const text::JsonValue value =
      text::parse_json(text::read_file_bytes(file, "suite file"), document);
  const text::JsonField root(value, document);
  root.only_keys({"id", "title", "scenes", "detectors", "goals"});
  Suite suite;
  suite.id = text::parse_id(root.at("id"));
  suite.title = root.has("title") ? root.at("title").text() : suite.id;
  suite.scenes = parse_scenes(root.at("scenes"), file);
  suite.detectors = parse_detectors(root.at("detectors"));
  if (root.has("goals"))
    for (const text::JsonField& item : root.at("goals").items(1))
      suite.goals.push_back(parse_goal(item));
  return suite;
}

fs::path file_of(const SuiteScene& scene, const fs::path& fixtures) {
  return scene.file.empty() ? find_scene(scene.id, fixtures) : scene.file;
}

}  // namespace contactcheck::scene
