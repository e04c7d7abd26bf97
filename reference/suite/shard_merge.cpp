#include "reference/suite/shard_merge.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "core/types/check.h"
#include "reference/judge/contacts_json.h"
#include "reference/suite/finished_scene.h"
#include "reference/suite/job.h"
#include "reference/suite/out_folder.h"
#include "reference/suite/run_identity.h"
#include "reference/suite/suite_output.h"
#include "reference/text/file_text.h"
#include "reference/text/id_check.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const ShardResults& shard, const std::string& why) {
  throw InputError(shard.file.string() + ": " + why);
}

using Members = std::map<std::string, std::string>;

// A library may lie in another folder: its content counts.
Members plugins_of(const results::Results& results) {
  Members out;
  for (const results::Plugin& p : results.plugins)
    out[p.detector] = text::in_quotes(p.kind + " " + p.content + " " + p.version +
                                      (p.kind == "library" ? "" : " " + p.source));
  return out;
}

/// Holds one shard against the first.
class Comparison {
 public:
  Comparison(const ShardResults& first, const ShardResults& shard) : first_(first), shard_(shard) {}

  void require_same_run() const {
    const results::Results &first = first_.results, &own = shard_.results;
    same("field shard.of", std::to_string(first.shard->of), std::to_string(own.shard->of));
    same("the version of contactcheck", text::in_quotes(first.version),
         text::in_quotes(own.version));
    same("the program (field shard.program)", text::in_quotes(first.shard->program),
         text::in_quotes(own.shard->program));
    same_members("library", quoted(first.libraries), quoted(own.libraries));
    same_members("plug-in", plugins_of(first), plugins_of(own));
    const auto &first_settings = first.shard->settings, &own_settings = own.shard->settings;
    const Members first_setting{first_settings.begin(), first_settings.end()};
    same_members("setting", first_setting, {own_settings.begin(), own_settings.end()});
    same_scenes(first.shard->scenes, own.shard->scenes);
    if (first.shard->goals != own.shard->goals) differ("the goals of the suites are others");
    // Times of two machines do not go into one file.
    if (const auto timing = first_setting.find("timing");
        timing != first_setting.end() && timing->second == "true")
      same_members("machine", quoted(members_of(first.machine)), quoted(members_of(own.machine)));
  }

 private:
  static Members quoted(const std::vector<std::pair<std::string, std::string>>& texts) {
    Members out;
    for (const auto& [name, text] : texts) out[name] = text::in_quotes(text);
    return out;
  }
  [[noreturn]] void differ(const std::string& what) const {
    refuse(shard_, what + " than in " + first_.file.string() + ": these are shards of two runs");
  }
  void same(const std::string& what, const std::string& first, const std::string& own) const {
    if (first != own)
      refuse(shard_, what + " is " + own + ", in " + first_.file.string() + " it is " + first +
                         ": these are shards of two runs");
  }
  void same_members(const std::string& kind, const Members& first, const Members& own) const {
    Members all = first;
    all.insert(own.begin(), own.end());
    const auto value = [](const Members& members, const std::string& name) {
      const auto found = members.find(name);
      return found == members.end() ? "null" : found->second;
    };
    for (const auto& [name, ignored] : all)
      same(kind + " " + name, value(first, name), value(own, name));
  }
  void same_scenes(const std::vector<results::ShardScene>& first,
                   const std::vector<results::ShardScene>& own) const {
    same("the number of scenes", std::to_string(first.size()), std::to_string(own.size()));
    for (std::size_t i = 0; i < own.size(); ++i) {
      same("scene " + std::to_string(i + 1), text::in_quotes(first[i].id),
           text::in_quotes(own[i].id));
      if (first[i] != own[i])
        differ("scene " + text::in_quotes(own[i].id) +
               " has other detectors, or another file or meshes,");
    }
  }

  const ShardResults& first_;
  const ShardResults& shard_;
};

void require_shard(const ShardResults& shard) {
  if (!shard.results.shard)
    refuse(shard,
           "is no shard of a run (it has no field shard): merge takes what run --shard K/N "
           "has written");
  const Shard s = shard.shard();
  if (s.index < 1 || s.index > s.of) refuse(shard, "field shard: there is no shard " + s.name());
}

// Every scene that it holds, in order, with every detector, and nothing else.
void require_complete(const ShardResults& shard) {
  const std::vector<results::ShardScene>& run = shard.record().scenes;
  const std::vector<results::Scene>& scenes = shard.results.scenes;
  const std::vector<results::Run>& runs = shard.results.runs;
  std::size_t scene = 0, row = 0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (!shard.shard().holds(i)) continue;
    const std::string& id = run[i].id;
    if (!text::is_id(id)) refuse(shard, "field shard.scenes: no id: " + text::in_quotes(id));
    if (scene >= scenes.size() || scenes[scene].id != id)
      refuse(shard, "not complete: scene " + text::in_quotes(id) + " is not in its place");
    ++scene;
    for (const std::string& detector : run[i].detectors) {
      if (row >= runs.size() || runs[row].scene != id || runs[row].detector != detector)
        refuse(shard, "not complete: detector " + text::in_quotes(detector) + " on scene " +
                          text::in_quotes(id) + " is not in its place");
      ++row;
    }
  }
  if (scene < scenes.size() || row < runs.size())
    refuse(shard, "has scenes or runs that shard " + shard.shard().name() + " does not hold");
}

