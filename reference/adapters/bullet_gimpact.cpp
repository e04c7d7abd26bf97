// Bullet's GImpact, concave meshes against each other, as a detector.
//
//   bullet-gimpact  quantised box trees, refitted; triangles clipped against each other in pairs
//
// Options: `margin` (metres, per mesh; two triangles count below twice that distance), `scale`
// (world units per metre; 0: from the scene, see bullet.h).
//
// Seen in Bullet 3.24 (Debian 12, single precision), November 2026:
// - contactPairTest asks for algorithms of closest points; registerAlgorithm() sets those of
//   contact points only, and the answer is then empty without an error.
// - The boxes of a refitted tree are quantised to 16 bits within the bounds of the build plus one
//   world unit, and clamped to these: a mesh that has moved further is nowhere, and every contact
//   is lost without an error. See GimpactBody::room_for. On a grid much wider than the mesh all its
//   boxes are one, and every pair of triangles is tested. See GimpactBody::home_for.
// - The clip test: each triangle must have a part within the other's prism (its edges swept along
//   its normal) that reaches the other's plane or lies behind it, however far. Triangles back to
//   back are reported; so are, with a depth of no meaning, many neighbours of a true pair.
// - A margin shifts the planes and not the prisms' sides: disjoint triangles are found by it only
//   where their prisms meet, and the depth is that of the shifted planes.
// - A pair is reported once per corner of the clipped polygon, always with the pair's own depth;
//   the normal points from the second triangle to the first. Depths are never negative.
// - A triangle without area, or with a cross product whose square overflows, gets a plane of NaN
//   and is in contact with nothing, or (overflow) with all it meets.
// - The callback's return value is not looked at: no early-out.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "core/detect/option_info.h"
#include "core/types/check.h"
#include "reference/adapters/adapters.h"
#include "reference/adapters/body_pair_detector.h"
#include "reference/adapters/bullet.h"

