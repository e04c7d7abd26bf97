#include "reference/run/shard_merge.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/types/check.h"
#include "reference/run/job.h"
#include "reference/run/out_folder.h"
#include "reference/run/suite_output.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;

void copy_file_to(const fs::path& file, const fs::path& target) {
  std::error_code error;
  fs::copy_file(file, target, fs::copy_options::overwrite_existing, error);
  if (error) throw InputError("cannot write \"" + target.string() + "\": " + error.message());
}

class Merger {
 public:
  Merger(const std::vector<ShardResults>& shards, const fs::path& out, const fs::path& scratch)
      : shards_(shards), out_(out), scratch_(scratch), output_(out, scratch) {
    for (const ShardResults& shard : shards) rows_.emplace_back(shard.results);
  }

  results::Results merge(const KnownDefects& known_defects, SuiteOutcome* outcome) {
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
      output_.add(scene_of(shard, rows_[i % shards_.size()], run[i].id));
      if (shard.results.resumed && holds(*shard.results.resumed, run[i].id))
        whole.resumed->push_back(run[i].id);
    }
    return output_.write(std::move(whole), first.shard->goals, known_defects, outcome);
  }

 private:
  static bool holds(const std::vector<std::string>& ids, const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  }

  FinishedScene scene_of(const ShardResults& shard, const results::Index& rows,
                         const std::string& id) {
    FinishedScene finished;
    finished.scene = *rows.scene(id);
    for (const results::Run* run : rows.runs_of(id)) finished.runs.push_back(*run);
    for (const results::Disagreement& disagreement : shard.results.disagreements)
      if (disagreement.scene == id)
        finished.disagreements.push_back(with_case(shard, disagreement));
    if (!finished.scene.contacts.empty())
      finished.contacts = read_text_file(shard.folder() / finished.scene.contacts);
    copy_recording(shard, finished.runs);
    return finished;
  }

  // A copy of its case file, for the output to move.
  results::Disagreement with_case(const ShardResults& shard, results::Disagreement disagreement) {
    const fs::path copy = scratch_ / ("merged" + std::to_string(cases_++));
    copy_file_to(shard.folder() / disagreement.case_file, copy);
    disagreement.case_file = copy.string();
    return disagreement;
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
  std::size_t cases_ = 0;
};

}  // namespace

results::Results merge_shards(const std::vector<ShardResults>& shards, const fs::path& out,
                              const KnownDefects& known_defects, SuiteOutcome* outcome) {
  make_out_folders(out);
  const ScratchFolder scratch(fs::absolute(out));
  make_contacts_folder(scratch.path());
  return Merger(shards, out, scratch.path()).merge(known_defects, outcome);
}

}  // namespace contactcheck
