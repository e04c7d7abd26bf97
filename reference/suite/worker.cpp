#include "reference/suite/worker.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/judge/contacts_json.h"
#include "reference/judge/hover.h"
#include "reference/judge/judged_scene.h"
#include "reference/judge/scene_summary.h"
#include "reference/process/exit_codes.h"
#include "reference/process/float_environment.h"
#include "reference/scene/drawn_scene.h"
#include "reference/scene/simulate_scene.h"
#include "reference/scene/sweep_poses.h"
#include "reference/suite/case_file.h"
#include "reference/suite/worker_state.h"
#include "reference/text/printable.h"

namespace contactcheck::suite {
namespace {

// The nodes of all frames, into the job's recording file. Of random pairs none: their number and
// seed say all, and take less room.
void record_scene(const WorkerState& worker) {
  const scene::Scene& scene = worker.scene;
  if (worker.job.recording_file.empty() || scene.pairs()) return;
  Recording recording;
  recording.scene = scene.id;
  recording.bodies = scene.bodies;
  recording.time_step = scene.time_step;
  // Without levels, a recording is judged neither for self-contact nor for contact within steps.
  if (any_self(scene.levels) || any_impact(scene.levels)) recording.levels = scene.levels;
  for (std::size_t f = 0; f < scene.frames; ++f)
    recording.frames.push_back(worker.judged.positions[f].nodes);
  write_recording(worker.job.recording_file, recording);
}

// Fills the frames of a simulated scene or a sweep from its recording, bit for bit those that were
// judged; nothing to do for other scenes.
// @throws InputError when it cannot be read, or has other frames or nodes than the scene
void replay_recording(const std::filesystem::path& file, scene::Scene& scene) {
  if (!scene.simulation() && !scene.sweep()) return;
  Recording recording = read_recording(file);
  const bool same_nodes =
      std::equal(recording.bodies.begin(), recording.bodies.end(), scene.bodies.begin(),
                 scene.bodies.end(), [](const Body& recorded, const Body& body) {
                   return recorded.shape->node_count() == body.shape->node_count();
                 });
  if (recording.frames.size() != scene.frames || !same_nodes)
    throw InputError("recording \"" + file.string() + "\" has other frames or nodes than scene \"" +
                     scene.id + "\": one of them has changed since it was judged");
  scene.recorded = std::move(recording.frames);
}

// Simulated motions and swept poses become frames here, as the scene's own work. A worker that
// times takes those that were judged: to make them again takes longer, and shows them to the
// scene's driver before it is timed.
void arrange_scene(WorkerState& worker) {
  scene::Scene& scene = worker.scene;
  const auto* const drawn = std::get_if<scene::DrawnSpec>(&worker.job.scene);
  // Not even made: what passed a limit once would pass it again.
  if (drawn != nullptr && worker.job.unjudged) {
    scene = scene::unmade_scene(*drawn);
    return;
  }
  // What is timed of a drawn scene is all in its recording; to draw it again takes longer.
  if (drawn != nullptr && !worker.judges() && !worker.job.recording_file.empty()) {
    scene = scene::load_recording(worker.job.recording_file);
    return;
  }
  const auto at = [&worker](std::size_t number) {
    worker.progress.enter(process::SharedProgress::kNoDetector, number, process::Phase::kScene);
  };
  scene = scene::load_any_scene(worker.job.scene, worker.job.settings.frames);
  if (scene.simulation()) scene.simulation()->settings.threads = worker.job.settings.threads;
  if (!worker.judges() && !worker.job.recording_file.empty()) {
    replay_recording(worker.job.recording_file, scene);
    return;
  }
  scene::record_simulation(worker.catalog, at, scene);
  scene::place_sweep(at, scene);
}

// All detectors of the job but those that it skips; one that is absent says so already.
void add_entries(WorkerState& worker) {
  const std::vector<std::uint32_t>& skip = worker.job.skip;
  for (std::uint32_t i = 0; i < worker.job.settings.detectors.size(); ++i) {
    if (std::find(skip.begin(), skip.end(), i) != skip.end()) continue;
    WorkerEntry entry;
    entry.position = i;
    entry.spec = worker.catalog.parse(worker.job.settings.detectors[i]);
    entry.run.scene = worker.scene.id;
    entry.run.detector = entry.spec.name;
    entry.run.options = entry.spec.options;
    entry.run.frames = worker.scene.frames;
    const DetectorInfo* info = worker.catalog.find(entry.spec.id);
    if (!info->absent_because.empty()) {
      entry.run.status = results::Status::kAbsent;
      entry.run.message = info->absent_because;
    }
    worker.entries.push_back(std::move(entry));
  }
}

// Ends every detector that could have run on a scene that was refused or cannot be judged.
void end_all(WorkerState& worker, results::Status status, const std::string& message,
             std::optional<std::size_t> failed_frame = {}) {
  for (WorkerEntry& entry : worker.entries) {
    if (!entry.usable()) continue;
    entry.run.status = status;
    entry.run.failed_frame = failed_frame;
    entry.run.message = message;
  }
}

// Every usable detector is made, runs over all frames, is judged and destroyed: one that crashes
// there cannot be used.
void judge_detectors(WorkerState& worker) {
  judge::JudgingTools tools(worker.judged);
  const auto count = static_cast<double>(worker.entries.size());
  for (std::size_t i = 0; i < worker.entries.size(); ++i) {
    WorkerEntry& entry = worker.entries[i];
    worker.progress.part(judge::kShareOfTruth + 0.9 * static_cast<double>(i) / count);
    if (!entry.usable()) continue;
    guarded(worker, entry, [&] {
      make_detector(worker, entry);
      entry.accuracy =
          judge::run_accuracy(tools, entry.position, *entry.detector, worker.progress, entry.run);
      judge::measure_hover_gaps(tools, entry.position, *entry.detector, worker.progress, entry.run);
    });
    if (entry.detector) guarded(worker, entry, [&] { dismiss(worker, entry); });
  }
}

// Every detector's result and contacts, and what the next processes need to time the same frames.
// Each disagreement has a case file (case_file.h), numbered in the order of the answer.
SceneAnswer judged_answer(const WorkerState& worker) {
  const Job& job = worker.job;
  const judge::JudgedScene& judged = worker.judged;
  // Random pairs are far too many for pictures; a scene that is refused or not judged has no truth.
  const bool lists_contacts = !worker.scene.pairs() && judged.refused.empty() && !job.unjudged;
  // Random pairs are not recorded.
  const std::string recording =
      worker.scene.pairs() ? "" : "../recordings/" + job.recording_file.filename().string();
  SceneAnswer answer;
  // `detector`: who is wrong; "oracle" where rational arithmetic contradicts it.
  const auto add_cases = [&](const std::string& detector,
                             const std::vector<judge::Disagreement>& disagreements) {
    for (judge::Disagreement d : disagreements) {
      d.scene = worker.scene.id;
      d.detector = detector;
      d.case_file =
          job.answer_file.string() + ".case" + std::to_string(answer.disagreements.size());
      write_case(d.case_file, judged, d, recording);
      answer.disagreements.push_back(d);  // its pair is in the case file
    }
  };
  answer.scene = judge::scene_summary(judged, worker.separations);
  if (job.unjudged) answer.scene.unjudged = job.unjudged->why;
  answer.contact_frames = judged.contact_frames;
  answer.contact_steps = judged.contact_steps();
  if (lists_contacts) answer.truth_contacts = judge::truth_contacts(judged);
  if (judged.pairs) add_cases("oracle", judged.pairs->disagreements);
  for (const WorkerEntry& entry : worker.entries) {
    DetectorAnswer& out = answer.detectors.emplace_back();
    out.position = entry.position;
    out.run = entry.run;
    if (job.settings.timing) out.answers = entry.accuracy.answers;
    if (lists_contacts)
      out.contacts =
          judge::detector_contacts(entry.run, worker.scene.bodies, entry.accuracy.differences);
    add_cases(entry.spec.name, entry.accuracy.disagreements);
  }
  return answer;
}

// From the job to its answer.
void work(WorkerState& worker) {
  arrange_scene(worker);
  add_entries(worker);
  if (!worker.judges()) {
    take_turns(worker);
  } else if (worker.job.unjudged) {
    // Not even mapped: what passed a limit once would pass it again.
    worker.judged.scene = &worker.scene;
    end_all(worker, results::Status::kError, worker.job.unjudged->why, worker.job.unjudged->frame);
  } else {
    worker.judged = judge::judge_scene(worker.scene, worker.progress);
    if (!worker.judged.refused.empty()) {
      end_all(worker, results::Status::kRefused, worker.judged.refused);
    } else {
      record_scene(worker);
      worker.separations = judge::separations(worker.judged, worker.progress);
      judge_detectors(worker);
      if (worker.job.settings.closed_loop && worker.scene.simulation())
        simulate_with_detectors(worker);
    }
  }
  worker.surroundings.restore();
  worker.progress.enter(process::SharedProgress::kNoDetector, 0, process::Phase::kScene);
  SceneAnswer answer;
  if (worker.judges()) {
    answer = judged_answer(worker);
  } else {
    answer.timed = std::move(worker.timed);
  }
  write_answer(worker.job.answer_file, std::move(answer));
  worker.progress.enter(process::SharedProgress::kNoDetector, 0, process::Phase::kDone);
}

// The bodies of hard cases are as they are; a body of a scene file can be given a lattice.
std::string lattice_cure(const scene::Scene& scene, const std::string& refusal) {
  if (scene.family() || refusal.find("lattice") == std::string::npos) return "";
  return std::string("; a body of a scene file gets one by \"lattice\": {\"kept\": 150") +
         (scene.recorded.empty() ? "}" : ", \"fit\": true}");
}

}  // namespace

// What a detector throws is its own result; what the suite throws ends the worker.
void guarded(WorkerState& worker, WorkerEntry& entry, const std::function<void()>& work) {
  const process::FloatEnvironmentGuard guard;
  try {
    work();
  } catch (const Unavailable& e) {
    entry.run.status = results::Status::kAbsent;
    entry.run.message = e.what();
  } catch (const RefusedInput& e) {
    entry.run.status = results::Status::kRefused;
    entry.run.failed_frame = worker.progress.frame();
    entry.run.message = e.what() + lattice_cure(worker.scene, e.what());
  } catch (...) {
    entry.run.status = results::Status::kError;
    entry.run.failed_frame = worker.progress.frame();
    entry.run.message =
        process::place_text(worker.scene.id, worker.progress.frame(), worker.progress.phase()) +
        ": " + text::current_exception_text();
  }
  guard.check_and_restore();  // whatever a call that threw has left behind
  // Emptying buffers may hang: that too is this detector's.
  worker.progress.enter(entry.position, worker.progress.frame(), process::Phase::kTrace);
  std::vector<std::string>& notes = entry.run.notes;
  for (const std::string& note : worker.surroundings.restore())
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

void make_detector(WorkerState& worker, WorkerEntry& entry) {
  worker.progress.enter(entry.position, 0, process::Phase::kPrepare);
  entry.detector = worker.catalog.make(entry.spec);
}

void dismiss(WorkerState& worker, WorkerEntry& entry) {
  worker.progress.enter(entry.position, worker.progress.frame(), process::Phase::kDestroy);
  entry.detector.reset();
}

int run_worker(const std::filesystem::path& job_file, const DetectorCatalog& catalog,
               int progress_fd) {
  process::SharedProgress own;
  process::SharedProgress* shared = &own;
  if (progress_fd >= 0) shared = process::join_supervisor(progress_fd, &own);
  try {
    Job job = read_job(job_file);
    if (!job.temporary.empty()) setenv("TMPDIR", job.temporary.c_str(), 1);
    WorkerState worker(std::move(job), catalog, shared, progress_fd >= 0);
    work(worker);
    return 0;
  } catch (const InputError& e) {
    std::fprintf(stderr, "contactcheck: %s\n", e.what());
    return process::kExitBadInput;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "contactcheck: internal error: %s\n", e.what());
    return process::kExitInternal;
  }
}

}  // namespace contactcheck::suite
