// FCL's continuous collision of deforming meshes as a detector.
//
//   fcl-ccd  one hierarchy of axis-aligned boxes per body, refitted to the vertices of both ends of
//            a step (FCL's Update calls); MeshContinuousCollisionTraversalNode tests the six pairs
//            of a vertex and a triangle and the nine of two edges of every two triangles
//
// It claims pairs of triangles and of bodies, with times, in double. It claims no exactness: its
// tests have absolute tolerances (fcl_impact.cpp).
//
// Seen in FCL 0.7.0 (Debian 12), November 2026:
// - fcl::continuousCollide takes rigid motions alone; only the traversal node knows the vertices of
//   two frames, and no function of FCL's interface starts it.
// - The last vertices that a model was given become the previous ones when an update begins, so in
//   a row of steps each frame is handed over once. A model that was updated refuses to have its
//   vertices replaced from then on: elsewhere the start is an update, too.
// - Triangles in contact at the start are found only where a vertex or two edges touch.
#include <fcl/config.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/utility.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_continuous_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/broad/body_pairs.h"
#include "core/types/check.h"
#include "reference/adapters/adapters.h"
#include "reference/adapters/body_pair_detector.h"
#include "reference/adapters/fcl_model.h"

namespace contactcheck::adapters {
namespace {

using Box = fcl::AABBd;

/// One body: its hierarchy, over the step of the last update.
class MovingBody {
 public:
  explicit MovingBody(const TriangleMesh& mesh) { build_model(model_, mesh); }

  void update(std::span<const Vec3> start, std::span<const Vec3> end) {
    CONTACTCHECK_INVARIANT(static_cast<int>(start.size()) == model_.num_vertices &&
                               static_cast<int>(end.size()) == model_.num_vertices,
                           "one position per vertex at both ends");
    if (!std::equal(start.begin(), start.end(), model_.vertices)) update_to(start);
    update_to(end);
  }

  const fcl::BVHModel<Box>& model() const { return model_; }

 private:
  void update_to(std::span<const Vec3> vertices) {
    require_ok(model_.beginUpdateModel(), "beginUpdateModel");
    for (const Vec3& vertex : vertices) require_ok(model_.updateVertex(vertex), "updateVertex");
    require_ok(model_.endUpdateModel(), "endUpdateModel");
  }

  fcl::BVHModel<Box> model_;
};

Semantics semantics_of_fcl() {
  Semantics out;
  out.levels = {Level::kImpactTriangle, Level::kImpact};
  out.questions = {Question::kImpacts};
  return out;
}

class FclContinuous final : public Detector {
 public:
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }

  void prepare(const std::vector<Body>& bodies) override {
    bodies_.clear();
    for (const Body& body : bodies)
      bodies_.push_back(std::make_unique<MovingBody>(body.shape->mesh));
  }

  void update(const Frame&) override {
    throw std::logic_error("fcl-ccd answers questions of steps alone");
  }

  void update_step(const Step& step) override {
    boxes_.assign(bodies_.size(), {});
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (const auto* frame : {&step.start, &step.end})
        for (const Vec3& vertex : frame->bodies[b].vertices) boxes_[b].extend(vertex);
    pairs_.clear();
    find_candidate_bodies(boxes_, pairs_);
    std::vector<bool> meets(bodies_.size(), false);
    for (const BodyPair& pair : pairs_) meets[pair.a] = meets[pair.b] = true;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (meets[b]) bodies_[b]->update(step.start.bodies[b].vertices, step.end.bodies[b].vertices);
  }

  void query(Question, ContactSet& out) override {
    fcl::CollisionRequestd request;
    request.num_max_contacts = std::numeric_limits<std::size_t>::max();
    for (const BodyPair& pair : pairs_) {
      fcl::detail::MeshContinuousCollisionTraversalNode<Box> node;
      const fcl::Transform3d identity = fcl::Transform3d::Identity();
      if (!fcl::detail::initialize(node, bodies_[pair.a]->model(), identity,
                                   bodies_[pair.b]->model(), identity, request))
        throw std::runtime_error("FCL's initialize of the continuous traversal returned false");
      fcl::detail::collide<double>(&node);
      for (const auto& found : node.pairs)
        out.impact_triangles.push_back({pair.a, pair.b, static_cast<std::uint32_t>(found.id1),
                                        static_cast<std::uint32_t>(found.id2)});
      if (!node.pairs.empty()) out.impacts.push_back({pair, node.time_of_contact});
    }
  }

 private:
  const Semantics semantics_ = semantics_of_fcl();
  std::vector<std::unique_ptr<MovingBody>> bodies_;  // models cannot be moved
  std::vector<Aabb> boxes_;
  std::vector<BodyPair> pairs_;
};

}  // namespace

DetectorInfo fcl_ccd_detector() {
  DetectorInfo info;
  info.id = "fcl-ccd";
  info.summary =
      "contact between frames: FCL's continuous mesh traversal on previous and current vertices";
  info.given = std::string(kSweepAndPrune) + "each frame of steps in a row is handed over once";
  info.make = [](const Options&) { return std::make_unique<FclContinuous>(); };
  return info;
}

}  // namespace contactcheck::adapters
