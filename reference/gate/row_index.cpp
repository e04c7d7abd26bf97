#include "reference/gate/row_index.h"

#include <nlohmann/json.hpp>

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;
}  // namespace

RowIndex::RowIndex(const Json& results) : results_(&results) {
  for (const Json& run : results.at("runs")) {
    const auto scene = run.at("scene").get<std::string>();
    rows_.emplace(std::pair(scene, run.at("detector").get<std::string>()), &run);
    scenes_.emplace(scene, nullptr);
  }
  if (results.contains("scenes"))
    for (const Json& entry : results.at("scenes"))
      scenes_[entry.at("id").get<std::string>()] = &entry;
}

const Json* RowIndex::row(const std::string& scene, const std::string& detector) const {
  const auto found = rows_.find({scene, detector});
  return found == rows_.end() ? nullptr : found->second;
}

const Json* RowIndex::scene(const std::string& id) const {
  const auto found = scenes_.find(id);
  return found == scenes_.end() ? nullptr : found->second;
}

bool RowIndex::has_scene(const std::string& id) const { return scenes_.count(id) > 0; }

std::string text_at(const nlohmann::ordered_json& object, const char* key) {
  return object.at(key).get<std::string>();
}

}  // namespace contactcheck
