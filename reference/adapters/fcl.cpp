// FCL's mesh collision as detectors.
//
//   fcl-aabb     axis-aligned boxes, traversed directly: FCL at its best
//   fcl-obbrss   oriented boxes and swept spheres, through fcl::collide, refitted top-down
//   fcl-collide  axis-aligned boxes through fcl::collide, the documented call
//
// All three hold one hierarchy per body, and of every body whose box meets that of another replace
// the vertices and refit it, or build it anew (option `refit`), on every update. FCL's own default,
// bottom-up, is the fastest; with oriented boxes it is wrong in twice as many hard cases as
// top-down, which is therefore the default of fcl-obbrss (README.md has the table). They answer
// about surfaces, closed (touching is contact), in double; a body within another is no contact.
// They claim no exactness: FCL's triangle test rounds, and its oriented boxes miss pairs by
// rounding.
//
// Seen in FCL 0.7.0 (Debian 12), November 2026:
// - fcl::collide copies both models on every call for boxes that are not oriented
//   (BVHCollideImpl::run): milliseconds per pair whatever the answer. fcl-aabb starts the same
//   traversal without the copies; the specialisations for oriented boxes do not copy.
// - A request without contact points (enable_contact = false) still records the two triangles of
//   every pair, each once, by the same separating-axis test, and does not build the planes that
//   degenerate triangles lack.
// - A request with contact points takes a pair's depth along one of the two face normals, the
//   smaller one, out of the many directions in which two triangles may part; for a triangle
//   without area the normal is whatever was in memory: no depth is passed on for it.
// - Oriented boxes that a bottom-up refit joins may leave out what they hold: the first corner that
//   OBB's merge_smalldist looks at never counts as the smallest.
// - Errors are return codes, and a call out of sequence leaves the old geometry in place.
// - The Replace calls fit boxes to the new vertices; the Update calls would fit them to old and new
//   ones, for continuous collision.
#include <fcl/config.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "core/types/check.h"
#include "core/types/shared_corners.h"
#include "reference/adapters/adapters.h"
#include "reference/adapters/body_pair_detector.h"
#include "reference/adapters/fcl_model.h"

namespace contactcheck::adapters {
namespace {

/// FCL has no notion of neighbours: their contacts, beyond what they share, it cannot tell.
Semantics fcl_semantics(bool self) {
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kTriangle};
  semantics.questions = {Question::kTriangles, Question::kBody, Question::kContacts};
  if (self) {
    semantics.levels.push_back(Level::kSelf);
    semantics.questions.push_back(Question::kSelf);
  }
  semantics.closed = true;
  semantics.depth = DepthKind::kConvexPair;
  return semantics;
}

fcl::CollisionRequestd request_for(Question question) {
  fcl::CollisionRequestd request;
  request.num_max_contacts =
      question == Question::kBody ? 1 : std::numeric_limits<std::size_t>::max();
  request.enable_contact = question == Question::kContacts;
  return request;
}

template <typename BV>
using CollideFunction = void (*)(fcl::BVHModel<BV>&, fcl::BVHModel<BV>&,
                                 const fcl::CollisionRequestd&, fcl::CollisionResultd&);

template <typename BV>
void collide_documented(fcl::BVHModel<BV>& a, fcl::BVHModel<BV>& b,
                        const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  const std::size_t count = fcl::collide(&a, identity, &b, identity, request, result);
  if (count != result.numContacts()) {
    throw std::runtime_error("FCL's collide returned " + std::to_string(count) + " with " +
                             std::to_string(result.numContacts()) + " contacts");
  }
}

template <typename BV>
void collide_directly(fcl::BVHModel<BV>& a, fcl::BVHModel<BV>& b,
                      const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
  fcl::detail::MeshCollisionTraversalNode<BV> node;
  // Not const: initialize() would apply and reset them, which identities spare it.
  fcl::Transform3d transform_a = fcl::Transform3d::Identity();
  fcl::Transform3d transform_b = fcl::Transform3d::Identity();
  if (!fcl::detail::initialize(node, a, transform_a, b, transform_b, request, result)) {
    throw std::runtime_error("FCL's initialize of the mesh traversal returned false");
  }
  fcl::detail::collide(&node);
}

/// FCL's self-collision traversal meets every two leaves of one hierarchy; this leaves out pairs
/// that share a vertex, which FCL would call contacts.
template <typename BV>
class SelfNode final : public fcl::detail::MeshCollisionTraversalNode<BV> {
 public:
  explicit SelfNode(const std::vector<Triangle>& linked) : linked_(linked) {}

