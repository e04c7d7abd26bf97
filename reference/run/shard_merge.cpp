#include "reference/run/shard_merge.h"

#include <nlohmann/json.hpp>
#include <string>

#include "core/types/check.h"
#include "reference/run/goals.h"
#include "reference/run/job.h"
#include "reference/run/out_folder.h"
#include "reference/run/suite_output.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

void copy_file_to(const fs::path& file, const fs::path& target) {
  std::error_code error;
  fs::copy_file(file, target, fs::copy_options::overwrite_existing, error);
  if (error) throw InputError("cannot write \"" + target.string() + "\": " + error.message());
}

class Merger {
 public:
  Merger(const std::vector<ShardResults>& shards, const fs::path& out, const fs::path& scratch)
      : shards_(shards), out_(out), scratch_(scratch), output_(out, scratch) {}

  Json merge(const KnownDefects& known_defects, SuiteOutcome* outcome) {
    const Json& run = shards_.front().record().at("scenes");
    for (std::size_t i = 0; i < run.size(); ++i)
      output_.add(scene_of(shards_[i % shards_.size()], run[i].at("id").get<std::string>()));
    SuiteRecord record{head(), tail(), {}, known_defects, false};
    for (const Json& goal : shards_.front().record().at("goals"))
      record.goals.push_back(goal_from(goal));
    return output_.write(record, outcome);
  }

 private:
  Json head() const {
    const Json& first = shards_.front().results;
    Json head = {{"schema", first.at("schema")},
                 {"version", first.at("version")},
                 {"command", shards_.front().record().at("command")},
                 {"machine", first.at("machine")},
                 {"libraries", first.at("libraries")}};
    if (first.contains("plugins")) head["plugins"] = first.at("plugins");
    return head;
  }

  // Scenes that any shard took over from an interrupted run, in the order of the run.
  Json resumed() const {
    Json out = Json::array();
    const Json& run = shards_.front().record().at("scenes");
    for (std::size_t i = 0; i < run.size(); ++i)
      for (const Json& id : shards_[i % shards_.size()].results.value("resumed", Json::array()))
        if (id == run[i].at("id")) out.push_back(id);
    return out;
  }

  Json tail() const {
    Json tail = Json::object(), commands = Json::array();
    bool any_resumed = false;
    for (const ShardResults& shard : shards_) {
      any_resumed = any_resumed || shard.results.contains("resumed");
      commands.push_back(shard.results.at("command"));
    }
    if (any_resumed) tail["resumed"] = resumed();
    tail["merged"] = std::move(commands);
    return tail;
  }

  FinishedScene scene_of(const ShardResults& shard, const std::string& id) {
    FinishedScene finished;
    for (const Json& scene : shard.results.at("scenes"))
      if (scene.at("id") == id) finished.scene = scene;
    for (const Json& run : shard.results.at("runs"))
      if (run.at("scene") == id) finished.runs.push_back(run);
    for (const Json& disagreement : shard.results.at("disagreements"))
      if (disagreement.at("scene") == id)
        finished.disagreements.push_back(with_case(shard, disagreement));
    if (const std::string name = finished.scene.value("contacts", ""); !name.empty())
      finished.contacts = read_text_file(shard.folder() / name);
    copy_recording(shard, finished.runs);
    return finished;
  }

  // A copy of its case file, for the output to move.
  Json with_case(const ShardResults& shard, Json disagreement) {
    const fs::path copy = scratch_ / ("merged" + std::to_string(cases_++));
    copy_file_to(shard.folder() / disagreement.at("case").get<std::string>(), copy);
    disagreement["case"] = copy.string();
    return disagreement;
  }

  void copy_recording(const ShardResults& shard, const Json& runs) const {
    for (const Json& run : runs) {
      const std::string name = run.value("recording", "");
      if (name.empty()) continue;
      copy_file_to(shard.folder() / name, scratch_ / "recording");
      rename_file(scratch_ / "recording", out_ / name);
      return;  // it is the same for all
    }
  }

  const std::vector<ShardResults>& shards_;
  fs::path out_, scratch_;
  SuiteOutput output_;
  std::size_t cases_ = 0;
};

}  // namespace

Json merge_shards(const std::vector<ShardResults>& shards, const fs::path& out,
                  const KnownDefects& known_defects, SuiteOutcome* outcome) {
  make_out_folders(out);
  const ScratchFolder scratch(fs::absolute(out));
  make_contacts_folder(scratch.path());
  return Merger(shards, out, scratch.path()).merge(known_defects, outcome);
}

}  // namespace contactcheck
