// What a worker holds while it works: the job, its scene, as judged or to be timed, and each
// detector with what is known of it so far.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/detect/registry.h"
#include "reference/judge/accuracy.h"
#include "reference/judge/judged_scene.h"
#include "reference/process/shared_progress.h"
#include "reference/process/surroundings.h"
#include "reference/results/results.h"
#include "reference/scene/scene.h"
#include "reference/suite/job.h"

namespace contactcheck::suite {

/// One detector of the job.
struct WorkerEntry {
  std::uint32_t position = 0;  ///< in the job's list
  DetectorSpec spec;
  std::unique_ptr<Detector> detector;  ///< none: not yet made, dismissed, or not usable
  results::Run run;
  judge::AccuracyOutcome accuracy;

  bool usable() const { return run.ok(); }
};

/// Stays where it is: `judged` points to `scene`.
struct WorkerState {
  WorkerState(Job job_in, const DetectorCatalog& catalog_in, process::SharedProgress* shared,
              bool supervised)
      : job(std::move(job_in)), catalog(catalog_in), progress(shared), surroundings(supervised) {}
  WorkerState(const WorkerState&) = delete;
  WorkerState& operator=(const WorkerState&) = delete;

  bool judges() const { return job.turns.empty(); }

  Job job;
  const DetectorCatalog& catalog;
  process::ProgressWriter progress;
  process::Surroundings surroundings;
  scene::Scene scene;
  judge::JudgedScene judged;        ///< of a worker that judges
  std::vector<double> separations;  ///< per frame (judged_scene.h)
  std::vector<WorkerEntry> entries;
  std::vector<TurnAnswer> timed;
};

/// Does `work`, which calls the detector of `entry`. What it throws ends in the entry's status and
/// message: absent, refused, or an error with scene, frame and phase. What it changed for the whole
/// process is restored and noted.
void guarded(WorkerState& worker, WorkerEntry& entry, const std::function<void()>& work);

/// In calls of the detector's own, as all that follows: makes it, and destroys it.
void make_detector(WorkerState& worker, WorkerEntry& entry);
void dismiss(WorkerState& worker, WorkerEntry& entry);

// worker_timing.cpp

/// Takes the job's turns in order: each a fresh instance, prepared outside the clock. A detector
/// that throws in one, or answers otherwise than when it was judged, has no later ones.
void take_turns(WorkerState& worker);

/// For every usable detector that can drive the simulated scene: the motion that it drives, judged
/// (closed_loop.h), and, with timing, whole steps timed (lockstep.h).
/// @pre the worker's scene is simulated
void simulate_with_detectors(WorkerState& worker);

}  // namespace contactcheck::suite