  void leafTesting(int b1, int b2) const override {
    const int a = this->model1->getBV(b1).primitiveId(), b = this->model2->getBV(b2).primitiveId();
    if (shared_corners(linked_[static_cast<std::size_t>(a)], linked_[static_cast<std::size_t>(b)])
            .count == 0)
      fcl::detail::MeshCollisionTraversalNode<BV>::leafTesting(b1, b2);
  }

 private:
  const std::vector<Triangle>& linked_;
};

template <typename BV>
void collide_with_itself(fcl::BVHModel<BV>& model, const std::vector<Triangle>& linked,
                         fcl::CollisionResultd& result) {
  SelfNode<BV> node(linked);
  fcl::Transform3d first = fcl::Transform3d::Identity(), second = fcl::Transform3d::Identity();
  const fcl::CollisionRequestd request = request_for(Question::kTriangles);
  if (!fcl::detail::initialize(node, model, first, model, second, request, result))
    throw std::runtime_error("FCL's initialize of the mesh traversal returned false");
  fcl::detail::selfCollide<double>(&node);
}

enum class Refit : std::uint8_t { kBottomUp, kTopDown, kRebuild };

struct FclSettings {
  Refit refit = Refit::kBottomUp;
  fcl::detail::SplitMethodType split = fcl::detail::SPLIT_METHOD_MEAN;
};

/// One body: its hierarchy, of the vertices of the last update.
template <typename BV>
class FclBody {
 public:
  FclBody(const TriangleMesh& mesh, FclSettings settings) : refit_(settings.refit) {
    model_.bv_splitter = std::make_shared<fcl::detail::BVSplitter<BV>>(settings.split);
    build_model(model_, mesh);
  }

  /// One by one: replaceSubModel wants a vector of its own, which would be a copy more.
  void update(std::span<const Vec3> vertices) {
    CONTACTCHECK_INVARIANT(static_cast<int>(vertices.size()) == model_.num_vertices,
                           "one position per vertex");
    require_ok(model_.beginReplaceModel(), "beginReplaceModel");
    for (const Vec3& vertex : vertices) require_ok(model_.replaceVertex(vertex), "replaceVertex");
    require_ok(model_.endReplaceModel(/*refit=*/refit_ != Refit::kRebuild,
                                      /*bottomup=*/refit_ == Refit::kBottomUp),
               "endReplaceModel");
  }

  /// By FCL's own test: without area it leaves the triangle's normal as it was in memory, which may
  /// be one of an earlier triangle.
  bool has_normal(std::uint32_t triangle) const {
    const fcl::Triangle& t = model_.tri_indices[triangle];
    const Vec3 &a = model_.vertices[t[0]], &b = model_.vertices[t[1]], &c = model_.vertices[t[2]];
    return (b - a).cross(c - a).squaredNorm() > 0.0;
  }

  fcl::BVHModel<BV>& model() { return model_; }

 private:
  Refit refit_;
  fcl::BVHModel<BV> model_;
};

template <typename BV>
class FclDetector final : public BodyPairDetector {
 public:
  FclDetector(CollideFunction<BV> call, bool self, FclSettings settings, Prefilter prefilter)
      : BodyPairDetector(prefilter),
        semantics_(fcl_semantics(self)),
        settings_(settings),
        call_(call) {}

  const Semantics& semantics() const override { return semantics_; }

  void prepare(const std::vector<Body>& bodies) override {
    set_bodies(bodies);
    bodies_.clear();
    for (const Body& body : bodies)
      bodies_.push_back(std::make_unique<FclBody<BV>>(body.shape->mesh, settings_));
  }

 private:
  void move(std::span<const CandidateBody> bodies) override {
    for (const CandidateBody& body : bodies) bodies_[body.body]->update(body.vertices);
  }

