// A worker that times: its turns, and detectors in the loop of a simulation.
#include <algorithm>
#include <charconv>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "reference/judge/closed_loop.h"
#include "reference/judge/judge.h"
#include "reference/results/rerun.h"
#include "reference/scene/driven_simulation.h"
#include "reference/suite/worker_state.h"
#include "reference/timing/cache_sweep.h"
#include "reference/timing/lockstep.h"
#include "reference/timing/timing.h"

namespace contactcheck::suite {
namespace {

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

TurnAnswer take_turn(WorkerState& worker, const Turn& turn, WorkerEntry& entry,
                     timing::CacheSweep* sweep) {
  TurnAnswer answer;
  answer.turn = turn;
  if (entry.usable()) {
    guarded(worker, entry, [&] {
      make_detector(worker, entry);
      entry.detector->expect({turn.question});
      entry.detector->prepare(worker.scene.bodies);
      answer.lazy_map = !entry.detector->needs_vertices();
      const Semantics semantics =
          judge::semantics_in(worker.scene.levels, entry.detector->semantics());
      timing::PassRequest request;
      request.position = turn.position;
      request.asked = judge::asked(turn.question, semantics);
      request.judged = &judged_question(worker, turn, semantics).frames;
      request.sweep = sweep;
      request.threads = threads_of(worker, entry);
      // One from outside has its process for itself (scene_run.cpp), and may have more.
      request.children = worker.job.turns.size() == 1;
      const bool of_steps = is_of_steps(turn.question);
      const std::size_t count = worker.scene.frames - (of_steps ? 1 : 0);
      request.frames =
          of_steps ? timing::cold_steps(worker.job.cold_frames, count) : worker.job.cold_frames;
      if (!turn.cold) {
        request.frames.resize(count);
        std::iota(request.frames.begin(), request.frames.end(), std::size_t{0});
      }
      answer.samples = timing::time_pass(worker.scene, request, *entry.detector, worker.progress);
    });
    if (entry.detector) guarded(worker, entry, [&] { dismiss(worker, entry); });
  }
  answer.notes = std::exchange(entry.run.notes, {});
  if (!entry.usable()) {
    answer.error = entry.run.message + results::kWhileTimed;
    answer.failed_frame = entry.run.failed_frame;
    answer.samples = {};
  }
  return answer;
}

bool drives(const WorkerEntry& entry) {
  return entry.usable() && scene::why_no_driver(entry.run.semantics).empty();
}

void time_whole_steps(WorkerState& worker) {
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
  const DetectorSpec driver = worker.catalog.parse(worker.scene.simulation()->driver);
  timing::LockstepSettings settings;
  settings.repeats = worker.job.settings.step_repeats;
  settings.sweep_bytes = timing::sweep_bytes();
  timing::run_lockstep(worker.scene, *worker.catalog.make(driver), settings, lockstep,
                       worker.progress);
  for (timing::LockstepEntry& timed : lockstep) {
    WorkerEntry& entry = *std::ranges::find(worker.entries, timed.position, &WorkerEntry::position);
    if (timed.error.empty()) {
      entry.run.step_ms = timing::step_times(timed);
    } else {
      entry.run.status = results::Status::kError;
      entry.run.message = "scene " + worker.scene.id + ", " + timed.error;
    }
    guarded(worker, entry, [&] {
      worker.progress.enter(entry.position, worker.progress.frame(), process::Phase::kDestroy);
      timed.detector.reset();
    });
  }
}

}  // namespace

void take_turns(WorkerState& worker) {
  const std::vector<Turn>& turns = worker.job.turns;
  std::optional<timing::CacheSweep> sweep;
  if (std::ranges::any_of(turns, &Turn::cold)) sweep.emplace(timing::sweep_bytes());
  for (std::size_t i = 0; i < turns.size(); ++i) {
    worker.progress.part(static_cast<double>(i) / static_cast<double>(turns.size()));
    const auto entry = std::ranges::find(worker.entries, turns[i].position, &WorkerEntry::position);
    if (entry != worker.entries.end())
      worker.timed.push_back(
          take_turn(worker, turns[i], *entry, turns[i].cold ? &*sweep : nullptr));
  }
}

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

}  // namespace contactcheck::suite
