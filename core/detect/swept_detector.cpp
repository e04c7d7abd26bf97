#include "core/detect/swept_detector.h"

#include <span>
#include <utility>
#include <vector>

#include "core/broad/aabb_tree.h"
#include "core/detect/families.h"
#include "core/detect/step_contacts.h"
#include "core/types/check.h"
#include "core/types/mesh_topology.h"

namespace contactcheck {
namespace {

// As aabb-tree (triangle_register.cpp).
constexpr std::uint32_t kLeafSize = 4;

class SweptDetector final : public Detector {
 public:
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }

  void prepare(const std::vector<Body>& bodies) override {
    shapes_.clear();
    for (const Body& body : bodies) shapes_.push_back(body.shape.get());
    contacts_.prepare(bodies);
    trees_.prepare(bodies);
  }

  void update(const Frame&) override {
    throw std::logic_error("swept-aabb answers questions of steps alone");
  }

  void update_step(const Step& step) override {
    contacts_.begin(step);
    std::vector<std::span<const Vec3>> start, end;
    for (const BodyState& body : step.start.bodies) start.push_back(body.vertices);
    for (const BodyState& body : step.end.bodies) end.push_back(body.vertices);
    trees_.update(start, end);
  }

  void query(Question question, ContactSet& out) override {
    CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
    if (question == Question::kSelfImpacts) {
      for (const BodyShape* shape : shapes_) refuse_many_adjacent_pairs(shape->linked());
      trees_.visit_own_candidates([&](const SelfPair& pair) {
        contacts_.add_own(pair, out);
        return false;
      });
      return;
    }
    trees_.visit_candidates([&](const ElementPair& pair) {
      contacts_.add(pair, out);
      return false;
    });
    contacts_.finish(out);
  }

  std::vector<Count> counts() override { return {{"element_tests", contacts_.tested()}}; }

 private:
  const Semantics semantics_ = exact_step_semantics(true);
  std::vector<const BodyShape*> shapes_;
  AabbTrees trees_{kLeafSize};
  StepContacts contacts_;
};

}  // namespace

Semantics exact_step_semantics(bool self) {
  Semantics s;
  s.levels = {Level::kImpactVf, Level::kImpactEe, Level::kImpactTriangle, Level::kImpact};
  s.questions = {Question::kImpacts};
  s.exact = true;
  if (self) {
    s.levels.insert(s.levels.end(), {Level::kImpactSelfVf, Level::kImpactSelfEe});
    s.questions.push_back(Question::kSelfImpacts);
  }
  return s;
}

std::unique_ptr<Detector> make_swept_aabb() { return std::make_unique<SweptDetector>(); }

void register_step_detectors(DetectorCatalog& catalog) {
  DetectorInfo info;
  info.id = "swept-aabb";
  info.summary =
      "contact between frames: trees of boxes over both ends of a step; exact tests of "
      "vertices, triangles and edges";
  info.make = [](const Options&) { return make_swept_aabb(); };
  catalog.add(std::move(info));
}

}  // namespace contactcheck
