#include "reference/run/worker.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/deform/atomic_file.h"
#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/arrange/sweep_poses.h"
#include "reference/compare/run_result_json.h"
#include "reference/run/accuracy.h"
#include "reference/run/case_file.h"
#include "reference/run/closed_loop.h"
#include "reference/run/contacts_json.h"
#include "reference/run/float_environment.h"
#include "reference/run/hover.h"
#include "reference/run/job.h"
#include "reference/run/lockstep.h"
#include "reference/run/printable.h"
#include "reference/run/samples_json.h"
#include "reference/run/scene_summary.h"
#include "reference/run/schedule.h"
#include "reference/run/separation.h"
#include "reference/run/surroundings.h"
#include "reference/run/timing.h"
#include "reference/scene/any_scene.h"
#include "reference/scene/scene.h"
#include "reference/simulate/driven_simulation.h"
#include "reference/simulate/simulate_scene.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

struct Entry {
  std::uint32_t position = 0;
  DetectorSpec spec;
  std::unique_ptr<Detector> detector;
  RunResult result;
  double seconds_per_frame = 0.0;
  std::vector<QuestionSamples> samples;
  std::optional<ClosedLoop> closed_loop;
  std::optional<StepTimes> step_times;

  bool usable() const { return result.status == RunStatus::kOk; }
};

class Worker {
 public:
  Worker(Job job, const DetectorCatalog& catalog, SharedProgress* shared, bool supervised)
      : job_(std::move(job)), catalog_(catalog), progress_(shared), surroundings_(supervised) {}

  void run() {
    scene_ = load();
    if (scene_.simulation) scene_.simulation->settings.threads = job_.settings.threads;
    record_simulation(
        catalog_,
        [this](std::size_t step) {
          progress_.enter(SharedProgress::kNoDetector, step, Phase::kScene);
        },
        scene_);
    place_sweep(
        [this](std::size_t orientation) {
          progress_.enter(SharedProgress::kNoDetector, orientation, Phase::kScene);
        },
        scene_);
    for (std::uint32_t i = 0; i < job_.settings.detectors.size(); ++i)
      if (std::find(job_.skip.begin(), job_.skip.end(), i) == job_.skip.end()) add_entry(i);
    judged_ = judge_scene(scene_, judges(), progress_);
    if (!judged_.refused.empty()) {
      refuse_all();
    } else if (judges()) {
      if (!job_.recording_file.empty()) record();
      separations_ = separations(judged_, progress_);
      judge_detectors();
      if (job_.settings.closed_loop && scene_.simulation) simulate_with_detectors();
      plan_timing();
    } else {
      prepare_detectors();
    }
    if (job_.settings.timing) time_detectors();
    dismiss_all();
    surroundings_.restore();
    write_answer();
    progress_.enter(SharedProgress::kNoDetector, 0, Phase::kDone);
  }

 private:
  Scene load() const {
    if (job_.pairs) return make_pairs_scene(*job_.pairs);
    if (job_.text) return load_scene_text(*job_.text, job_.settings.frames);
    return load_any_scene(job_.scene_file, job_.settings.frames);
  }

  void add_entry(std::uint32_t position) {
    Entry entry;
    entry.position = position;
    entry.spec = catalog_.parse(job_.settings.detectors[position]);
    entry.result.scene = scene_.id;
    entry.result.detector = entry.spec.name;
    entry.result.options = entry.spec.options;
    entry.result.frames = scene_.frames;
    const DetectorInfo* info = catalog_.find(entry.spec.id);
    if (!info->absent_because.empty()) {
      entry.result.status = RunStatus::kAbsent;
      entry.result.message = info->absent_because;
    }
    entries_.push_back(std::move(entry));
  }

  // What a detector throws is its own result; what the suite throws ends the worker.
  template <typename Work>
  void guarded(Entry& entry, Work&& work) {
    const FloatEnvironmentGuard guard;
    try {
      work();
    } catch (const Unavailable& e) {
      entry.result.status = RunStatus::kAbsent;
      entry.result.message = e.what();
    } catch (const RefusedInput& e) {
      entry.result.status = RunStatus::kRefused;
      entry.result.message = e.what();
    } catch (...) {
      entry.result.status = RunStatus::kError;
      entry.result.failed_frame = progress_.frame();
      entry.result.message = place() + current_exception_text();
    }
    guard.check_and_restore();  // whatever a call that threw has left behind
    // Emptying buffers may hang: that too is this detector's.
    progress_.enter(entry.position, progress_.frame(), Phase::kTrace);
    for (const std::string& note : surroundings_.restore()) add_note(note, entry.result);
  }

  static void add_note(const std::string& note, RunResult& result) {
    if (std::find(result.notes.begin(), result.notes.end(), note) == result.notes.end())
      result.notes.push_back(note);
  }

  std::string place() const {
    return "scene " + scene_.id + ", frame " + std::to_string(progress_.frame()) + ", phase " +
           name_of(progress_.phase()) + ": ";
  }

  bool judges() const { return job_.process == 0; }

