#include "reference/suite/suite_run.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/results/results.h"
#include "reference/suite/machine.h"
#include "reference/suite/out_folder.h"
#include "reference/suite/partial_results.h"
#include "reference/suite/run_identity.h"
#include "reference/suite/scene_run.h"
#include "reference/suite/shard_record.h"
#include "reference/suite/suite_output.h"
#include "reference/text/counted.h"
#include "reference/text/lists.h"
#include "reference/timing/cache_sweep.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;

// What a run says that has no scene.
results::Results record_of(const SuiteRequest& request) {
  results::Results record;
  record.version = CONTACTCHECK_VERSION;
  record.command = request.command;
  record.machine = describe_machine();
  for (const auto& library : adapters::library_versions()) record.libraries.push_back(library);
  record.plugins = request.plugins;
  const RunSettings& s = request.settings;
  if (s.timing) record.timing = {s.processes, s.one_pass_beyond, s.seed, timing::sweep_bytes()};
  if (request.resume) record.resumed.emplace();
  if (request.shard) record.shard = shard_record(request);
  return record;
}

constexpr std::size_t kMostNamed = 5;  // scenes

// A class of another interpreter may be another one in the next run, under the same words.
bool known_again(const results::Results& record, const SceneTask& task) {
  return std::none_of(task.detectors.begin(), task.detectors.end(), [&](const std::string& name) {
    const results::Plugin* const plugin = record.plugin_of(name);
    return plugin != nullptr && plugin->transient;
  });
}

// Refuses to lose work: what an interrupted run has finished and this one does not take over.
void require_nothing_lost(const SuiteRequest& request, const RunIdentity& identity,
                          const std::vector<KeptScene>& kept) {
  std::vector<std::string> same, other;
  std::set<std::string> why;
  std::string command;
  for (const KeptScene& scene : kept) {
    const auto task = std::find_if(request.tasks.begin(), request.tasks.end(),
                                   [&](const SceneTask& t) { return t.id == scene.id; });
    const std::vector<std::string> changed = task == request.tasks.end()
                                                 ? std::vector<std::string>{"scenes"}
                                                 : differences(scene.identity, identity.of(*task));
    (changed.empty() ? same : other).push_back(scene.id);
    if (!changed.empty()) command = scene.command;
    why.insert(changed.begin(), changed.end());
  }
  const std::string left = "--out " + request.out.string() + ": an interrupted run has left " +
                           text::counted(kept.size(), "finished scene") + " there";
  if (!other.empty())
    throw InputError(
        left + ", of which " + text::shortened(other, kMostNamed) + " " +
        (other.size() == 1 ? "is" : "are") + " of another run (other " +
        text::joined(why, [](const std::string& name) { return name; }) + "): " + command +
        (same.empty() ? "; --overwrite discards them, another --out keeps them"
                      : "; --resume --overwrite takes over " + text::shortened(same, kMostNamed) +
                            " and discards the others"));
  if (!request.resume && !same.empty())
    throw InputError(left + " (" + text::shortened(same, kMostNamed) +
                     "): --resume takes them over, --overwrite discards them");
}

}  // namespace

results::Results run_suite(const SuiteRequest& request, const SuiteListener& listener,
                           SuiteOutcome* outcome) {
  make_out_folders(request.out);
  const ScratchFolder scratch(fs::absolute(request.out));
  make_contacts_folder(scratch.path());
  PartialResults partial(request.out, scratch.path());
  const RunIdentity identity(request);
  if (!request.overwrite) require_nothing_lost(request, identity, partial.kept());
  SuiteOutput output(request.out, scratch.path());
  std::map<std::string, FinishedScene> earlier;
  results::Results record = record_of(request);
  if (request.resume) {
    for (const SceneTask& task : request.tasks) {
      if (!known_again(record, task)) continue;
      auto scene = partial.take({task.id, identity.of(task), request.command});
      if (!scene) continue;
      output.write_contacts(*scene);  // which may be large
      earlier.emplace(task.id, std::move(*scene));
      record.resumed->push_back(task.id);
    }
    listener.resumed(*record.resumed);
  } else {
    partial.clear();
  }
  SuiteProgress progress;
  progress.scenes = request.tasks.size();
  for (; progress.scene < request.tasks.size(); ++progress.scene) {
    const SceneTask& task = request.tasks[progress.scene];
    progress.scene_id = task.id;
    progress.frames = task.frames;
    const auto report = [&](const WorkerProgress& worker) {
      progress.detector = worker.detector ? task.detectors[*worker.detector] : "";
      progress.frame = worker.frame;
      progress.share = (static_cast<double>(progress.scene) + worker.share) /
                       static_cast<double>(progress.scenes);
      listener.progress(progress);
    };
    const auto found = earlier.find(task.id);
    const bool resumed_now = found != earlier.end();
    FinishedScene finished;
    if (resumed_now) {
      finished = std::move(found->second);
    } else {
      report({});
      finished = run_scene(request, task, scratch.path(), listener, report);
      if (known_again(record, task)) {
        finished.hash = identity_hash(identity.of(task), finished, request.out);
        partial.keep({task.id, identity.of(task), request.command}, finished);
      }
    }
    listener.scene_end({task.id, resumed_now, finished.runs});
    output.add(std::move(finished));
  }
  results::Results results =
      output.write(std::move(record), request.goals, request.known_defects, outcome);
  partial.clear();
  return results;
}

}  // namespace contactcheck::suite
