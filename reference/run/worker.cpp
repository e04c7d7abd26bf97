#include "reference/run/worker.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/types/check.h"
#include "reference/arrange/sweep_poses.h"
#include "reference/run/exit_codes.h"
#include "reference/run/separation.h"
#include "reference/run/worker_answer.h"
#include "reference/run/worker_judging.h"
#include "reference/run/worker_simulation.h"
#include "reference/run/worker_state.h"
#include "reference/run/worker_timing.h"
#include "reference/scene/any_scene.h"
#include "reference/simulate/simulate_scene.h"

namespace contactcheck {
namespace {

Scene load(const Job& job) {
  if (job.pairs) return make_pairs_scene(*job.pairs);
  if (job.text) return load_scene_text(*job.text, job.settings.frames);
  return load_any_scene(job.scene_file, job.settings.frames);
}

// Simulated motions and swept poses become frames here, as the scene's own work. A worker that
// times takes those that were judged: to make them again takes longer, and shows them to the
// scene's driver before it is timed.
void arrange_scene(WorkerState& worker) {
  Scene& scene = worker.scene;
  const auto at = [&worker](std::size_t number) {
    worker.progress.enter(SharedProgress::kNoDetector, number, Phase::kScene);
  };
  scene = load(worker.job);
  if (scene.simulation) scene.simulation->settings.threads = worker.job.settings.threads;
  if (!worker.judges() && !worker.job.recording_file.empty()) {
    replay_recording(worker.job.recording_file, scene);
    return;
  }
  record_simulation(worker.catalog, at, scene);
  place_sweep(at, scene);
}

// Not even mapped: what passed a limit once would pass it again.
void leave_unjudged(WorkerState& worker) {
  worker.judged.scene = &worker.scene;
  end_all(worker, results::Status::kError, worker.job.unjudged->why, worker.job.unjudged->frame);
}

void judge(WorkerState& worker) {
  worker.judged = judge_scene(worker.scene, worker.progress);
  if (!worker.judged.refused.empty()) {
    end_all(worker, results::Status::kRefused, worker.judged.refused);
    return;
  }
  record_scene(worker);
  worker.separations = separations(worker.judged, worker.progress);
  judge_detectors(worker);
  if (worker.job.settings.closed_loop && worker.scene.simulation) simulate_with_detectors(worker);
}

// Only a scene that was judged is timed.
void judge_or_time(WorkerState& worker) {
  if (!worker.judges()) {
    take_turns(worker);
  } else if (worker.job.unjudged) {
    leave_unjudged(worker);
  } else {
    judge(worker);
  }
}

void work(WorkerState& worker) {
  arrange_scene(worker);
  add_entries(worker);
  judge_or_time(worker);
  worker.surroundings.restore();
  write_answer(worker);
  worker.progress.enter(SharedProgress::kNoDetector, 0, Phase::kDone);
}

}  // namespace

int run_worker(const std::filesystem::path& job_file, const DetectorCatalog& catalog,
               int progress_fd) {
  SharedProgress own;
  SharedProgress* shared = &own;
  if (progress_fd >= 0) shared = join_supervisor(progress_fd, &own);
  try {
    Job job = read_job(job_file);
    if (!job.temporary.empty()) setenv("TMPDIR", job.temporary.c_str(), 1);
    WorkerState worker(std::move(job), catalog, shared, progress_fd >= 0);
    work(worker);
    return 0;
  } catch (const InputError& e) {
    std::fprintf(stderr, "contactcheck: %s\n", e.what());
    return kExitBadInput;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "contactcheck: internal error: %s\n", e.what());
    return kExitInternal;
  }
}

}  // namespace contactcheck
