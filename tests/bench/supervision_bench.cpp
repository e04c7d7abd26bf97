// What it costs a worker to be watched: a playback of a scene (time_pass, the suite's own) with its
// progress in a shared page that a supervisor polls, against the same pass with a page that is not
// polled. The poller is a thread here, a process in the suite. One pass of each in turn; the ratio
// is that of the median sums of frame times, so 1 is "no cost".

#include <benchmark/benchmark.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <memory>
#include <new>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/judge/judged_scene.h"
#include "reference/results/statistics.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/frame_positions.h"
#include "reference/scene/scene.h"
#include "reference/timing/timing.h"
#include "tests/bench/register.h"

namespace contactcheck::bench {
namespace {

/// A page that another process could see.
class SharedPage {
 public:
  SharedPage() {
    void* page = mmap(nullptr, sizeof(process::SharedProgress), PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (page == MAP_FAILED) throw std::bad_alloc();
    progress_ = new (page) process::SharedProgress;
  }
  ~SharedPage() { munmap(progress_, sizeof(process::SharedProgress)); }
  SharedPage(const SharedPage&) = delete;
  SharedPage& operator=(const SharedPage&) = delete;
  process::SharedProgress* get() { return progress_; }

 private:
  process::SharedProgress* progress_ = nullptr;
};

/// Does what the supervisor does, as often as it does, in a thread of its own.
class Poller {
 public:
  explicit Poller(const process::SharedProgress& progress)
      : thread_([this, &progress] {
          while (!stop_) {
            poll(progress);
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
          }
        }) {}
  ~Poller() {
    stop_ = true;
    thread_.join();
  }
  Poller(const Poller&) = delete;
  Poller& operator=(const Poller&) = delete;

 private:
  void poll(const process::SharedProgress& progress) {
    std::ifstream statm("/proc/self/statm");
    std::uint64_t total = 0, resident = 0;
    statm >> total >> resident;
    sum_ += progress.ticks + progress.detector + progress.permille + resident;
  }

  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> sum_{0};
  std::thread thread_;
};

/// A scene with one prepared detector and what it answers, ready for time_pass.
class TimedScene {
 public:
  TimedScene(const std::string& id, const std::string& detector)
      : scene_(scene::load_scene(scene::find_scene(id, scene::fixtures_directory()))) {
    const DetectorCatalog catalog = adapters::standard_catalog();
    detector_ = catalog.make(catalog.parse(detector));
    detector_->prepare(scene_.bodies);
    request_.asked = {detector_->semantics().questions.front(), true};
    request_.judged = &answers_;
    request_.frames.resize(scene_.frames);
    std::iota(request_.frames.begin(), request_.frames.end(), std::size_t{0});
    answer_all();
  }

  /// Nanoseconds: the sum over the frames of one pass.
  double run(process::SharedProgress* page) {
    process::ProgressWriter progress(page);
    double sum = 0.0;
    for (const timing::PhaseSample& frame :
         timing::time_pass(scene_, request_, *detector_, progress))
      sum += frame.total();
    return sum;
  }

 private:
  // time_pass compares every answer with these.
  void answer_all() {
    ContactSet contacts;
    const scene::FramePositions positions(scene_);
    for (std::size_t f = 0; f < scene_.frames; ++f) {
      contacts.clear();
      const scene::FramePosition& at = positions[f];
      detector_->update(judge::make_frame(f, scene_.time_of(f), at.nodes, at.vertices));
      detector_->query(request_.asked.question, contacts);
      contacts.canonicalize();
      answers_.push_back(judge::fingerprint_of(contacts, request_.asked));
    }
  }

  scene::Scene scene_;
  std::unique_ptr<Detector> detector_;
  std::vector<judge::AnswerFingerprint> answers_;
  timing::PassRequest request_;
};

void run_both(benchmark::State& state, const std::string& scene, const std::string& detector) {
  std::unique_ptr<TimedScene> timed;
  try {
    timed = std::make_unique<TimedScene>(scene, detector);
  } catch (const InputError& e) {
    state.SkipWithError(e.what());
    return;
  }
  process::SharedProgress own;
  SharedPage shared;
  std::vector<double> alone, watched;
  const auto run_alone = [&] { alone.push_back(timed->run(&own)); };
  const auto run_watched = [&] {
    const Poller poller(*shared.get());
    watched.push_back(timed->run(shared.get()));
  };
  for (auto _ : state) {
    // Whoever goes second finds the machine as the first has left it: both take turns.
    if (alone.size() % 2 == 0) {
      run_alone();
      run_watched();
    } else {
      run_watched();
      run_alone();
    }
    state.SetIterationTime(1e-9 * watched.back());
  }
  state.counters["alone_us"] = 1e-3 * results::median(alone);
  state.counters["watched_us"] = 1e-3 * results::median(watched);
  state.counters["watched_over_alone"] = results::median(watched) / results::median(alone);
}

}  // namespace

void register_supervision_benchmarks() {
  for (const std::string detector : {"ffd-aabb-sphere2+tri", "fcl-aabb"})
    benchmark::RegisterBenchmark(
        ("supervision/bunny-touch/" + detector).c_str(),
        [detector](benchmark::State& state) { run_both(state, "bunny-touch", detector); })
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
}

}  // namespace contactcheck::bench