  void collide(BodyPair pair, Question question, ContactSet& out) override {
    result_.clear();
    call_(bodies_[pair.a]->model(), bodies_[pair.b]->model(), request_for(question), result_);
    if (question == Question::kBody) {
      if (result_.isCollision()) out.bodies.push_back(pair);
      return;
    }
    for (std::size_t i = 0; i < result_.numContacts(); ++i) {
      const fcl::Contactd& contact = result_.getContact(i);
      const ElementPair triangles{pair.a, pair.b, static_cast<std::uint32_t>(contact.b1),
                                  static_cast<std::uint32_t>(contact.b2)};
      out.triangles.push_back(triangles);
      if (question == Question::kContacts) append_depth(triangles, contact, out);
    }
  }

  void collide_self(std::uint32_t body, ContactSet& out) override {
    result_.clear();
    collide_with_itself(bodies_[body]->model(), shape(body).linked(), result_);
    for (std::size_t i = 0; i < result_.numContacts(); ++i) {
      const fcl::Contactd& contact = result_.getContact(i);
      out.self.push_back(
          {body, static_cast<std::uint32_t>(contact.b1), static_cast<std::uint32_t>(contact.b2)});
    }
  }

  void append_depth(const ElementPair& triangles, const fcl::Contactd& contact,
                    ContactSet& out) const {
    if (!bodies_[triangles.body_a]->has_normal(triangles.a) ||
        !bodies_[triangles.body_b]->has_normal(triangles.b))
      return;
    const bool unit = std::abs(contact.normal.norm() - 1.0) < 1e-6;  // false for NaN
    if (!unit || !(contact.penetration_depth >= 0.0)) return;
    out.piece_contacts.push_back({triangles, contact.penetration_depth, contact.normal});
  }

  const Semantics semantics_;
  const FclSettings settings_;
  CollideFunction<BV> call_;
  // Models cannot be moved; FCL holds raw arrays.
  std::vector<std::unique_ptr<FclBody<BV>>> bodies_;
  fcl::CollisionResultd result_;  ///< kept for its capacity
};

FclSettings settings_from(const Options& options) {
  FclSettings out;
  const std::string &refit = options.at("refit"), &split = options.at("split");
  if (refit == "top-down") out.refit = Refit::kTopDown;
  if (refit == "rebuild") out.refit = Refit::kRebuild;
  if (split == "median") out.split = fcl::detail::SPLIT_METHOD_MEDIAN;
  if (split == "center") out.split = fcl::detail::SPLIT_METHOD_BV_CENTER;
  return out;
}

template <typename BV>
DetectorInfo info(std::string id, std::string summary, const std::string& given,
                  const std::string& refit, CollideFunction<BV> collide, bool self) {
  DetectorInfo out;
  out.id = std::move(id);
  out.summary = std::move(summary);
  out.given = kSweepAndPrune + given + "; body ends at the first contact of two bodies";
  out.options = {
      prefilter_option(),
      choice_option("refit", refit, {"bottom-up", "top-down", "rebuild"},
                    "a frame's boxes: joined from their children's, fitted to the triangles below "
                    "them, or of a hierarchy that is built anew"),
      choice_option("split", "mean", {"mean", "median", "center"},
                    "where a hierarchy that is built divides a box: at the mean or the median of "
                    "its triangles' centres, or at its own centre")};
  out.make = [collide, self](const Options& options) {
    return std::make_unique<FclDetector<BV>>(collide, self, settings_from(options),
                                             prefilter_of(options));
  };
  return out;
}

}  // namespace

Adapter fcl_adapter() {
  using Box = fcl::AABBd;
  using OrientedBox = fcl::OBBRSSd;
  return {"fcl",
          FCL_VERSION,
          {info<Box>("fcl-aabb",
                     "FCL's axis-aligned box tree, refitted, traversed directly: FCL at its best",
                     "models are not copied", "bottom-up", &collide_directly<Box>, true),
           info<OrientedBox>(
               "fcl-obbrss", "FCL's tree of oriented boxes and swept spheres, refitted top-down",
               "models are not copied", "top-down", &collide_documented<OrientedBox>, true),
           info<Box>("fcl-collide",
                     "FCL's axis-aligned box tree through fcl::collide, which copies both models",
                     "as documented, and so with copies of both models", "bottom-up",
                     &collide_documented<Box>, false)}};
}

}  // namespace contactcheck::adapters
