#include "reference/tune/scene_variant.h"

#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/text/file_text.h"

namespace contactcheck::tune {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Meshes are named from the scene's folder, which is another one now.
void make_paths_absolute(Json& mesh, const fs::path& folder) {
  if (mesh.is_object() && mesh.contains("file"))
    mesh["file"] = fs::absolute(folder / mesh["file"].get<std::string>()).lexically_normal();
}

}  // namespace

fs::path write_scene_variant(const fs::path& file, const std::string& suffix,
                             const ChangeScene& change, const fs::path& folder) {
  const std::string document = "scene file " + text::in_quotes(file.string());
  Json scene = Json::parse(text::read_file_bytes(file, "scene file"), nullptr, false);
  if (!scene.is_object() || !scene.contains("bodies") || !scene.contains("id"))
    throw InputError(document + " is no scene whose bodies could be others");
  const std::string id = scene["id"].get<std::string>() + "-" + suffix;
  scene["id"] = id;
  for (Json& body : scene["bodies"])
    if (body.contains("mesh")) make_paths_absolute(body["mesh"], file.parent_path());
  change(scene, document);
  fs::create_directories(folder);
  fs::path variant = folder / (id + ".json");
  write_file_atomically(variant, scene.dump(1) + "\n");
  return variant;
}

}  // namespace contactcheck::tune
