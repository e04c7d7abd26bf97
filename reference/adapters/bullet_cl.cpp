// Seen in Bullet 3.24 (Debian 12, single precision), November 2026:
// - The hulls themselves have no margin; a joint is made when their signed distance is less than
//   the sum of the bodies' margins, whose default is 0.25 world units each.
// - GJK and EPA stop at 1e-4 world units, so that the scale counts here too; an EPA that fails is
//   no contact, without an error.
// - Joints go to the first body, and belong to nobody until cleanupClusters(): they are freed here.
// - There is no early-out.
#include "reference/adapters/bullet_cl.h"

#include "core/types/check.h"
#include "reference/adapters/bullet_clusters.h"
#include "reference/adapters/bullet_scale.h"
#include "reference/adapters/bullet_soft_body.h"

namespace contactcheck {
namespace {

Semantics cl_semantics() {
  Semantics semantics;
  semantics.levels = {Level::kBody};
  semantics.questions = {Question::kBody};
  semantics.closed = false;
  semantics.precision = Precision::kSingle;
  semantics.means =
      "the convex hulls of two clusters of vertices (k-means at rest) overlap or are nearer than "
      "the sum of the margins";
  return semantics;
}

class ClusterDetector final : public Detector {
 public:
  ClusterDetector(int clusters, double margin, double scale)
      : clusters_(clusters), margin_(margin), scale_option_(scale), semantics_(cl_semantics()) {
    set_scale(scale > 0.0 ? scale : 1.0);
  }

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }

  void prepare(const std::vector<Body>& bodies) override {
    set_scale(scale_option_ > 0.0 ? scale_option_ : automatic_bullet_scale(bodies));
    bodies_.clear();
    const SoftBodySettings settings{semantics_.scale, fed_value(margin_, semantics_.scale),
                                    btSoftBody::fCollision::CL_SS};
    for (const Body& body : bodies) {
      bodies_.push_back(std::make_unique<SoftBody>(world_, body.shape->mesh, settings));
      make_clusters(bodies_.back()->bullet(), clusters_);
    }
  }

  void update(const Frame& frame) override {
    CONTACTCHECK_INVARIANT(frame.bodies.size() == bodies_.size(), "one state per body");
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      bodies_[b]->feed(frame.bodies[b].vertices);
      refit_clusters(bodies_[b]->bullet());
    }
  }

  void query(Question question, ContactSet& out) override {
    CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
    for (std::uint32_t a = 0; a < bodies_.size(); ++a) {
      for (std::uint32_t b = a + 1; b < bodies_.size(); ++b) {
        if (!bodies_[a]->boxes_meet(*bodies_[b])) continue;
        if (collide(bodies_[a]->bullet(), bodies_[b]->bullet())) out.bodies.push_back({a, b});
      }
    }
  }

  std::vector<std::string> notes() override {
    for (const auto& body : bodies_)
      if (body->bullet().m_nodes.size() > kMostNodesForBullet)
        return {
            "Bullet cannot divide a body of more than 71888 vertices into clusters: they are made "
            "around the centres of the clusters of a sample"};
    return {};
  }

 private:
  void set_scale(double scale) {
    semantics_.scale = scale;
    semantics_.margin = sum_of_margins(margin_, scale);
  }

  static bool collide(btSoftBody& a, btSoftBody& b) {
    a.defaultCollisionHandler(&b);
    const bool contact = a.m_joints.size() > 0;
    for (int j = 0; j < a.m_joints.size(); ++j) btAlignedFree(a.m_joints[j]);
    a.m_joints.resize(0);
    return contact;
  }

  int clusters_;
  double margin_;        // of one body, metres
  double scale_option_;  // 0: from the scene
  Semantics semantics_;
  SoftBodyWorld world_;
  std::vector<std::unique_ptr<SoftBody>> bodies_;
};

}  // namespace

std::unique_ptr<Detector> make_bullet_cl(int clusters, double margin, double scale) {
  return std::make_unique<ClusterDetector>(clusters, margin, scale);
}

}  // namespace contactcheck
