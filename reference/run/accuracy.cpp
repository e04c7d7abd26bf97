#include "reference/run/accuracy.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "core/types/check.h"
#include "reference/compare/episodes.h"
#include "reference/compare/judge.h"
#include "reference/compare/stage_losses.h"
#include "reference/run/float_environment.h"

namespace contactcheck {
namespace {

std::uint64_t heap_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Frame make_frame(std::size_t index, double time, const std::vector<std::vector<Vec3>>& nodes,
                 const std::vector<std::vector<Vec3>>& vertices) {
  Frame frame;
  frame.index = index;
  frame.time = time;
  for (std::size_t b = 0; b < nodes.size(); ++b) frame.bodies.push_back({nodes[b], vertices[b]});
  return frame;
}

std::vector<std::vector<Vec3>> map_bodies(const Scene& scene,
                                          const std::vector<std::vector<Vec3>>& nodes) {
  std::vector<std::vector<Vec3>> vertices(nodes.size());
  for (std::size_t b = 0; b < nodes.size(); ++b) {
    vertices[b].resize(scene.bodies[b].shape->mesh.vertices.size());
    map_body(*scene.bodies[b].shape, nodes[b], vertices[b]);
  }
  return vertices;
}

std::string first_non_finite(const Scene& scene, std::size_t frame,
                             const std::vector<std::vector<Vec3>>& nodes) {
  for (std::size_t b = 0; b < nodes.size(); ++b)
    for (std::size_t n = 0; n < nodes[b].size(); ++n)
      if (!nodes[b][n].allFinite())
        return "frame " + std::to_string(frame) + ", body \"" + scene.bodies[b].name + "\": node " +
               std::to_string(n) + " is not finite";
  return "";
}

void note_environment(const FloatEnvironmentGuard& guard, const char* call, RunResult& result) {
  const std::string changed = guard.check_and_restore();
  if (changed.empty()) return;
  const std::string text = std::string(call) + " changed " + changed;
  auto& list = result.float_environment;
  if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

std::size_t count_contact(const std::vector<bool>& frames) {
  return static_cast<std::size_t>(std::count(frames.begin(), frames.end(), true));
}

WantedTruth wanted_truth(const Scene& scene) {
  WantedTruth wanted;
  wanted.containment = scene.judges(Level::kContainment);
  wanted.vertices = scene.judges(Level::kVertex);
  wanted.boxes = scene.judges(Level::kBox);
  return wanted;
}

// An answer that names what is not there must not reach code that looks it up.
class IdCheck {
 public:
  IdCheck(const Scene& scene, std::size_t frame) : scene_(scene), frame_(frame) {}

  void operator()(const ContactSet& contacts) const {
    for (const BodyPair& p : contacts.bodies) check_pair(p.a, p.b);
    for (const ElementPair& p : contacts.triangles) {
      check_element("triangle", p.body_a, p.a, shape(p.body_a).mesh.triangles.size());
      check_element("triangle", p.body_b, p.b, shape(p.body_b).mesh.triangles.size());
    }
    for (const ElementPair& p : contacts.cells) {
      check_element("cell", p.body_a, p.a, cells_of(p.body_a));
      check_element("cell", p.body_b, p.b, cells_of(p.body_b));
    }
    for (const VertexInBody& v : contacts.vertices) {
      check_pair(v.body, v.in);
      check_element("vertex", v.body, v.vertex, shape(v.body).mesh.vertices.size());
    }
  }

 private:
  const BodyShape& shape(std::uint32_t body) const { return *scene_.bodies[body].shape; }
  std::size_t cells_of(std::uint32_t body) const {
    return shape(body).lattice ? shape(body).lattice->cells.size() : 0;
  }
  // Element pairs imply their body pair (canonicalize), so this sees every body index first.
  void check_pair(std::uint32_t a, std::uint32_t b) const {
    const std::size_t count = scene_.bodies.size();
    if (a >= count || b >= count)
      fail("body " + std::to_string(std::max(a, b)) + " of " + std::to_string(count) + " bodies");
    if (a == b) fail("body \"" + scene_.bodies[a].name + "\" in contact with itself");
  }
  void check_element(const char* kind, std::uint32_t body, std::uint32_t id,
                     std::size_t count) const {
    if (id < count) return;
    fail(std::string(kind) + " " + std::to_string(id) + " of body \"" + scene_.bodies[body].name +
         "\", which has " + std::to_string(count));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("frame " + std::to_string(frame_) + ": the answer names " + what);
  }

  const Scene& scene_;
  std::size_t frame_;
};

// Asks a question about the frame of the last update; the answer is canonical and names only what
// is there. Reuses the capacity of `out`.
void ask(Detector& detector, Question question, const IdCheck& check, ContactSet& out) {
  out.clear();
  detector.query(question, out);
  out.canonicalize();
  check(out);
}

// Does the detector report the pair at a time between frames?
class PairProbe {
 public:
  PairProbe(const JudgedScene& judged, Detector& detector, Oracle& oracle, BodyPair pair)
      : scene_(*judged.scene), detector_(detector), oracle_(oracle), pair_(pair) {}

  bool reports(double time) {
    go_to(time);
    detector_.update(frame_);
    ContactSet contacts;
    ask(detector_, detector_.semantics().questions.front(), IdCheck(scene_, 0), contacts);
    return std::binary_search(contacts.bodies.begin(), contacts.bodies.end(), pair_);
  }
  double distance(double time) {
    go_to(time);
    return oracle_.distance(frame_, pair_).upper;
  }

 private:
  void go_to(double time) {
    if (time == time_) return;
    time_ = time;
    nodes_ = scene_.nodes_at(time);
    vertices_ = map_bodies(scene_, nodes_);
    frame_ = make_frame(0, time, nodes_, vertices_);
  }

  const Scene& scene_;
  Detector& detector_;
  Oracle& oracle_;
  BodyPair pair_;
  double time_ = std::nan("");
  std::vector<std::vector<Vec3>> nodes_, vertices_;
  Frame frame_;
};

}  // namespace

Frame JudgedScene::frame(std::size_t index) const {
  return make_frame(index, scene->time_of(index), nodes[index], vertices[index]);
}

JudgedScene judge_scene(const Scene& scene, bool truth_wanted, ProgressWriter& progress) {
  JudgedScene judged;
  judged.scene = &scene;
  Oracle oracle(scene.bodies);
  for (std::size_t f = 0; f < scene.frames; ++f) {
    progress.enter(SharedProgress::kNoDetector, f, Phase::kTruth);
    judged.nodes.push_back(scene.nodes_of_frame(f));
    judged.refused = first_non_finite(scene, f, judged.nodes.back());
    if (!judged.refused.empty()) return judged;
    judged.vertices.push_back(map_bodies(scene, judged.nodes.back()));
    if (!truth_wanted) continue;
    judged.truth.push_back(oracle.judge(judged.frame(f), wanted_truth(scene)));
    judged.contact_frames.push_back(!judged.truth.back().surface.bodies.empty());
  }
  return judged;
}

AccuracyOutcome run_accuracy(const JudgedScene& judged, std::uint32_t position, Detector& detector,
                             ProgressWriter& progress, RunResult& result) {
  const Scene& scene = *judged.scene;
  const FloatEnvironmentGuard guard;
  const std::uint64_t heap_before = heap_in_use();
  progress.enter(position, 0, Phase::kPrepare);
  const auto prepare_start = std::chrono::steady_clock::now();
  detector.prepare(scene.bodies);
  result.prepare_ms = 1e3 * seconds_since(prepare_start);
  note_environment(guard, "prepare", result);

  result.semantics = detector.semantics();
  Judge judge(scene.bodies, result.semantics,
              judged_levels(scene.bodies, result.semantics, scene.levels, &result.not_judged));
  StageLosses losses(scene.bodies);
  BodyPairsPerFrame truth_pairs, reported_pairs;
  AccuracyOutcome outcome;
  ContactSet contacts, by_body;
  const Question own = result.semantics.questions.front();
  const bool asks_body = own != Question::kBody && result.semantics.answers(Question::kBody);
  for (std::size_t f = 0; f < scene.frames; ++f) {
    const Frame frame = judged.frame(f);
    const IdCheck check(scene, f);
    contacts.clear();
    const auto start = std::chrono::steady_clock::now();
    progress.enter(position, f, Phase::kUpdate);
    detector.update(frame);
    note_environment(guard, "update", result);
    progress.enter(position, f, Phase::kQuery);
    detector.query(own, contacts);
    outcome.seconds_per_frame += seconds_since(start) / static_cast<double>(scene.frames);
    note_environment(guard, "query", result);
    contacts.canonicalize();
    check(contacts);
    if (f == 0) result.memory_bytes = std::max(heap_in_use(), heap_before) - heap_before;
    result.contact_hash = chain_hash(result.contact_hash, f, contacts);
    truth_pairs.push_back(judged.truth[f].surface.bodies);
    reported_pairs.push_back(contacts.bodies);
    if (asks_body) {
      ask(detector, Question::kBody, check, by_body);
      note_environment(guard, "query", result);
      contacts.bodies = by_body.bodies;
    }
    judge.add_frame(f, judged.truth[f], contacts);
    progress.enter(position, f, Phase::kTrace);
    losses.add_frame(detector.trace(), judged.truth[f].surface.triangles);
  }
  result.frames = scene.frames;
  result.contact_frames = count_contact(judged.contact_frames);
  result.levels = judge.levels();
  result.per_frame = judge.per_frame();
  result.disagreements = judge.disagreements();
  result.stages = losses.stages();
  result.episodes = find_episodes(truth_pairs, reported_pairs);
  return outcome;
}

void measure_hover_gaps(const JudgedScene& judged, std::uint32_t position, Detector& detector,
                        Oracle& oracle, ProgressWriter& progress, RunResult& result) {
  const Scene& scene = *judged.scene;
  const double tolerance = 1e-6 * scene.size();
  const FloatEnvironmentGuard guard;
  for (Episode& e : result.episodes) {
    if (!e.first_reported) continue;
    const std::size_t f = *e.first_reported;
    progress.enter(position, f, Phase::kUpdate);
    if (!scene.scripted() || f == 0) {
      progress.enter(SharedProgress::kNoDetector, f, Phase::kTruth);
      e.hover_gap = oracle.distance(judged.frame(f), e.bodies).upper;
      continue;
    }
    PairProbe probe(judged, detector, oracle, e.bodies);
    e.hover_gap = bisect_hover_gap(
        scene.time_of(f - 1), scene.time_of(f), tolerance,
        [&](double t) {
          progress.enter(position, f, Phase::kQuery);
          const bool reported = probe.reports(t);
          note_environment(guard, "query", result);
          return reported;
        },
        [&](double t) {
          progress.enter(SharedProgress::kNoDetector, f, Phase::kTruth);
          return probe.distance(t);
        });
  }
}

}  // namespace contactcheck
