#include "reference/run/run_identity.h"

#include "core/types/hash.h"
#include "reference/adapters/register.h"
#include "reference/compare/run_result_json.h"
#include "reference/run/machine.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

void add_file(const std::filesystem::path& file, Fnv1a& hash) {
  const std::string bytes = read_text_file(file);
  hash.bytes(bytes.data(), bytes.size());
}

}  // namespace

std::string content_of(const std::filesystem::path& file, const Scene& scene) {
  return content_of(SceneText{read_text_file(file), "", ""}, scene);
}

std::string content_of(const SceneText& text, const Scene& scene) {
  Fnv1a hash;
  hash.bytes(text.text.data(), text.text.size());
  for (const Body& body : scene.bodies) {
    const std::uint64_t mesh = content_hash(body.shape->mesh);
    hash.bytes(&mesh, sizeof mesh);
  }
  for (const auto& frame : scene.recorded)
    for (const std::vector<Vec3>& nodes : frame)
      hash.bytes(nodes.data(), sizeof(Vec3) * nodes.size());
  return hex(hash.digest());
}

std::string content_of(const PairSpec& pairs) {
  return std::to_string(pairs.count) + " random pairs, seed " + std::to_string(pairs.seed);
}

std::string hash_of_file(const std::filesystem::path& file) {
  Fnv1a hash;
  add_file(file, hash);
  return hex(hash.digest());
}

RunIdentity::RunIdentity(const SuiteRequest& request) : settings_(request.settings) {
  common_ = {{"version", CONTACTCHECK_VERSION},
             {"program", hash_of_file(request.executable)},
             {"libraries", library_versions()},
             {"machine", describe_machine()}};
}

Json RunIdentity::of(const SceneTask& task) const {
  RunSettings settings = settings_;
  settings.detectors = task.detectors;
  Json identity = common_;
  identity["settings"] = to_json(settings);
  identity["references"] = task.references;
  identity["content"] = task.content;
  return identity;
}

}  // namespace contactcheck
