// What a worker hands back to its parent: the answer file of its job, the cases beside it, and the
// scene's recording, which the workers that time read.
#pragma once

#include <filesystem>

#include "reference/run/worker_state.h"

namespace contactcheck {

/// The nodes of all frames, into the job's recording file. Of random pairs none: their number and
/// seed say all, and take less room.
void record_scene(const WorkerState& worker);

/// Fills the frames of a simulated scene or a sweep from its recording, bit for bit those that were
/// judged; nothing to do for other scenes.
/// @throws InputError when it cannot be read, or has other frames or nodes than the scene
void replay_recording(const std::filesystem::path& file, Scene& scene);

/// Of a worker that judges, every detector's result and contacts and what the next processes need
/// to time the same frames; a case file (case_file.h) per disagreement. Of one that times, its
/// turns.
void write_answer(WorkerState& worker);

}  // namespace contactcheck
