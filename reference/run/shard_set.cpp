#include "reference/run/shard_set.h"

#include <algorithm>
#include <string>

#include "core/types/check.h"
#include "reference/run/contacts_json.h"
#include "reference/run/run_identity.h"
#include "reference/scene/id_check.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

[[noreturn]] void refuse(const ShardResults& shard, const std::string& why) {
  throw InputError(shard.file.string() + ": " + why);
}

std::string quoted(const Json& value) { return value.dump(-1, ' ', true); }

/// Holds one shard against the first.
class Comparison {
 public:
  Comparison(const ShardResults& first, const ShardResults& shard) : first_(first), shard_(shard) {}

  void require_same_run() const {
    same("field shard.of", first_.record().at("of"), shard_.record().at("of"));
    same("the version of contactcheck", first_.results.at("version"), shard_.results.at("version"));
    same("the program (field shard.program)", first_.record().at("program"),
         shard_.record().at("program"));
    same_members("library", first_.results.at("libraries"), shard_.results.at("libraries"));
    same_members("setting", first_.record().at("settings"), shard_.record().at("settings"));
    same_scenes(first_.record().at("scenes"), shard_.record().at("scenes"));
    if (first_.record().at("goals") != shard_.record().at("goals"))
      differ("the goals of the suites are others");
    // Times of two machines do not go into one file.
    if (first_.record().at("settings").at("timing").get<bool>())
      same_members("machine", first_.results.at("machine"), shard_.results.at("machine"));
  }

 private:
  [[noreturn]] void differ(const std::string& what) const {
    refuse(shard_, what + " than in " + first_.file.string() + ": these are shards of two runs");
  }
  void same(const std::string& what, const Json& first, const Json& own) const {
    if (first != own)
      refuse(shard_, what + " is " + quoted(own) + ", in " + first_.file.string() + " it is " +
                         quoted(first) + ": these are shards of two runs");
  }
  void same_members(const std::string& kind, const Json& first, const Json& own) const {
    Json all = first;
    all.update(own);
    for (const auto& [key, ignored] : all.items())
      same(kind + " " + key, first.value(key, Json()), own.value(key, Json()));
  }
  void same_scenes(const Json& first, const Json& own) const {
    same("the number of scenes", first.size(), own.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      same("scene " + std::to_string(i + 1), first[i].at("id"), own[i].at("id"));
      if (first[i] != own[i])
        differ("scene " + quoted(own[i].at("id")) +
               " has other detectors, or another file or meshes,");
    }
  }

  const ShardResults& first_;
  const ShardResults& shard_;
};

void require_shard(const ShardResults& shard) {
  if (!shard.results.contains("shard"))
    refuse(shard,
           "is no shard of a run (it has no field shard): merge takes what run --shard K/N "
           "has written");
  const Shard s = shard.shard();
  if (s.index < 1 || s.index > s.of) refuse(shard, "field shard: there is no shard " + s.name());
}

// Every scene that it holds, in order, with every detector, and nothing else.
void require_complete(const ShardResults& shard) {
  const Json &run = shard.record().at("scenes"), &scenes = shard.results.at("scenes"),
             &runs = shard.results.at("runs");
  std::size_t scene = 0, row = 0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (!shard.shard().holds(i)) continue;
    const Json& id = run[i].at("id");
    if (!is_id(id.get<std::string>())) refuse(shard, "field shard.scenes: no id: " + quoted(id));
    if (scene >= scenes.size() || scenes[scene].at("id") != id)
      refuse(shard, "not complete: scene " + quoted(id) + " is not in its place");
    ++scene;
    for (const Json& detector : run[i].at("detectors")) {
      if (row >= runs.size() || runs[row].at("scene") != id || runs[row].at("detector") != detector)
        refuse(shard, "not complete: detector " + quoted(detector) + " on scene " + quoted(id) +
                          " is not in its place");
      ++row;
    }
  }
  if (scene < scenes.size() || row < runs.size())
    refuse(shard, "has scenes or runs that shard " + shard.shard().name() + " does not hold");
}

// Names of files come from outside: these are the only ones that a run gives.
void require_names(const ShardResults& shard) {
  for (const Json& scene : shard.results.at("scenes"))
    if (const std::string name = scene.value("contacts", "");
        !name.empty() && name != contacts_path(scene.at("id").get<std::string>()))
      refuse(shard, "no name of a contacts file: \"" + name + "\"");
  for (const Json& run : shard.results.at("runs"))
    if (const std::string name = run.value("recording", "");
        !name.empty() && name != "recordings/" + run.at("scene").get<std::string>() + ".ccr")
      refuse(shard, "no name of a recording: \"" + name + "\"");
  for (const Json& d : shard.results.at("disagreements")) {
    const std::string name = d.at("case").get<std::string>();
    if (!name.starts_with("cases/") || !is_id(name.substr(6)))
      refuse(shard, "no name of a case file: \"" + name + "\"");
  }
}

void require_file(const ShardResults& shard, const std::string& name) {
  const fs::path file = shard.folder() / name;
  const Json hash = shard.record().at("files").value(name, Json());
  if (!fs::is_regular_file(file))
    throw InputError(file.string() + ": is missing; shard " + shard.shard().name() +
                     " has written it");
  if (hash.is_null() || hash != hash_of_file(file))
    throw InputError(file.string() + ": is damaged, or not the one that shard " +
                     shard.shard().name() + " has written");
}

void require_files(const ShardResults& shard) {
  require_names(shard);
  for (const Json& scene : shard.results.at("scenes"))
    if (scene.contains("contacts")) require_file(shard, scene.at("contacts").get<std::string>());
  std::string last;  // rows of one scene follow one another
  for (const Json& run : shard.results.at("runs")) {
    const std::string name = run.value("recording", "");
    if (!name.empty() && name != last) require_file(shard, name);
    last = name;
  }
  for (const Json& d : shard.results.at("disagreements"))
    require_file(shard, d.at("case").get<std::string>());
}

// @pre all are of one run
void require_each_once(const std::vector<ShardResults>& sorted) {
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].shard().index == sorted[i - 1].shard().index)
      throw InputError(sorted[i - 1].file.string() + " and " + sorted[i].file.string() +
                       " are both shard " + sorted[i].shard().name());
  for (std::size_t i = 0; i < sorted.front().shard().of; ++i)
    if (i >= sorted.size() || sorted[i].shard().index != i + 1)
      throw InputError("shard " + Shard{i + 1, sorted.front().shard().of}.name() + " is missing");
}

}  // namespace

Shard ShardResults::shard() const {
  return {record().at("index").get<std::size_t>(), record().at("of").get<std::size_t>()};
}

std::vector<ShardResults> checked_shards(std::vector<ShardResults> shards) {
  for (const ShardResults& shard : shards) require_shard(shard);
  for (const ShardResults& shard : shards) Comparison(shards.front(), shard).require_same_run();
  std::stable_sort(shards.begin(), shards.end(),
                   [](const auto& a, const auto& b) { return a.shard().index < b.shard().index; });
  require_each_once(shards);
  for (const ShardResults& shard : shards) {
    require_complete(shard);
    require_files(shard);
  }
  return shards;
}

}  // namespace contactcheck
