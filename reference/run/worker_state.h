// What a worker holds while it works: the job, its scene, as judged or to be timed, and each
// detector with what is known of it so far.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/detect/registry.h"
#include "reference/results/results.h"
#include "reference/run/accuracy.h"
#include "reference/run/job.h"
#include "reference/run/judged_scene.h"
#include "reference/run/shared_progress.h"
#include "reference/run/surroundings.h"
#include "reference/scene/scene.h"

namespace contactcheck {

/// One detector of the job.
struct WorkerEntry {
  std::uint32_t position = 0;  ///< in the job's list
  DetectorSpec spec;
  std::unique_ptr<Detector> detector;  ///< none: not yet made, dismissed, or not usable
  results::Run run;
  AccuracyOutcome accuracy;

  bool usable() const { return run.ok(); }
};

/// Stays where it is: `judged` points to `scene`.
struct WorkerState {
  WorkerState(Job job_in, const DetectorCatalog& catalog_in, SharedProgress* shared,
              bool supervised)
      : job(std::move(job_in)), catalog(catalog_in), progress(shared), surroundings(supervised) {}
  WorkerState(const WorkerState&) = delete;
  WorkerState& operator=(const WorkerState&) = delete;

  bool judges() const { return job.turns.empty(); }

  Job job;
  const DetectorCatalog& catalog;
  ProgressWriter progress;
  Surroundings surroundings;
  Scene scene;
  JudgedScene judged;               ///< of a worker that judges
  std::vector<double> separations;  ///< per frame (separation.h)
  std::vector<WorkerEntry> entries;
  std::vector<TurnAnswer> timed;
};

}  // namespace contactcheck