  void refuse_all() {
    for (Entry& entry : entries_) {
      if (entry.result.status != RunStatus::kOk) continue;
      entry.result.status = RunStatus::kRefused;
      entry.result.message = judged_.refused;
    }
  }

  void judge_detectors() {
    JudgingTools tools(judged_);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      Entry& entry = entries_[i];
      progress_.part(kShareOfTruth +
                     0.4 * static_cast<double>(i) / static_cast<double>(entries_.size()));
      if (entry.result.status != RunStatus::kOk) continue;
      guarded(entry, [&] {
        progress_.enter(entry.position, 0, Phase::kPrepare);
        entry.detector = catalog_.make(entry.spec);
        entry.seconds_per_frame =
            run_accuracy(tools, entry.position, *entry.detector, progress_, entry.result)
                .seconds_per_frame;
        measure_hover_gaps(tools, entry.position, *entry.detector, progress_, entry.result);
        if (!job_.settings.timing) dismiss(entry);
      });
      for (Disagreement& d : entry.result.disagreements) {
        d.scene = scene_.id;
        d.detector = entry.spec.name;
      }
    }
  }

  // Nobody asks it again: what it holds shall not count against those after it.
  void dismiss(Entry& entry) {
    progress_.enter(entry.position, progress_.frame(), Phase::kDestroy);
    entry.detector.reset();
  }

  // Before the answer is written: one that crashes here is no detector to use.
  void dismiss_all() {
    for (Entry& entry : entries_)
      if (entry.detector) guarded(entry, [&] { dismiss(entry); });
  }

  // Closed loop, and whole steps timed: what a detector's errors and its time do to a simulation.
  void simulate_with_detectors() {
    for (Entry& entry : entries_) {
      if (!drives(entry)) continue;
      guarded(entry, [&] {
        entry.closed_loop = run_closed_loop(
            scene_, entry.position, [&] { return catalog_.make(entry.spec); }, progress_);
      });
    }
    if (job_.settings.timing) time_whole_steps();
  }

  static bool drives(const Entry& entry) {
    return entry.usable() && why_no_driver(entry.result.semantics).empty();
  }

  void time_whole_steps() {
    std::vector<LockstepEntry> lockstep;
    for (Entry& entry : entries_) {
      if (!drives(entry)) continue;
      std::unique_ptr<Detector> made;
      guarded(entry, [&] {
        progress_.enter(entry.position, 0, Phase::kPrepare);
        made = catalog_.make(entry.spec);
      });
      if (made) lockstep.push_back({entry.position, std::move(made), StepTimes{}, ""});
    }
    const DetectorSpec driver = catalog_.parse(scene_.simulation->driver);
    LockstepSettings settings;
    settings.repeats = job_.settings.repeats;
    settings.sweep_bytes = job_.settings.sweep_bytes;
    run_lockstep(scene_, *catalog_.make(driver), settings, lockstep, progress_);
    for (LockstepEntry& timed : lockstep)
      for (Entry& entry : entries_)
        if (entry.position == timed.position) end_lockstep(timed, entry);
  }

  void end_lockstep(LockstepEntry& timed, Entry& entry) {
    take_step_times(timed, entry);
    guarded(entry, [&] {
      progress_.enter(entry.position, progress_.frame(), Phase::kDestroy);
      timed.detector.reset();
    });
  }

  void take_step_times(const LockstepEntry& timed, Entry& entry) const {
    if (timed.error.empty()) {
      entry.step_times = timed.times;
    } else {
      book_error(timed.error, entry);
    }
  }

  void book_error(const std::string& what, Entry& entry) const {
    entry.result.status = RunStatus::kError;
    entry.result.message = "scene " + scene_.id + ", " + what;
  }

  // A process that only times: no judging.
  void prepare_detectors() {
    for (Entry& entry : entries_) {
      if (entry.result.status != RunStatus::kOk || job_.prefixes[entry.position] == 0) continue;
      guarded(entry, [&] {
        progress_.enter(entry.position, 0, Phase::kPrepare);
        entry.detector = catalog_.make(entry.spec);
        entry.result.semantics = entry.detector->semantics();
        entry.detector->prepare(scene_.bodies);
      });
    }
  }

  void plan_timing() {
    const RunSettings& s = job_.settings;
    job_.order = timing_order(judged_.contact_frames);
    job_.prefixes.assign(s.detectors.size(), 0);
    for (const Entry& entry : entries_) {
      if (!entry.usable()) continue;
      // One repeat runs cold and hot.
      job_.prefixes[entry.position] =
          frames_within_budget(s.time_budget, 2.0 * entry.seconds_per_frame, s.repeats,
                               s.fewest_timed_frames, scene_.frames);
    }
  }

  std::vector<TimedEntry> timed_entries() {
    std::vector<TimedEntry> timed;
    for (Entry& entry : entries_) {
      if (!entry.usable() || !entry.detector) continue;
      for (Question question : entry.result.semantics.questions) {
        TimedEntry t;
        t.position = entry.position;
        t.detector = entry.detector.get();
        t.question = question;
        t.frames = job_.prefixes[entry.position];
        t.samples.question = question;
        t.samples.lazy_map = !entry.detector->needs_vertices();
        timed.push_back(std::move(t));
      }
    }
    return timed;
  }

  void time_detectors() {
    std::vector<TimedEntry> timed = timed_entries();
    if (timed.empty()) return;
    run_timing(judged_, job_.order, job_.settings.repeats, job_.settings.sweep_bytes, timed,
               progress_);
    for (TimedEntry& t : timed)
      for (Entry& entry : entries_)
        if (entry.position == t.position) take_samples(t, entry);
  }

  void take_samples(TimedEntry& timed, Entry& entry) {
    if (!entry.usable()) return;  // another question of this detector threw
    if (timed.error.empty()) {
      entry.samples.push_back(std::move(timed.samples));
      return;
    }
    book_error(timed.error, entry);
    entry.samples.clear();
  }

  void record() {
    if (scene_.pairs) return;  // their number and seed say all, and take less room
    Recording recording;
    recording.scene = scene_.id;
    recording.bodies = scene_.bodies;
    recording.time_step = scene_.time_step;
    for (std::size_t f = 0; f < scene_.frames; ++f)
      recording.frames.push_back(judged_.positions[f].nodes);
    write_recording(job_.recording_file, recording);
  }

  Json written_cases(const std::vector<Disagreement>& disagreements) {
    Json cases = Json::array();
    for (const Disagreement& d : disagreements) {
      const std::filesystem::path file =
          job_.answer_file.string() + ".case" + std::to_string(cases_++);
      write_case(file, judged_, d, recording_of_cases());
      Json c = to_json(d);
      c["case"] = file.string();
      cases.push_back(c);
    }
    return cases;
  }

  std::string recording_of_cases() const {
    if (scene_.pairs) return "";  // see record()
    return "../recordings/" + job_.recording_file.filename().string();
  }

  // Where the oracle itself is wrong.
  Json oracle_cases() {
    if (!judged_.pairs) return Json::array();
    std::vector<Disagreement> wrong = judged_.pairs->disagreements;
    for (Disagreement& d : wrong) {
      d.scene = scene_.id;
      d.detector = "oracle";
    }
    return written_cases(wrong);
  }

  // Random pairs are far too many for pictures; a refused scene has no truth.
  bool lists_contacts() const { return judges() && !scene_.pairs && judged_.refused.empty(); }

  // Piece by piece: in one tree, the contacts of all detectors would be the largest thing that this
  // process holds.
  void write_answer() {
    progress_.enter(SharedProgress::kNoDetector, 0, Phase::kScene);
    std::string runs;
    for (Entry& entry : entries_) runs += (runs.empty() ? "" : ",") + text_of(answer_of(entry));
    Json answer = {{"scene", scene_summary(judged_, separations_)},
                   {"contact_frames", judged_.contact_frames},
                   {"order", job_.order},
                   {"prefixes", job_.prefixes},
                   {"oracle_disagreements", oracle_cases()}};
    if (lists_contacts()) answer["truth_contacts"] = truth_contacts(judged_);
    std::string text = text_of(answer);
    text.back() = ',';
    write_file_atomically(job_.answer_file, text + "\"runs\":[" + runs + "]}");
  }

  Json answer_of(Entry& entry) {
    Json samples = Json::array();
    for (const QuestionSamples& s : entry.samples) samples.push_back(samples_to_json(s));
    Json out;
    out["position"] = entry.position;
    out["run"] = to_json(entry.result);
    if (entry.usable() && entry.closed_loop)
      out["run"]["closed_loop"] = to_json(*entry.closed_loop);
    if (entry.usable() && entry.step_times) out["run"]["step_ms"] = to_json(*entry.step_times);
    out["samples"] = std::move(samples);
    out["disagreements"] = written_cases(entry.result.disagreements);
    if (lists_contacts()) out["contacts"] = detector_contacts(entry.result);
    return out;
  }

  // Texts of libraries may hold anything; JSON takes UTF-8 alone.
  static std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  Job job_;
  const DetectorCatalog& catalog_;
  ProgressWriter progress_;
  Surroundings surroundings_;
  Scene scene_;
  JudgedScene judged_;
  std::vector<double> separations_;
  std::vector<Entry> entries_;
  std::size_t cases_ = 0;
};

}  // namespace

int run_worker(const std::filesystem::path& job_file, const DetectorCatalog& catalog,
               int progress_fd) {
  SharedProgress own;
  SharedProgress* shared = &own;
  if (progress_fd >= 0) shared = join_supervisor(progress_fd, &own);
  try {
    Worker(read_job(job_file), catalog, shared, progress_fd >= 0).run();
    return 0;
  } catch (const InputError& e) {
    std::fprintf(stderr, "contactcheck: %s\n", e.what());
    return kExitBadInput;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "contactcheck: internal error: %s\n", e.what());
    return kExitInternal;
  }
}

}  // namespace contactcheck
