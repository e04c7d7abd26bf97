#include "reference/tune/scene_variant.h"

#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/text/file_text.h"

namespace contactcheck::tune {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

}  // namespace

fs::path write_scene_variant(const fs::path& file, const std::string& suffix,
                             const ChangeScene& change, const fs::path& folder) {
  const std::string document = "scene file " + text::in_quotes(file.string());
  Json scene = Json::parse(text::read_file_bytes(file, "scene file"), nullptr, false);
  if (!scene.is_object() || !scene.contains("bodies") || !scene.contains("id"))
    throw InputError(document + " is no scene whose bodies could be others");
  const std::string id = scene["id"].get<std::string>() + "-" + suffix;
  scene["id"] = id;
  // Meshes are named from the scene's folder, which is another one now.
  for (Json& body : scene["bodies"])
    if (body.contains("mesh") && body["mesh"].is_object() && body["mesh"].contains("file")) {
      Json& mesh = body["mesh"]["file"];
      mesh = fs::absolute(file.parent_path() / mesh.get<std::string>()).lexically_normal();
    }
  change(scene, document);
  fs::create_directories(folder);
  fs::path variant = folder / (id + ".json");
  write_file_atomically(variant, scene.dump(1) + "\n");
  return variant;
}

}  // namespace contactcheck::tune
