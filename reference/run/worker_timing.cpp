#include "reference/run/worker_timing.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "reference/run/guarded_call.h"
#include "reference/run/timing.h"
#include "reference/run/worker_judging.h"

namespace contactcheck {
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
const JudgedQuestion& judged_question(const WorkerState& worker, const Turn& turn,
                                      const Semantics& semantics) {
  const JudgedAnswers& answers = worker.job.answers.at(turn.position);
  const bool same = std::equal(
      answers.begin(), answers.end(), semantics.questions.begin(), semantics.questions.end(),
      [](const JudgedQuestion& judged, Question now) { return judged.question == now; });
  if (!same) throw std::runtime_error("it answers other questions than when it was judged");
  for (const JudgedQuestion& judged : answers)
    if (judged.question == turn.question) return judged;
  throw std::logic_error("a turn of a question that was judged");
}

PassRequest request_of(const WorkerState& worker, const Turn& turn, const WorkerEntry& entry,
                       CacheSweep* sweep) {
  const Semantics semantics = entry.detector->semantics();
  PassRequest request;
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

void take_turn(WorkerState& worker, const Turn& turn, WorkerEntry& entry, CacheSweep* sweep) {
  TurnAnswer& answer = worker.timed.emplace_back();
  answer.turn = turn;
  if (entry.usable()) {
    guarded(worker, entry, [&] {
      make_detector(worker, entry);
      entry.detector->prepare(worker.scene.bodies);
      answer.lazy_map = !entry.detector->needs_vertices();
      answer.samples = time_pass(worker.scene, request_of(worker, turn, entry, sweep),
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

}  // namespace

void take_turns(WorkerState& worker) {
  const std::vector<Turn>& turns = worker.job.turns;
  std::optional<CacheSweep> sweep;
  if (std::any_of(turns.begin(), turns.end(), [](const Turn& turn) { return turn.cold; }))
    sweep.emplace(sweep_bytes());
  for (std::size_t i = 0; i < turns.size(); ++i) {
    worker.progress.part(static_cast<double>(i) / static_cast<double>(turns.size()));
    for (WorkerEntry& entry : worker.entries)
      if (entry.position == turns[i].position)
        take_turn(worker, turns[i], entry, turns[i].cold ? &*sweep : nullptr);
  }
}

}  // namespace contactcheck
