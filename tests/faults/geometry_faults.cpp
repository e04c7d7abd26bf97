#include "tests/faults/geometry_faults.h"

#include <signal.h>

#include <algorithm>
#include <string>

#include "tests/faults/broken_detectors.h"

namespace contactcheck::test {
namespace {

/// Knows the triangles of the bodies and where they are.
class LooksAtBodies : public TruthfulDetector {
 public:
  void prepare(const std::vector<Body>& bodies) override {
    TruthfulDetector::prepare(bodies);
    meshes_.clear();
    for (const Body& body : bodies) meshes_.push_back(body.shape->mesh);
  }
  void update(const Frame& frame) override {
    TruthfulDetector::update(frame);
    for (std::size_t b = 0; b < meshes_.size(); ++b)
      meshes_[b].vertices.assign(frame.bodies[b].vertices.begin(), frame.bodies[b].vertices.end());
  }

 protected:
  std::vector<TriangleMesh> meshes_;
};

/// Misses pairs of which a corner lies above z = 1.5.
class MissesHigh : public LooksAtBodies {
  bool is_high(std::uint32_t body, std::uint32_t triangle) const {
    const Triangle& t = meshes_[body].triangles[triangle];
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return meshes_[body].vertices[v].z() > 1.5; });
  }
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    std::erase_if(truth, [&](const ElementPair& p) {
      return is_high(p.body_a, p.a) || is_high(p.body_b, p.b);
    });
    return truth;
  }
};

/// Misses all pairs where the first body has three triangles or more.
class MissesCrowds : public LooksAtBodies {
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    if (meshes_.front().triangles.size() >= 3) truth.clear();
    return truth;
  }
};

/// Dies where the bodies together have five triangles or more.
class CrashesInCrowds : public LooksAtBodies {
 public:
  void query(Question question, ContactSet& out) override {
    std::size_t all = 0;
    for (const TriangleMesh& mesh : meshes_) all += mesh.triangles.size();
    if (all >= 5) {
      signal(SIGSEGV, SIG_DFL);
      raise(SIGSEGV);
    }
    LooksAtBodies::query(question, out);
  }
};

/// Finds nothing in the second and all later answers of its process.
class ForgetsAfterOnce : public LooksAtBodies {
 public:
  void prepare(const std::vector<Body>& bodies) override {
    LooksAtBodies::prepare(bodies);
    ++prepared_in_process();
  }

 private:
  static int& prepared_in_process() {
    static int count = 0;
    return count;
  }
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    if (prepared_in_process() > 1) truth.clear();
    return truth;
  }
};

/// Misses all pairs of bodies that a lattice deforms: whose first vertex is none of the nodes.
class MissesInLattices : public LooksAtBodies {
 public:
  void update(const Frame& frame) override {
    LooksAtBodies::update(frame);
    const BodyState& body = frame.bodies.front();
    deforms_ =
        std::find(body.nodes.begin(), body.nodes.end(), body.vertices.front()) == body.nodes.end();
  }

 private:
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    if (deforms_) truth.clear();
    return truth;
  }
  bool deforms_ = false;
};

template <typename Faulty>
void add(DetectorCatalog& catalog, const std::string& id, const std::string& summary) {
  DetectorInfo info;
  info.id = id;
  info.summary = summary;
  info.make = [](const Options&) { return std::make_unique<Faulty>(); };
  catalog.add(std::move(info));
}

}  // namespace

void register_geometry_faults(DetectorCatalog& catalog) {
  add<MissesHigh>(catalog, "fault-misses-high", "misses what reaches above z = 1.5");
  add<MissesCrowds>(catalog, "fault-misses-crowds", "misses all of three triangles or more");
  add<CrashesInCrowds>(catalog, "fault-crashes-in-crowds", "dies of five triangles or more");
  add<ForgetsAfterOnce>(catalog, "fault-forgets", "misses all but in a fresh process");
  add<MissesInLattices>(catalog, "fault-misses-in-lattices", "misses what a lattice deforms");
}

}  // namespace contactcheck::test
