// Detectors against the oracle.
#include <algorithm>
#include <exception>
#include <memory>
#include <utility>

#include "reference/oracle/oracle.h"
#include "tests/faults/mutant_checks.h"

namespace contactcheck::test {
namespace {

std::vector<std::string> lattice_detectors() {
  return {"ffd-grid+tri",
          "ffd-aabb+tri",
          "ffd-aabb+tri:cell=0.2",
          "ffd-aabb-sphere+tri",
          "ffd-aabb-sphere2+tri",
          "ffd-aabb-sphereN+tri",
          "bd-tree",
          "bd-tree:bound=paper,leaf=1",
          "bd-tree:reference=rigid"};
}

std::vector<std::string> general_detectors() {
  return {"ffd-lazy",          "ffd-lazy:bounds=nodes",
          "full-refit",        "ffd-lazy:bounds=nodes,threads=2",
          "aabb-tree",         "full-refit:threads=2",
          "aabb-tree:leaf=1",  "spatial-hash",
          "sphere-tree",       "spatial-hash:cell=0.3",
          "sphere-tree:leaf=1"};
}

// Sets made by hand: what core makes of a set of contacts may be what is wrong.
template <typename T>
std::vector<T> as_set(std::vector<T> items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
  return items;
}

std::vector<ElementPair> oriented(std::vector<ElementPair> pairs) {
  for (ElementPair& p : pairs)
    if (p.body_a > p.body_b) p = {p.body_b, p.body_a, p.b, p.a};
  return as_set(std::move(pairs));
}

std::vector<BodyPair> oriented(std::vector<BodyPair> pairs) {
  for (BodyPair& p : pairs)
    if (p.a > p.b) p = {p.b, p.a};
  return as_set(std::move(pairs));
}

std::vector<BodyPair> bodies_of(const std::vector<ElementPair>& pairs) {
  std::vector<BodyPair> bodies;
  for (const ElementPair& p : pairs) bodies.push_back({p.body_a, p.body_b});
  return as_set(std::move(bodies));
}

struct FrameTruth {
  std::vector<ElementPair> triangles;
  std::vector<BodyPair> bodies;
};

std::vector<FrameTruth> truth_of(const Scene& scene) {
  oracle::Oracle oracle(scene.bodies);
  std::vector<FrameTruth> truth;
  for (const FrameData& frame : scene.frames) {
    FrameTruth& t = truth.emplace_back();
    t.triangles = oriented(oracle.judge(frame.frame(), {}).surface.triangles);
    t.bodies = bodies_of(t.triangles);
  }
  return truth;
}

// One detector on all frames forth and back: one that keeps something of an earlier frame is wrong
// in a later one.
class DetectorRun {
 public:
  DetectorRun(const MutantScene& scene, std::string name, MutantFindings& out)
      : scene_(scene), name_(std::move(name)), out_(out) {}

  void judge(const std::vector<FrameTruth>& truth) {
    enter(0, "prepare");
    const std::unique_ptr<Detector> detector = prepared(name_, scene_.scene);
    const std::size_t frames = truth.size();
    for (std::size_t f = 0; f < frames; ++f) judge_frame(*detector, f, truth[f]);
    for (std::size_t f = frames - 1; f-- > 0;) judge_frame(*detector, f, truth[f]);
  }

 private:
  void enter(std::size_t frame, const std::string& level) {
    out_.enter({scene_.name, frame, name_, level});
  }

  void judge_frame(Detector& detector, std::size_t index, const FrameTruth& truth) {
    const Frame frame = scene_.scene.frames[index].frame(index);
    enter(index, "triangle");
    ContactSet triangles, bodies;
    detector.update(frame);
    detector.query(Question::kTriangles, triangles);
    out_.expect_same(truth.triangles, oriented(std::move(triangles.triangles)));
    enter(index, "body");
    detector.query(Question::kBody, bodies);
    out_.expect_same(truth.bodies, oriented(std::move(bodies.bodies)));
  }

  const MutantScene& scene_;
  std::string name_;
  MutantFindings& out_;
};

}  // namespace

void check_detectors(const MutantScene& scene, MutantFindings& out) {
  std::vector<std::string> names = general_detectors();
  if (scene.lattices)
    for (std::string& name : lattice_detectors()) names.push_back(std::move(name));
  out.enter({scene.name, 0, "oracle", "triangle"});
  const std::vector<FrameTruth> truth = truth_of(scene.scene);
  for (const std::string& name : names) {
    try {
      DetectorRun(scene, name, out).judge(truth);
    } catch (const std::exception& e) {
      out.add(std::string("threw: ") + e.what());
    }
  }
}

}  // namespace contactcheck::test
