// Seen in Bullet 3.24 (Debian 12, single precision), November 2026:
// - The hulls themselves have no margin; a joint is made when their signed distance is less than
//   the sum of the bodies' margins, whose default is 0.25 world units each.
// - GJK and EPA stop at 1e-4 world units, so that the scale counts here too; an EPA that fails is
//   no contact, without an error.
// - Joints go to the first body, and belong to nobody until cleanupClusters(): they are freed here.
// - There is no early-out.
#include "reference/adapters/bullet_cl.h"

#include "reference/adapters/bullet_clusters.h"
#include "reference/adapters/bullet_soft_detector.h"

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

class ClusterDetector final : public BulletSoftDetector {
 public:
  ClusterDetector(int clusters, double margin, double scale)
      : BulletSoftDetector(cl_semantics(), btSoftBody::fCollision::CL_SS, margin, scale),
        clusters_(clusters) {}

  std::vector<std::string> notes() override {
    for (const auto& body : bodies())
      if (body->bullet().m_nodes.size() > kMostNodesForBullet)
        return {
            "Bullet cannot divide a body of more than 71888 vertices into clusters: they are made "
            "around the centres of the clusters of a sample"};
    return {};
  }

 private:
  void prepare_body(SoftBody& body) override { make_clusters(body.bullet(), clusters_); }
  void refit(SoftBody& body) override { refit_clusters(body.bullet()); }
  void collide(std::uint32_t a, std::uint32_t b, Question, ContactSet& out) override {
    if (clusters_meet(bodies()[a]->bullet(), bodies()[b]->bullet())) out.bodies.push_back({a, b});
  }

  static bool clusters_meet(btSoftBody& a, btSoftBody& b) {
    a.defaultCollisionHandler(&b);
    const bool contact = a.m_joints.size() > 0;
    for (int j = 0; j < a.m_joints.size(); ++j) btAlignedFree(a.m_joints[j]);
    a.m_joints.resize(0);
    return contact;
  }

  int clusters_;
};

}  // namespace

std::unique_ptr<Detector> make_bullet_cl(int clusters, double margin, double scale) {
  return std::make_unique<ClusterDetector>(clusters, margin, scale);
}

}  // namespace contactcheck
