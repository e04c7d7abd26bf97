#include "reference/suite/guarded_call.h"

#include <algorithm>

#include "core/types/check.h"
#include "reference/process/float_environment.h"
#include "reference/text/printable.h"

namespace contactcheck::suite {
namespace {

void add_note(const std::string& note, results::Run& run) {
  if (std::find(run.notes.begin(), run.notes.end(), note) == run.notes.end())
    run.notes.push_back(note);
}

std::string place(const WorkerState& worker) {
  return process::place_text(worker.scene.id, worker.progress.frame(), worker.progress.phase()) +
         ": ";
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
    entry.run.message = e.what();
  } catch (...) {
    entry.run.status = results::Status::kError;
    entry.run.failed_frame = worker.progress.frame();
    entry.run.message = place(worker) + text::current_exception_text();
  }
  guard.check_and_restore();  // whatever a call that threw has left behind
  // Emptying buffers may hang: that too is this detector's.
  worker.progress.enter(entry.position, worker.progress.frame(), process::Phase::kTrace);
  for (const std::string& note : worker.surroundings.restore()) add_note(note, entry.run);
}

void book_error(const WorkerState& worker, const std::string& what, WorkerEntry& entry) {
  entry.run.status = results::Status::kError;
  entry.run.message = "scene " + worker.scene.id + ", " + what;
}

}  // namespace contactcheck::suite