namespace contactcheck::adapters {
namespace {

Semantics gimpact_semantics() {
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kTriangle};
  semantics.questions = {Question::kTriangles, Question::kContacts, Question::kBody};
  semantics.precision = Precision::kSingle;
  semantics.depth = DepthKind::kConvexPair;
  semantics.no_early_end = true;
  semantics.means =
      "each triangle has a part within the prism over the other's edges that reaches the other's "
      "plane or lies behind it, however far; a margin shifts the planes";
  return semantics;
}

/// World units, of Bullet's btPersistentManifold.cpp.
constexpr double kContactBreakingThreshold = 0.02;

/// One body: Bullet's shape over our own floats.
class GimpactBody {
 public:
  GimpactBody(const TriangleMesh& mesh, double scale, float margin)
      : mesh_(mesh), scale_(scale), margin_(margin), positions_(mesh.vertices.size()) {
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) indices_.push_back(static_cast<int>(v));
    rest_box_ = feed(mesh.vertices);
    // Far beyond what a body turns and stretches by, so that few ever leave their first home.
    // Scaled bodies are larger than 1; one that a scale from outside leaves smaller is tested
    // slowly.
    home_step_ = std::ldexp(1.0, std::ilogb(std::max(1.0, largest_side(rest_box_))) + 8);
    arrays_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.triangles.size()), indices_.data(), static_cast<int>(3 * sizeof(int)),
        static_cast<int>(positions_.size()), positions_.data()->data(),
        static_cast<int>(sizeof(Position)));
    object_.setWorldTransform(btTransform::getIdentity());
    build();
  }
  GimpactBody(const GimpactBody&) = delete;
  GimpactBody& operator=(const GimpactBody&) = delete;

  void update(std::span<const Vec3> vertices) {
    CONTACTCHECK_INVARIANT(vertices.size() == positions_.size(), "one position per vertex");
    const Aabb box = feed(vertices);
    const Vec3 home = home_for(box);
    const double room = room_for(box, home);
    if (home != home_ || room != room_) {
      home_ = home;
      room_ = room;
      feed_rest_at_home();
      build();
      feed(vertices);
    }
    refit(grain_of(box, home));
  }

  btCollisionObject& object() { return object_; }

  /// True when a triangle has no plane in floats.
  bool has_triangle_without_plane() const {
    for (std::size_t i = 0; i + 2 < indices_.size(); i += 3) {
      const btVector3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
      const float square = (b - a).cross(c - a).length2();
      if (!(square > 0.0f) || !std::isfinite(square)) return true;
    }
    return false;
  }

 private:
  using Position = std::array<btScalar, 3>;  // floats, but for a Bullet built in doubles

  btVector3 corner(std::size_t i) const {
    const Position& p = positions_[static_cast<std::size_t>(indices_[i])];
    return {p[0], p[1], p[2]};
  }

  /// Their box, in world units.
  /// @throws RefusedInput when a float overflows
  Aabb feed(std::span<const Vec3> vertices) {
    Aabb box;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      for (int axis = 0; axis < 3; ++axis) {
        const float fed = fed_value(vertices[v][axis], scale_);
        if (!std::isfinite(fed))
          throw RefusedInput("bullet-gimpact refuses a vertex that is not finite as a float");
        positions_[v][axis] = fed;
      }
      box.extend(Vec3(positions_[v][0], positions_[v][1], positions_[v][2]));
    }
    return box;
  }

  static double largest_side(const Aabb& box) {
    return box.empty() ? 0.0 : box.extent().maxCoeff();
  }

  void feed_rest_at_home() {
    feed(mesh_.vertices);
    for (Position& p : positions_)
      for (int axis = 0; axis < 3; ++axis) p[axis] += static_cast<float>(home_[axis]);
  }

  /// How far from its rest place the tree is made: at the steps of a coarse lattice, so that a body
  /// that moves on is rarely built anew, and one that comes back is answered as before. Without it
  /// a body 1e6 sizes away had one box in place of all, and a query did not end in minutes.
  Vec3 home_for(const Aabb& box) const {
    if (box.empty() || !(largest_coordinate(box) < 0x1p100))
      return Vec3::Zero();  // its floats would overflow
    Vec3 home;
    for (int axis = 0; axis < 3; ++axis)
      home[axis] =
          home_step_ * std::round((box.center()[axis] - rest_box_.center()[axis]) / home_step_);
    return home;
  }

  /// What one of Bullet's roundings of a coordinate may be off far from the origin: the distance of
  /// two floats. At the first home as Bullet itself has it, none.
  static double grain_of(const Aabb& box, const Vec3& home) {
    if (home.isZero(0.0)) return 0.0;
    const auto coordinate = static_cast<float>(largest_coordinate(box));
    return static_cast<double>(std::nextafter(coordinate, 2.0f * coordinate)) - coordinate;
  }

  /// Built at home, the tree knows places up to one unit beyond the rest box there. How much wider
  /// it has to be made to hold `box`: 0 or a power of two, for the reasons of home_for().
  double room_for(const Aabb& box, const Vec3& home) const {
    if (box.empty()) return 0.0;
    const Vec3 beyond = (rest_box_.lo + home - box.lo).cwiseMax(box.hi - rest_box_.hi - home);
    const double needed = beyond.maxCoeff() + margin_ + 2.0 * grain_of(box, home);
    double room = 0.0;
    while (room + 1.0 < needed && room < 0x1p120) room = std::max(1.0, 2.0 * room);
    return room;
  }

  /// @pre the rest positions at home are fed. The one way to a wider grid is a margin while it is
  /// made.
  void build() {
    shape_ = std::make_unique<btGImpactMeshShape>(arrays_.get());
    shape_->setMargin(static_cast<float>(room_));
    shape_->updateBound();
    object_.setCollisionShape(shape_.get());
  }

  /// Bullet rounds boxes to the nearest step of its grid. That is left as it is on Bullet's own
  /// grid; on a grid that was widened or moved here the boxes are padded by a step and a grain, or
  /// our widening would lose contacts (4 of 176 at 300 units from rest).
  void refit(double grain) {
    const double step = (rest_box_.extent().maxCoeff() + 2.0 * room_ + 2.0) / 65535.0;
    const bool own_grid = room_ == 0.0 && home_.isZero(0.0);
    shape_->setMargin(margin_ + (own_grid ? 0.0f : static_cast<float>(step + grain)));
    shape_->updateBound();
    shape_->setMargin(margin_);  // what the triangles are tested with
  }

  const TriangleMesh& mesh_;  // of the body's shape, which outlives the detector
  double scale_;
  float margin_;  // world units
  std::vector<Position> positions_;
  std::vector<int> indices_;
  Aabb rest_box_;  // world units
  double home_step_ = 0.0;
  Vec3 home_ = Vec3::Zero();
  double room_ = 0.0;
  std::unique_ptr<btTriangleIndexVertexArray> arrays_;
  std::unique_ptr<btGImpactMeshShape> shape_;
  btCollisionObject object_;
};

/// Bullet's dispatcher, with GImpact against GImpact registered for what contactPairTest asks for.
class GimpactWorld {
 public:
  GimpactWorld()
      : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &configuration_) {
    dispatcher_.registerClosestPointsCreateFunc(GIMPACT_SHAPE_PROXYTYPE, GIMPACT_SHAPE_PROXYTYPE,
                                                &create_);
  }

  void test(GimpactBody& a, GimpactBody& b, btCollisionWorld::ContactResultCallback& contacts) {
    world_.contactPairTest(&a.object(), &b.object(), contacts);
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btGImpactCollisionAlgorithm::CreateFunc create_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_;
};