// Names of files come from outside: these are the only ones that a run gives.
void require_names(const ShardResults& shard) {
  for (const results::Scene& scene : shard.results.scenes)
    if (!scene.contacts.empty() && scene.contacts != judge::contacts_path(scene.id))
      refuse(shard, "no name of a contacts file: " + text::in_quotes(scene.contacts));
  for (const results::Run& run : shard.results.runs)
    if (!run.recording.empty() && run.recording != "recordings/" + run.scene + ".ccr")
      refuse(shard, "no name of a recording: " + text::in_quotes(run.recording));
  for (const results::Disagreement& d : shard.results.disagreements)
    if (!d.case_file.starts_with("cases/") || !text::is_id(d.case_file.substr(6)))
      refuse(shard, "no name of a case file: " + text::in_quotes(d.case_file));
}

void require_file(const ShardResults& shard, const std::string& name) {
  const fs::path file = shard.folder() / name;
  const auto hash = shard.record().files.find(name);
  if (!fs::is_regular_file(file))
    throw InputError(file.string() + ": is missing; shard " + shard.shard().name() +
                     " has written it");
  if (hash == shard.record().files.end() || hash->second != hash_of_file(file))
    throw InputError(file.string() + ": is damaged, or not the one that shard " +
                     shard.shard().name() + " has written");
}

void require_files(const ShardResults& shard) {
  require_names(shard);
  for (const results::Scene& scene : shard.results.scenes)
    if (!scene.contacts.empty()) require_file(shard, scene.contacts);
  std::string last;  // rows of one scene follow one another
  for (const results::Run& run : shard.results.runs) {
    if (!run.recording.empty() && run.recording != last) require_file(shard, run.recording);
    last = run.recording;
  }
  for (const results::Disagreement& d : shard.results.disagreements)
    require_file(shard, d.case_file);
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

namespace {

class Merger {
 public:
  Merger(const std::vector<ShardResults>& shards, const fs::path& out, const fs::path& scratch)
      : shards_(shards), out_(out), scratch_(scratch), output_(out, scratch) {
    for (const ShardResults& shard : shards) rows_.emplace_back(shard.results);
  }

  results::Results merge(const results::KnownDefects& known_defects, SuiteOutcome* outcome) {
    const results::Results& first = shards_.front().results;
    results::Results whole;
    whole.version = first.version;
    whole.command = first.shard->command;
    whole.machine = first.machine;
    whole.libraries = first.libraries;
    whole.plugins = first.plugins;
    whole.timing = first.timing;
    for (const ShardResults& shard : shards_) {
      whole.merged.push_back(shard.results.command);
      if (shard.results.resumed) whole.resumed.emplace();
    }
    const std::vector<results::ShardScene>& run = first.shard->scenes;
    for (std::size_t i = 0; i < run.size(); ++i) {
      const ShardResults& shard = shards_[i % shards_.size()];
      FinishedScene scene =
          finished_scene(rows_[i % shards_.size()], run[i].id, shard.folder(), scratch_);
      copy_recording(shard, scene.runs);
      output_.add(std::move(scene));
      if (shard.results.resumed && holds(*shard.results.resumed, run[i].id))
        whole.resumed->push_back(run[i].id);
    }
    return output_.write(std::move(whole), first.shard->goals, known_defects, outcome);
  }

 private:
  static bool holds(const std::vector<std::string>& ids, const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  }

  void copy_recording(const ShardResults& shard, const std::vector<results::Run>& runs) const {
    for (const results::Run& run : runs) {
      if (run.recording.empty()) continue;
      copy_file_to(shard.folder() / run.recording, scratch_ / "recording");
      rename_file(scratch_ / "recording", out_ / run.recording);
      return;  // it is the same for all
    }
  }

  const std::vector<ShardResults>& shards_;
  std::vector<results::Index> rows_;  ///< by shard
  fs::path out_, scratch_;
  SuiteOutput output_;
};

}  // namespace

results::Results merge_shards(const std::vector<ShardResults>& shards, const fs::path& out,
                              const results::KnownDefects& known_defects, SuiteOutcome* outcome) {
  make_out_folders(out);
  const ScratchFolder scratch(fs::absolute(out));
  make_contacts_folder(scratch.path());
  return Merger(shards, out, scratch.path()).merge(known_defects, outcome);
}

}  // namespace contactcheck::suite
