#include "reference/run/worker_answer.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/run/case_file.h"
#include "reference/run/contacts_json.h"
#include "reference/run/scene_summary.h"

namespace contactcheck {
namespace {

// Of a worker that judges. Numbers the cases of one answer.
class AnswerWriter {
 public:
  explicit AnswerWriter(const WorkerState& worker) : worker_(worker) {}

  void write() {
    const Job& job = worker_.job;
    answer_.scene = scene_summary(worker_.judged, worker_.separations);
    if (job.unjudged) answer_.scene.unjudged = job.unjudged->why;
    answer_.contact_frames = worker_.judged.contact_frames;
    if (lists_contacts()) answer_.truth_contacts = truth_contacts(worker_.judged);
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
    if (lists_contacts()) out.contacts = detector_contacts(entry.run, entry.accuracy.differences);
    add_cases(entry.spec.name, entry.accuracy.disagreements);
  }

  // `detector`: who is wrong; "oracle" where rational arithmetic contradicts it.
  void add_cases(const std::string& detector, const std::vector<Disagreement>& disagreements) {
    for (Disagreement d : disagreements) {
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

}  // namespace

void record_scene(const WorkerState& worker) {
  const Scene& scene = worker.scene;
  if (worker.job.recording_file.empty() || scene.pairs) return;
  Recording recording;
  recording.scene = scene.id;
  recording.bodies = scene.bodies;
  recording.time_step = scene.time_step;
  for (std::size_t f = 0; f < scene.frames; ++f)
    recording.frames.push_back(worker.judged.positions[f].nodes);
  write_recording(worker.job.recording_file, recording);
}

void replay_recording(const std::filesystem::path& file, Scene& scene) {
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

void write_answer(WorkerState& worker) {
  worker.progress.enter(SharedProgress::kNoDetector, 0, Phase::kScene);
  if (worker.judges()) {
    AnswerWriter(worker).write();
    return;
  }
  SceneAnswer answer;
  answer.timed = std::move(worker.timed);
  write_answer(worker.job.answer_file, std::move(answer));
}

}  // namespace contactcheck
