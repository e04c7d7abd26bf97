#include "reference/reduce/probe_worker.h"

#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <utility>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/judge/accuracy.h"
#include "reference/process/exit_codes.h"
#include "reference/process/float_environment.h"
#include "reference/process/surroundings.h"
#include "reference/reduce/channel.h"
#include "reference/reduce/verdict.h"
#include "reference/scene/scene.h"
#include "reference/suite/worker.h"
#include "reference/text/printable.h"

namespace contactcheck::reduce {
namespace {

constexpr const char* kName = "a frame";  // of the recording in a request

// One line of levels, then a recording of one frame.
constexpr char kEndOfLevels = '\n';

std::vector<Level> levels_from(const std::string& line) {
  std::vector<Level> out;
  std::size_t from = 0;
  while (from < line.size()) {
    const std::size_t to = std::min(line.find(' ', from), line.size());
    if (const auto level = level_from_name(line.substr(from, to - from))) out.push_back(*level);
    from = to + 1;
  }
  return out;
}

scene::Scene scene_of(const std::string& request) {
  const std::size_t end = request.find(kEndOfLevels);
  if (end == std::string::npos) throw InputError("a request without levels");
  Recording recording = read_recording_bytes(request.substr(end + 1), kName);
  scene::Scene scene;
  scene.id = recording.scene;
  scene.bodies = std::move(recording.bodies);
  scene.frames = 1;
  scene.time_step = recording.time_step;
  scene.levels = levels_from(request.substr(0, end));
  scene.recorded = std::move(recording.frames);
  return scene;
}

/// What the detector answers: one made anew, or `kept` of an earlier frame where it can be prepared
/// again. Errors are booked as a worker of a run books them (suite/worker_state.h).
ProbeVerdict verdict_on(judge::JudgingTools& tools, const DetectorCatalog& catalog,
                        const DetectorSpec& spec, process::ProgressWriter& progress,
                        std::unique_ptr<Detector>& kept) {
  ProbeVerdict out;
  const process::FloatEnvironmentGuard guard;
  try {
    // One that throws is not used again.
    std::unique_ptr<Detector> detector = kept ? std::move(kept) : catalog.make(spec);
    results::Run run;
    judge::AccuracyOutcome accuracy = judge::run_accuracy(tools, 0, *detector, progress, run);
    out.levels = run.levels;
    out.not_judged = run.not_judged;
    out.missed_length = run.geometry.missed_length.value_or(0.0);
    out.disagreements = std::move(accuracy.disagreements);
    if (detector->prepares_again()) kept = std::move(detector);
  } catch (const Unavailable& e) {
    out.status = results::Status::kAbsent;
    out.message = e.what();
  } catch (const RefusedInput& e) {
    out.status = results::Status::kRefused;
    out.message = e.what();
  } catch (...) {
    out.status = results::Status::kError;
    out.message = text::current_exception_text();
    out.how = "threw";
  }
  guard.check_and_restore();
  return out;
}

}  // namespace

std::string probe_request(const Snapshot& snapshot, const std::vector<Level>& levels) {
  std::string line;
  for (const Level level : levels) line += std::string(line.empty() ? "" : " ") + name_of(level);
  Recording recording;
  recording.scene = "case";
  recording.bodies = snapshot.bodies;
  recording.time_step = 1.0;
  recording.frames = {snapshot.nodes};
  return line + kEndOfLevels + recording_bytes(recording, kName);
}

int run_probe_worker(const std::string& detector, const DetectorCatalog& catalog, int channel_fd) {
  process::end_with_supervisor();
  try {
    const DetectorSpec spec = catalog.parse(detector);
    const Channel channel(channel_fd);
    process::Surroundings surroundings(true);
    process::SharedProgress page;
    process::ProgressWriter progress{&page};
    std::unique_ptr<Detector> kept;
    while (const std::optional<std::string> request = channel.receive()) {
      const scene::Scene scene = scene_of(*request);
      const judge::JudgedScene judged = judge::judge_scene(scene, progress);
      if (!judged.refused.empty()) throw RefusedInput(judged.refused);
      judge::JudgingTools tools(judged);
      if (!channel.send("")) break;
      const bool anew = !kept;
      ProbeVerdict verdict = verdict_on(tools, catalog, spec, progress, kept);
      // Earlier bodies may be what it failed of.
      if (!anew && verdict.status == results::Status::kError)
        verdict = verdict_on(tools, catalog, spec, progress, kept);
      surroundings.restore();
      if (!channel.send(to_text(verdict))) break;
    }
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "contactcheck: %s\n", e.what());
    return process::kExitInternal;
  }
}

}  // namespace contactcheck::reduce
