#include "reference/suite/suite_run.h"

#include "reference/adapters/register.h"
#include "reference/results/results.h"
#include "reference/suite/machine.h"
#include "reference/suite/out_folder.h"
#include "reference/suite/partial_results.h"
#include "reference/suite/run_identity.h"
#include "reference/suite/scene_run.h"
#include "reference/suite/shard_record.h"
#include "reference/suite/suite_output.h"
#include "reference/timing/cache_sweep.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;

// What a run says that has no scene.
results::Results record_of(const SuiteRequest& request) {
  results::Results record;
  record.version = CONTACTCHECK_VERSION;
  record.command = request.command;
  record.finding = request.finding;
  record.machine = describe_machine();
  for (const auto& library : adapters::library_versions()) record.libraries.push_back(library);
  record.plugins = request.plugins;
  const RunSettings& s = request.settings;
  if (s.timing) record.timing = {s.processes, s.one_pass_beyond, s.seed, timing::sweep_bytes()};
  if (request.resume) record.resumed.emplace();
  if (request.shard) record.shard = shard_record(request);
  return record;
}

}  // namespace

results::Results run_suite(const SuiteRequest& request, const SuiteListener& listener,
                           SuiteOutcome* outcome) {
  make_out_folders(request.out);
  const ScratchFolder scratch(fs::absolute(request.out));
  make_contacts_folder(scratch.path());
  const PartialResults partial(request.out, scratch.path());
  if (!request.resume) partial.clear();
  const RunIdentity identity(request);
  SuiteOutput output(request.out, scratch.path());
  results::Results record = record_of(request);
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
    std::optional<FinishedScene> finished;
    if (request.resume) finished = partial.take(task.id, identity.of(task));
    const bool resumed_now = finished.has_value();
    if (resumed_now) {
      record.resumed->push_back(task.id);
    } else {
      partial.drop(task.id);  // its recording will be replaced
      report({});
      finished = run_scene(request, task, scratch.path(), listener, report);
      partial.keep(task.id, identity.of(task), *finished);
    }
    listener.scene_end({task.id, resumed_now, finished->runs});
    output.add(std::move(*finished));
  }
  results::Results results =
      output.write(std::move(record), request.goals, request.known_defects, outcome);
  partial.clear();
  return results;
}

}  // namespace contactcheck::suite