/// Takes down what one contactPairTest reports.
class ContactCollector final : public btCollisionWorld::ContactResultCallback {
 public:
  ContactCollector(BodyPair pair, const btCollisionObject* first, Question question, double scale,
                   double margin, ContactSet& out)
      : pair_(pair),
        first_(first),
        question_(question),
        scale_(scale),
        margin_(margin),
        out_(out) {}

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* object_0, int,
                           int index_0, const btCollisionObjectWrapper*, int,
                           int index_1) override {
    any_ = true;
    if (question_ == Question::kBody) return 0.0f;
    const bool swapped = object_0->getCollisionObject() != first_;
    const auto i = static_cast<std::uint32_t>(swapped ? index_1 : index_0);
    const auto j = static_cast<std::uint32_t>(swapped ? index_0 : index_1);
    const ElementPair triangles{pair_.a, pair_.b, i, j};
    out_.triangles.push_back(triangles);
    if (question_ == Question::kContacts) append_depth(triangles, point, swapped);
    return 0.0f;
  }

  bool any() const { return any_; }

 private:
  /// Without the margins: a pair that only these bring together has no depth.
  void append_depth(const ElementPair& triangles, const btManifoldPoint& point, bool swapped) {
    const btVector3& n = point.m_normalWorldOnB;  // towards the first object
    const Vec3 outward = (swapped ? 1.0 : -1.0) * Vec3(n.x(), n.y(), n.z());
    const double depth = -static_cast<double>(point.getDistance()) / scale_ - 2.0 * margin_;
    const bool unit = std::abs(outward.norm() - 1.0) < 1e-3;  // false for NaN
    if (!unit || !(depth >= 0.0)) return;
    out_.piece_contacts.push_back({triangles, depth, outward.normalized()});
  }

  BodyPair pair_;
  const btCollisionObject* first_;
  Question question_;
  double scale_, margin_;
  ContactSet& out_;
  bool any_ = false;
};

class GimpactDetector final : public BodyPairDetector {
 public:
  GimpactDetector(double margin, double scale, Prefilter prefilter)
      : BodyPairDetector(prefilter),
        margin_(margin),
        scale_option_(scale),
        semantics_(gimpact_semantics()) {}

  const Semantics& semantics() const override { return semantics_; }

  void prepare(const std::vector<Body>& bodies) override {
    const double scale = scale_option_ > 0.0 ? scale_option_ : automatic_bullet_scale(bodies);
    semantics_.scale = scale;
    // As Bullet's own broad phase: boxes of the floats, grown by the margins and by
    // gContactBreakingThreshold.
    set_bodies(bodies, margin_ + kContactBreakingThreshold / scale, kRoundingOfFedBoxes);
    bodies_.clear();
    for (const Body& body : bodies)
      bodies_.push_back(
          std::make_unique<GimpactBody>(body.shape->mesh, scale, fed_value(margin_, scale)));
  }

  std::vector<std::string> notes() override {
    for (const CandidateBody& body : candidates()) {
      if (!bodies_[body.body]->has_triangle_without_plane()) continue;
      return {
          "bullet-gimpact finds no contact of triangles without area in single precision, and no "
          "depth where the square of the area overflows"};
    }
    return {};
  }

 private:
  void check(const Aabb& box) const override {
    for (const Vec3* corner : {&box.lo, &box.hi})
      for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(fed_value((*corner)[axis], semantics_.scale)))
          throw RefusedInput("bullet-gimpact refuses a vertex that is not finite as a float");
  }

  void move(std::span<const CandidateBody> bodies) override {
    for (const CandidateBody& body : bodies) bodies_[body.body]->update(body.vertices);
  }

  void collide(BodyPair pair, Question question, ContactSet& out) override {
    ContactCollector contacts(pair, &bodies_[pair.a]->object(), question, semantics_.scale, margin_,
                              out);
    world_.test(*bodies_[pair.a], *bodies_[pair.b], contacts);
    if (question == Question::kBody && contacts.any()) out.bodies.push_back(pair);
  }

  double margin_;        // metres
  double scale_option_;  // 0: from the scene
  Semantics semantics_;
  GimpactWorld world_;
  std::vector<std::unique_ptr<GimpactBody>> bodies_;  // Bullet holds their addresses
};

}  // namespace

Adapter bullet_gimpact_adapter() {
  DetectorInfo info;
  info.id = "bullet-gimpact";
  info.summary = "Bullet's GImpact: refitted box trees, triangles clipped in single precision";
  info.given = std::string(kSweepAndPrune) + "boxes are grown by the margins; no early end";
  info.options = {
      numeric_option("margin", "0", 0.0, 1e3, false, "metres around each mesh"),
      numeric_option("scale", "0", 0.0, 1048576.0, false,
                     "world units per metre; 0: as the smallest triangles need"),
      prefilter_option(),
  };
  info.make = [](const Options& options) {
    return std::make_unique<GimpactDetector>(
        number_option(options, "margin"), number_option(options, "scale"), prefilter_of(options));
  };
  return {"bullet", bullet_version(), {std::move(info)}};
}

}  // namespace contactcheck::adapters
