#include "reference/run/worker.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/compare/judge.h"
#include "reference/compare/run_result_json.h"
#include "reference/run/accuracy.h"
#include "reference/run/case_file.h"
#include "reference/run/float_environment.h"
#include "reference/run/job.h"
#include "reference/run/samples_json.h"
#include "reference/run/schedule.h"
#include "reference/run/timing.h"
#include "reference/scene/scene.h"

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

  bool usable() const { return detector && result.status == RunStatus::kOk; }
};

class Worker {
 public:
  Worker(Job job, SharedProgress* shared) : job_(std::move(job)), progress_(shared) {}

  void run() {
    scene_ = job_.scene_file.extension() == ".ccr"
                 ? load_recording(job_.scene_file)
                 : load_scene(job_.scene_file, job_.settings.frames);
    register_core_detectors(catalog_);
    register_reference_detectors(catalog_);
    for (std::uint32_t i = 0; i < job_.settings.detectors.size(); ++i)
      if (std::find(job_.skip.begin(), job_.skip.end(), i) == job_.skip.end()) add_entry(i);
    judged_ = judge_scene(scene_, judges(), progress_);
    if (!judged_.refused.empty()) {
      refuse_all();
    } else if (judges()) {
      if (!job_.recording_file.empty()) record();
      judge_detectors();
      plan_timing();
    } else {
      prepare_detectors();
    }
    if (job_.settings.timing) time_detectors();
    write_answer();
    progress_.enter(SharedProgress::kNoDetector, 0, Phase::kDone);
  }

 private:
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
    } catch (const RefusedInput& e) {
      entry.result.status = RunStatus::kRefused;
      entry.result.message = e.what();
    } catch (const std::exception& e) {
      entry.result.status = RunStatus::kError;
      entry.result.message = e.what();
    }
    guard.check_and_restore();  // whatever a call that threw has left behind
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
    Oracle oracle(scene_.bodies);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      Entry& entry = entries_[i];
      progress_.part(0.1 + 0.4 * static_cast<double>(i) / static_cast<double>(entries_.size()));
      if (entry.result.status != RunStatus::kOk) continue;
      guarded(entry, [&] {
        progress_.enter(entry.position, 0, Phase::kPrepare);
        entry.detector = catalog_.make(entry.spec);
        entry.seconds_per_frame =
            run_accuracy(judged_, entry.position, *entry.detector, progress_, entry.result)
                .seconds_per_frame;
        measure_hover_gaps(judged_, entry.position, *entry.detector, oracle, progress_,
                           entry.result);
      });
      for (Disagreement& d : entry.result.disagreements) {
        d.scene = scene_.id;
        d.detector = entry.spec.name;
      }
    }
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
      if (!entry.usable()) continue;
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

  static void take_samples(TimedEntry& timed, Entry& entry) {
    if (!entry.usable()) return;  // another question of this detector threw
    if (timed.error.empty()) {
      entry.samples.push_back(std::move(timed.samples));
      return;
    }
    entry.result.status = RunStatus::kError;
    entry.result.message = timed.error;
    entry.samples.clear();
  }

  void record() {
    Recording recording;
    recording.scene = scene_.id;
    recording.bodies = scene_.bodies;
    recording.time_step = scene_.time_step;
    recording.frames = judged_.nodes;
    write_recording(job_.recording_file, recording);
  }

  // What is really there, summed over frames; levels that the scene does not ask for are absent.
  Json truth_json() const {
    std::map<Level, std::size_t> sums;
    for (const Truth& t : judged_.truth) {
      sums[Level::kBody] += t.surface.bodies.size();
      sums[Level::kContainment] += t.containment.size();
      sums[Level::kBox] += t.boxes.size();
      sums[Level::kTriangle] += t.surface.triangles.size();
      sums[Level::kVertex] += t.surface.vertices.size();
    }
    Json out = Json::object();
    for (const auto& [level, sum] : sums) {
      if (!scene_.judges(level)) continue;
      const std::string why = obstacle_to_judging(level, scene_.bodies);
      out[name_of(level)] = why.empty() ? Json(sum) : Json(why);
    }
    return out;
  }

  // A detector that finds exactly the true pairs of triangles has this contact_hash.
  std::uint64_t truth_hash() const {
    std::uint64_t hash = 0;
    for (std::size_t f = 0; f < judged_.truth.size(); ++f) {
      ContactSet surface = judged_.truth[f].surface;
      surface.vertices.clear();  // triangle detectors report none
      hash = chain_hash(hash, f, surface);
    }
    return hash;
  }

  Json scene_json() const {
    Json bodies = Json::array();
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
      const BodyShape& shape = *scene_.bodies[b].shape;
      bodies.push_back({{"name", scene_.bodies[b].name},
                        {"source", scene_.origins[b].source},
                        {"notes", scene_.origins[b].notes},
                        {"vertices", shape.mesh.vertices.size()},
                        {"triangles", shape.mesh.triangles.size()},
                        {"cells", shape.lattice ? shape.lattice->cells.size() : 0},
                        {"solid", shape.topology.solid}});
    }
    return {{"id", scene_.id},
            {"title", scene_.title},
            {"frames", scene_.frames},
            {"time_step", scene_.time_step},
            {"size", scene_.size()},
            {"contact_frames",
             std::count(judged_.contact_frames.begin(), judged_.contact_frames.end(), true)},
            {"truth", truth_json()},
            {"truth_hash", hex(truth_hash())},
            {"bodies", bodies}};
  }

  void write_answer() {
    progress_.enter(SharedProgress::kNoDetector, 0, Phase::kScene);
    Json runs = Json::array();
    for (Entry& entry : entries_) {
      Json samples = Json::array();
      for (const QuestionSamples& s : entry.samples) samples.push_back(samples_to_json(s));
      Json cases = Json::array();
      for (const Disagreement& d : entry.result.disagreements) {
        const std::filesystem::path file =
            job_.answer_file.string() + ".case" + std::to_string(cases_++);
        write_case(file, judged_, d);
        Json c = to_json(d);
        c["case"] = file.string();
        cases.push_back(c);
      }
      runs.push_back({{"position", entry.position},
                      {"run", to_json(entry.result)},
                      {"samples", samples},
                      {"disagreements", cases}});
    }
    const Json answer = {{"scene", scene_json()},
                         {"contact_frames", judged_.contact_frames},
                         {"order", job_.order},
                         {"prefixes", job_.prefixes},
                         {"runs", runs}};
    write_file_atomically(job_.answer_file, answer.dump());
  }

  Job job_;
  ProgressWriter progress_;
  DetectorCatalog catalog_;
  Scene scene_;
  JudgedScene judged_;
  std::vector<Entry> entries_;
  std::size_t cases_ = 0;
};

}  // namespace

int run_worker(const std::filesystem::path& job_file, int progress_fd) {
  SharedProgress own;
  SharedProgress* shared = &own;
  if (progress_fd >= 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // a worker does not outlive its supervisor
    void* page =
        mmap(nullptr, sizeof(SharedProgress), PROT_READ | PROT_WRITE, MAP_SHARED, progress_fd, 0);
    if (page != MAP_FAILED) shared = static_cast<SharedProgress*>(page);
  }
  try {
    Worker(read_job(job_file), shared).run();
    return 0;
  } catch (const InputError& e) {
    std::fprintf(stderr, "contactcheck: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "contactcheck: internal error: %s\n", e.what());
    return 70;
  }
}

}  // namespace contactcheck
