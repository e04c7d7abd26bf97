#include "reference/suite/worker.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/judge/closed_loop.h"
#include "reference/judge/contacts_json.h"
#include "reference/judge/scene_summary.h"
#include "reference/judge/separation.h"
#include "reference/process/exit_codes.h"
#include "reference/scene/any_scene.h"
#include "reference/scene/driven_simulation.h"
#include "reference/scene/simulate_scene.h"
#include "reference/scene/sweep_poses.h"
#include "reference/suite/case_file.h"
#include "reference/suite/guarded_call.h"
#include "reference/suite/worker_judging.h"
#include "reference/suite/worker_state.h"
#include "reference/timing/cache_sweep.h"
#include "reference/timing/lockstep.h"
#include "reference/timing/timing.h"

namespace contactcheck::suite {
namespace {

// The turns of a worker that times.

// `--threads` is for detectors that can use them; an option of that name is the detector's own, in
// which 0 is read as all that this machine has.
std::size_t threads_of(const WorkerState& worker, const WorkerEntry& entry) {
  std::size_t own = 1;
  if (const auto option = entry.spec.options.find("threads"); option != entry.spec.options.end()) {
    const std::string& text = option->second;  // of one from outside it may be any word
    std::from_chars(text.data(), text.data() + text.size(), own);
    if (own == 0) own = std::thread::hardware_concurrency();
  }
  return std::max<std::size_t>(own, worker.job.settings.threads);
}

// The detector says what it answers when it is made, here as when it was judged.
const judge::JudgedQuestion& judged_question(const WorkerState& worker, const Turn& turn,
                                             const Semantics& semantics) {
  const judge::JudgedAnswers& answers = worker.job.answers.at(turn.position);
  const bool same = std::equal(
      answers.begin(), answers.end(), semantics.questions.begin(), semantics.questions.end(),
      [](const judge::JudgedQuestion& judged, Question now) { return judged.question == now; });
  if (!same) throw std::runtime_error("it answers other questions than when it was judged");
  for (const judge::JudgedQuestion& judged : answers)
    if (judged.question == turn.question) return judged;
  throw std::logic_error("a turn of a question that was judged");
}

timing::PassRequest request_of(const WorkerState& worker, const Turn& turn,
                               const WorkerEntry& entry, timing::CacheSweep* sweep) {
  const Semantics semantics = entry.detector->semantics();
  timing::PassRequest request;
  request.position = turn.position;
  request.asked = {turn.question, turn.question == semantics.questions.front()};
  request.judged = &judged_question(worker, turn, semantics).frames;
  request.sweep = sweep;
  request.threads = threads_of(worker, entry);
  // One from outside has its process for itself (scene_run.cpp), and may have more.
  request.children = worker.job.turns.size() == 1;
  if (turn.cold) {
    request.frames = worker.job.cold_frames;
  } else {
    request.frames.resize(worker.scene.frames);
    std::iota(request.frames.begin(), request.frames.end(), std::size_t{0});
  }
  return request;
}

void take_turn(WorkerState& worker, const Turn& turn, WorkerEntry& entry,
               timing::CacheSweep* sweep) {
  TurnAnswer& answer = worker.timed.emplace_back();
  answer.turn = turn;
  if (entry.usable()) {
    guarded(worker, entry, [&] {
      make_detector(worker, entry);
      entry.detector->prepare(worker.scene.bodies);
      answer.lazy_map = !entry.detector->needs_vertices();
      answer.samples = timing::time_pass(worker.scene, request_of(worker, turn, entry, sweep),
                                         *entry.detector, worker.progress);
    });
    if (entry.detector) guarded(worker, entry, [&] { dismiss(worker, entry); });
  }
  answer.notes = std::exchange(entry.run.notes, {});
  if (entry.usable()) return;
  answer.error = entry.run.message + " (while timed)";
  answer.failed_frame = entry.run.failed_frame;
  answer.samples = {};
}

// Takes the job's turns in order: each a fresh instance, prepared outside the clock. A detector
// that throws in one, or answers otherwise than when it was judged, has no later ones.
void take_turns(WorkerState& worker) {
  const std::vector<Turn>& turns = worker.job.turns;
  std::optional<timing::CacheSweep> sweep;
  if (std::any_of(turns.begin(), turns.end(), [](const Turn& turn) { return turn.cold; }))
    sweep.emplace(timing::sweep_bytes());
  for (std::size_t i = 0; i < turns.size(); ++i) {
    worker.progress.part(static_cast<double>(i) / static_cast<double>(turns.size()));
    for (WorkerEntry& entry : worker.entries)
      if (entry.position == turns[i].position)
        take_turn(worker, turns[i], entry, turns[i].cold ? &*sweep : nullptr);
  }
}

// A worker's simulated scene with its detectors in the loop: what their errors and their time do to
// a simulation.

bool drives(const WorkerEntry& entry) {
  return entry.usable() && scene::why_no_driver(entry.run.semantics).empty();
}

std::vector<timing::LockstepEntry> lockstep_entries(WorkerState& worker) {
  std::vector<timing::LockstepEntry> lockstep;
  for (WorkerEntry& entry : worker.entries) {
    if (!drives(entry)) continue;
    std::unique_ptr<Detector> made;
    guarded(worker, entry, [&] {
      worker.progress.enter(entry.position, 0, process::Phase::kPrepare);
      made = worker.catalog.make(entry.spec);
    });
    if (made) lockstep.push_back({entry.position, std::move(made), 0, {}, ""});
  }
  return lockstep;
}

void end_lockstep(WorkerState& worker, timing::LockstepEntry& timed, WorkerEntry& entry) {
  if (timed.error.empty()) {
    entry.run.step_ms = timing::step_times(timed);
  } else {
    book_error(worker, timed.error, entry);
  }
  guarded(worker, entry, [&] {
    worker.progress.enter(entry.position, worker.progress.frame(), process::Phase::kDestroy);
    timed.detector.reset();
  });
}

void time_whole_steps(WorkerState& worker) {
  std::vector<timing::LockstepEntry> lockstep = lockstep_entries(worker);
  const DetectorSpec driver = worker.catalog.parse(worker.scene.simulation->driver);
  timing::LockstepSettings settings;
  settings.repeats = worker.job.settings.step_repeats;
  settings.sweep_bytes = timing::sweep_bytes();
  timing::run_lockstep(worker.scene, *worker.catalog.make(driver), settings, lockstep,
                       worker.progress);
  for (timing::LockstepEntry& timed : lockstep)
    for (WorkerEntry& entry : worker.entries)
      if (entry.position == timed.position) end_lockstep(worker, timed, entry);
}

// For every usable detector that can drive: the motion that it drives, judged (closed_loop.h),
// and, with timing, whole steps timed (lockstep.h).
// @pre worker.scene.simulation has a value
void simulate_with_detectors(WorkerState& worker) {
  for (WorkerEntry& entry : worker.entries) {
    if (!drives(entry)) continue;
    guarded(worker, entry, [&] {
      entry.run.closed_loop = judge::run_closed_loop(
          worker.scene, entry.position, [&] { return worker.catalog.make(entry.spec); },
          worker.progress);
    });
  }
  if (worker.job.settings.timing) time_whole_steps(worker);
}

// What a worker hands back to its parent: the answer file of its job, the cases beside it, and the
// scene's recording, which the workers that time read.

// Of a worker that judges. Numbers the cases of one answer.
class AnswerWriter {
 public:
  explicit AnswerWriter(const WorkerState& worker) : worker_(worker) {}

