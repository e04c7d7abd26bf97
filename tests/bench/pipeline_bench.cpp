// Whole detectors on a scene of the default suite, phase by phase, with fcl-aabb run in turn on the
// same frame as the yardstick. A frame's time is the median of its repeats, and the scene's time
// the mean over its frames; nothing is flushed between them. The suite's own figures (contactcheck
// run) are the ones to publish; these are for profiling.

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/detect/registry.h"
#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/results/statistics.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/scene.h"
#include "tests/bench/register.h"
#include "tests/support/shapes.h"

namespace contactcheck::bench {
namespace {

using Clock = std::chrono::steady_clock;

double microseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::micro>(to - from).count();
}

const DetectorCatalog& catalog() {
  static const DetectorCatalog all = [] {
    DetectorCatalog out;
    register_core_detectors(out);
    adapters::register_reference_detectors(out);
    return out;
  }();
  return all;
}

// Per frame of the scene, its repeats.
using Samples = std::vector<std::vector<double>>;

double mean_of_medians(const Samples& samples) {
  double sum = 0.0;
  std::size_t frames = 0;
  for (const std::vector<double>& repeats : samples) {
    if (repeats.empty()) continue;
    sum += results::median(repeats);
    ++frames;
  }
  return sum / static_cast<double>(frames);
}

// One detector on one scene, with the times of its phases.
class Runner {
 public:
  Runner(const std::string& name, const std::vector<Body>& bodies, std::size_t frames)
      : map(frames),
        update(frames),
        query(frames),
        whole(frames),
        detector_(catalog().make(catalog().parse(name))),
        bodies_(bodies) {
    detector_->prepare(bodies);
  }

  void run(std::size_t f, test::FrameData& data) {
    const Frame frame = data.frame(f);
    contacts_.clear();
    const auto start = Clock::now();
    if (detector_->needs_vertices())
      for (std::size_t b = 0; b < bodies_.size(); ++b)
        map_body(*bodies_[b].shape, data.nodes[b], data.vertices[b]);
    const auto mapped = Clock::now();
    detector_->update(frame);
    const auto updated = Clock::now();
    detector_->query(detector_->semantics().questions.front(), contacts_);
    const auto end = Clock::now();
    map[f].push_back(microseconds(start, mapped));
    update[f].push_back(microseconds(mapped, updated));
    query[f].push_back(microseconds(updated, end));
    whole[f].push_back(microseconds(start, end));
  }

  // The hash that results.json gives as contact_hash: what was timed is what was judged.
  std::string contact_hash(std::vector<test::FrameData>& frames) {
    std::uint64_t hash = 0;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      run(f, frames[f]);
      contacts_.canonicalize();
      hash = chain_hash(hash, f, contacts_);
    }
    std::ostringstream text;
    text << std::hex << "0x" << hash;
    return text.str();
  }

  Samples map, update, query, whole;

 private:
  std::unique_ptr<Detector> detector_;
  const std::vector<Body>& bodies_;
  ContactSet contacts_;
};

struct SceneFrames {
  std::vector<Body> bodies;
  std::vector<test::FrameData> frames;
};

SceneFrames load_frames(const std::string& id) {
  const scene::Scene scene = scene::load_scene(scene::find_scene(id, scene::fixtures_directory()));
  SceneFrames out;
  out.bodies = scene.bodies;
  for (std::size_t f = 0; f < scene.frames; ++f)
    out.frames.push_back(test::make_frame(scene.bodies, scene.nodes_of_frame(f)));
  return out;
}

void run_detector(benchmark::State& state, const std::string& scene, const std::string& name) {
  SceneFrames data;
  try {
    data = load_frames(scene);
  } catch (const InputError& e) {
    state.SkipWithError(e.what());
    return;
  }
  Runner ours(name, data.bodies, data.frames.size());
  Runner yardstick("fcl-aabb", data.bodies, data.frames.size());
  state.SetLabel(ours.contact_hash(data.frames));
  yardstick.contact_hash(data.frames);
  std::size_t next = 0;
  for (auto _ : state) {
    const std::size_t f = next++ % data.frames.size();
    yardstick.run(f, data.frames[f]);
    ours.run(f, data.frames[f]);
    state.SetIterationTime(1e-6 * ours.whole[f].back());
  }
  state.counters["map_us"] = mean_of_medians(ours.map);
  state.counters["update_us"] = mean_of_medians(ours.update);
  state.counters["query_us"] = mean_of_medians(ours.query);
  state.counters["speedup_over_fcl_aabb"] =
      mean_of_medians(yardstick.whole) / mean_of_medians(ours.whole);
}

}  // namespace

void register_pipeline_benchmarks() {
  for (const std::string scene : {"dinosaur-pile", "bunny-touch"})
    for (const std::string name : {"ffd-aabb-sphere2+tri", "ffd-aabb-sphere2", "fcl-aabb"})
      benchmark::RegisterBenchmark(
          ("pipeline/" + scene + "/" + name).c_str(),
          [scene, name](benchmark::State& state) { run_detector(state, scene, name); })
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond);
}

}  // namespace contactcheck::bench
