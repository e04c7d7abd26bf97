#include "reference/run/shard_record.h"

#include "reference/run/goals.h"
#include "reference/run/run_identity.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

Json scene_json(const SceneTask& task) {
  return {{"id", task.id},
          {"detectors", task.detectors},
          {"references", task.references},
          {"content", task.content}};
}

}  // namespace

Json shard_record(const SuiteRequest& request) {
  const ShardOfRun& part = *request.shard;
  Json settings = to_json(request.settings);
  settings.erase("detectors");  // are the scenes'
  for (Json& record : settings["plugins"]) {
    // The same bytes may lie in another folder: their hash stays.
    Json plugin = Json::parse(record.get<std::string>());
    if (plugin.at("kind") == "library") plugin.erase("source");
    record = plugin.dump();
  }
  Json goals = Json::array(), scenes = Json::array();
  for (const SuiteGoal& goal : request.goals) goals.push_back(to_json(goal));
  for (const SceneTask& task : part.run) scenes.push_back(scene_json(task));
  return {{"index", part.shard.index},
          {"of", part.shard.of},
          {"command", without_shard_flag(request.command, part.shard)},
          {"program", hash_of_file(request.executable)},
          {"settings", std::move(settings)},
          {"goals", std::move(goals)},
          {"scenes", std::move(scenes)}};
}

Json file_hashes(const NamedFiles& files) {
  Json out = Json::object();
  for (const auto& [name, file] : files) out[name] = hash_of_file(file);
  return out;
}

}  // namespace contactcheck
