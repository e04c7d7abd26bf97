#include "reference/run/worker_answer.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/deform/recording.h"
#include "reference/compare/run_result_json.h"
#include "reference/run/case_file.h"
#include "reference/run/contacts_json.h"
#include "reference/run/samples_json.h"
#include "reference/run/scene_summary.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

// Texts of libraries may hold anything; JSON takes UTF-8 alone.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Numbers the cases of one answer.
class AnswerWriter {
 public:
  explicit AnswerWriter(const WorkerState& worker) : worker_(worker) {}

  // Piece by piece: in one tree, the contacts of all detectors would be the largest thing that this
  // process holds.
  void write() {
    std::string runs;
    for (const WorkerEntry& entry : worker_.entries)
      runs += (runs.empty() ? "" : ",") + text_of(answer_of(entry));
    const Job& job = worker_.job;
    Json answer = {{"scene", scene_summary(worker_.judged, worker_.separations)},
                   {"contact_frames", worker_.judged.contact_frames},
                   {"order", job.order},
                   {"prefixes", job.prefixes},
                   {"oracle_disagreements", oracle_cases()}};
    if (job.unjudged) answer["scene"]["unjudged"] = job.unjudged->why;
    if (lists_contacts()) answer["truth_contacts"] = truth_contacts(worker_.judged);
    std::string text = text_of(answer);
    text.back() = ',';
    write_file_atomically(job.answer_file, text + "\"runs\":[" + runs + "]}");
  }

 private:
  Json answer_of(const WorkerEntry& entry) {
    Json samples = Json::array();
    for (const QuestionSamples& s : entry.samples) samples.push_back(samples_to_json(s));
    Json out;
    out["position"] = entry.position;
    out["run"] = to_json(entry.result);
    if (entry.usable() && entry.closed_loop)
      out["run"]["closed_loop"] = to_json(*entry.closed_loop);
    if (entry.usable() && entry.step_times) out["run"]["step_ms"] = to_json(*entry.step_times);
    out["samples"] = std::move(samples);
    if (hands_answers_over()) out["answers"] = to_json(entry.answers);
    out["disagreements"] = written_cases(entry.result.disagreements);
    if (lists_contacts()) out["contacts"] = detector_contacts(entry.result);
    return out;
  }

  Json written_cases(const std::vector<Disagreement>& disagreements) {
    Json cases = Json::array();
    for (const Disagreement& d : disagreements) {
      const std::filesystem::path file =
          worker_.job.answer_file.string() + ".case" + std::to_string(cases_++);
      write_case(file, worker_.judged, d, recording_of_cases());
      Json c = to_json(d);
      c["case"] = file.string();
      cases.push_back(c);
    }
    return cases;
  }

  std::string recording_of_cases() const {
    if (worker_.scene.pairs) return "";  // see record_scene()
    return "../recordings/" + worker_.job.recording_file.filename().string();
  }

  // Where the oracle itself is wrong.
  Json oracle_cases() {
    if (!worker_.judged.pairs) return Json::array();
    std::vector<Disagreement> wrong = worker_.judged.pairs->disagreements;
    for (Disagreement& d : wrong) {
      d.scene = worker_.scene.id;
      d.detector = "oracle";
    }
    return written_cases(wrong);
  }

  // To the processes that only time.
  bool hands_answers_over() const {
    const RunSettings& settings = worker_.job.settings;
    return worker_.judges() && settings.timing && settings.processes > 1;
  }

  // Random pairs are far too many for pictures; a scene that is refused or not judged has no truth.
  bool lists_contacts() const {
    return worker_.judges() && !worker_.scene.pairs && worker_.judged.refused.empty() &&
           !worker_.job.unjudged;
  }

  const WorkerState& worker_;
  std::size_t cases_ = 0;
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

void write_answer(WorkerState& worker) {
  worker.progress.enter(SharedProgress::kNoDetector, 0, Phase::kScene);
  AnswerWriter(worker).write();
}

}  // namespace contactcheck