  void write() {
    const Job& job = worker_.job;
    answer_.scene = judge::scene_summary(worker_.judged, worker_.separations);
    if (job.unjudged) answer_.scene.unjudged = job.unjudged->why;
    answer_.contact_frames = worker_.judged.contact_frames;
    if (lists_contacts()) answer_.truth_contacts = judge::truth_contacts(worker_.judged);
    if (worker_.judged.pairs) add_cases("oracle", worker_.judged.pairs->disagreements);
    for (const WorkerEntry& entry : worker_.entries) add(entry);
    write_answer(job.answer_file, std::move(answer_));
  }

 private:
  void add(const WorkerEntry& entry) {
    DetectorAnswer& out = answer_.detectors.emplace_back();
    out.position = entry.position;
    out.run = entry.run;
    // To the processes that time.
    if (worker_.job.settings.timing) out.answers = entry.accuracy.answers;
    if (lists_contacts())
      out.contacts = judge::detector_contacts(entry.run, entry.accuracy.differences);
    add_cases(entry.spec.name, entry.accuracy.disagreements);
  }

  // `detector`: who is wrong; "oracle" where rational arithmetic contradicts it.
  void add_cases(const std::string& detector,
                 const std::vector<judge::Disagreement>& disagreements) {
    for (judge::Disagreement d : disagreements) {
      d.scene = worker_.scene.id;
      d.detector = detector;
      d.case_file =
          worker_.job.answer_file.string() + ".case" + std::to_string(answer_.disagreements.size());
      write_case(d.case_file, worker_.judged, d, recording_of_cases());
      answer_.disagreements.push_back(d);  // its pair stands in the case file
    }
  }

  std::string recording_of_cases() const {
    if (worker_.scene.pairs) return "";  // see record_scene()
    return "../recordings/" + worker_.job.recording_file.filename().string();
  }

  // Random pairs are far too many for pictures; a scene that is refused or not judged has no truth.
  bool lists_contacts() const {
    return !worker_.scene.pairs && worker_.judged.refused.empty() && !worker_.job.unjudged;
  }

  const WorkerState& worker_;
  SceneAnswer answer_;
};

// The nodes of all frames, into the job's recording file. Of random pairs none: their number and
// seed say all, and take less room.
void record_scene(const WorkerState& worker) {
  const scene::Scene& scene = worker.scene;
  if (worker.job.recording_file.empty() || scene.pairs) return;
  Recording recording;
  recording.scene = scene.id;
  recording.bodies = scene.bodies;
  recording.time_step = scene.time_step;
  for (std::size_t f = 0; f < scene.frames; ++f)
    recording.frames.push_back(worker.judged.positions[f].nodes);
  write_recording(worker.job.recording_file, recording);
}

// Fills the frames of a simulated scene or a sweep from its recording, bit for bit those that were
// judged; nothing to do for other scenes.
// @throws InputError when it cannot be read, or has other frames or nodes than the scene
void replay_recording(const std::filesystem::path& file, scene::Scene& scene) {
  if (!scene.simulation && !scene.sweep) return;
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

// Of a worker that judges, every detector's result and contacts and what the next processes need
// to time the same frames; a case file (case_file.h) per disagreement. Of one that times, its
// turns.
void write_answer(WorkerState& worker) {
  worker.progress.enter(process::SharedProgress::kNoDetector, 0, process::Phase::kScene);
  if (worker.judges()) {
    AnswerWriter(worker).write();
    return;
  }
  SceneAnswer answer;
  answer.timed = std::move(worker.timed);
  write_answer(worker.job.answer_file, std::move(answer));
}

// Simulated motions and swept poses become frames here, as the scene's own work. A worker that
// times takes those that were judged: to make them again takes longer, and shows them to the
// scene's driver before it is timed.
void arrange_scene(WorkerState& worker) {
  scene::Scene& scene = worker.scene;
  const auto at = [&worker](std::size_t number) {
    worker.progress.enter(process::SharedProgress::kNoDetector, number, process::Phase::kScene);
  };
  scene = scene::load_any_scene(worker.job.scene, worker.job.settings.frames);
  if (scene.simulation) scene.simulation->settings.threads = worker.job.settings.threads;
  if (!worker.judges() && !worker.job.recording_file.empty()) {
    replay_recording(worker.job.recording_file, scene);
    return;
  }
  scene::record_simulation(worker.catalog, at, scene);
  scene::place_sweep(at, scene);
}

// Not even mapped: what passed a limit once would pass it again.
void leave_unjudged(WorkerState& worker) {
  worker.judged.scene = &worker.scene;
  end_all(worker, results::Status::kError, worker.job.unjudged->why, worker.job.unjudged->frame);
}

void judge(WorkerState& worker) {
  worker.judged = judge::judge_scene(worker.scene, worker.progress);
  if (!worker.judged.refused.empty()) {
    end_all(worker, results::Status::kRefused, worker.judged.refused);
    return;
  }
  record_scene(worker);
  worker.separations = judge::separations(worker.judged, worker.progress);
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
  worker.progress.enter(process::SharedProgress::kNoDetector, 0, process::Phase::kDone);
}

}  // namespace

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
