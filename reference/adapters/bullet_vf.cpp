// Seen in Bullet 3.24 (Debian 12, single precision), November 2026:
// - A contact needs (distance)^2 < (sum of the margins)^2, in floats: a margin of 0 finds nothing.
// - Contacts are added to m_scontacts of the body whose node it is, nodes of both bodies against
//   faces of the other, and are cleared by nobody but predictMotion().
// - A vertex exactly on a triangle has the normal 0 / 0.
// - The normal points from the face to the node, on whichever side it is: the solver pushes a
//   vertex that is inside further in.
// - There is no early-out.
#include "reference/adapters/bullet_vf.h"

#include <algorithm>
#include <cmath>

#include "core/types/check.h"
#include "reference/adapters/bullet_scale.h"
#include "reference/adapters/bullet_soft_body.h"

namespace contactcheck {
namespace {

Semantics vf_semantics() {
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kNear};
  semantics.informative = {Level::kVertex};
  semantics.questions = {Question::kContacts, Question::kBody};
  semantics.closed = false;
  semantics.precision = Precision::kSingle;
  semantics.depth = DepthKind::kVertexSurface;
  semantics.means =
      "a vertex of one body is nearer to a triangle of the other than the sum of their margins, on "
      "either side";
  return semantics;
}

class VertexFaceDetector final : public Detector {
 public:
  VertexFaceDetector(double margin, double scale)
      : margin_(margin), scale_option_(scale), semantics_(vf_semantics()) {
    set_scale(scale > 0.0 ? scale : 1.0);
  }

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }

  void prepare(const std::vector<Body>& bodies) override {
    set_scale(scale_option_ > 0.0 ? scale_option_ : automatic_bullet_scale(bodies));
    bodies_.clear();
    const SoftBodySettings settings{semantics_.scale, fed_value(margin_, semantics_.scale),
                                    btSoftBody::fCollision::VF_SS};
    for (const Body& body : bodies) {
      bodies_.push_back(std::make_unique<SoftBody>(world_, body.shape->mesh, settings));
      bodies_.back()->build_trees();
    }
  }

  void update(const Frame& frame) override {
    CONTACTCHECK_INVARIANT(frame.bodies.size() == bodies_.size(), "one state per body");
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      bodies_[b]->feed(frame.bodies[b].vertices);
      bodies_[b]->refit_trees();
    }
  }

  void query(Question question, ContactSet& out) override {
    CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
    for (std::uint32_t a = 0; a < bodies_.size(); ++a) {
      for (std::uint32_t b = a + 1; b < bodies_.size(); ++b) {
        if (!bodies_[a]->boxes_meet(*bodies_[b])) continue;
        const bool contact = collide(bodies_[a]->bullet(), bodies_[b]->bullet());
        if (question == Question::kBody) {
          if (contact) out.bodies.push_back({a, b});
          continue;
        }
        append_contacts(a, b, out);
        append_contacts(b, a, out);
      }
    }
  }

  // No trace(): a stage "visible" would have to list every pair of visible triangles.

  std::vector<std::string> notes() override {
    for (const auto& body : bodies_)
      if (body->has_invisible_triangle()) return {invisible_triangles_note(semantics_.scale)};
    return {};
  }

 private:
  void set_scale(double scale) {
    semantics_.scale = scale;
    semantics_.margin = sum_of_margins(margin_, scale);
  }

  static bool collide(btSoftBody& a, btSoftBody& b) {
    a.m_scontacts.resize(0);
    b.m_scontacts.resize(0);
    a.defaultCollisionHandler(&b);
    return a.m_scontacts.size() + b.m_scontacts.size() > 0;
  }

  /// Vertices of `body` near faces of `other`.
  void append_contacts(std::uint32_t body, std::uint32_t other, ContactSet& out) {
    const auto& contacts = bodies_[body]->bullet().m_scontacts;
    for (int i = 0; i < contacts.size(); ++i) {
      const btSoftBody::SContact& contact = contacts[i];
      const VertexInBody where{body, other, bodies_[body]->vertex_of(*contact.m_node)};
      out.near.push_back({body, other, where.vertex, bodies_[other]->triangle_of(*contact.m_face)});
      out.vertices.push_back(where);
      append_depth(where, contact, out);
    }
  }

  /// How far the node is from the face along the normal, from what Bullet passes to its solver.
  void append_depth(const VertexInBody& where, const btSoftBody::SContact& contact,
                    ContactSet& out) const {
    const Vec3 normal = wide(contact.m_normal);
    if (!(std::abs(normal.norm() - 1.0) < 1e-3)) return;  // NaN where the node is on the face
    Vec3 point = Vec3::Zero();
    for (int corner = 0; corner < 3; ++corner)
      point +=
          static_cast<double>(contact.m_weights[corner]) * wide(contact.m_face->m_n[corner]->m_x);
    const double depth = normal.dot(wide(contact.m_node->m_x) - point) / semantics_.scale;
    out.vertex_contacts.push_back({where, std::max(depth, 0.0), normal.normalized()});
  }

  double margin_;        // of one body, metres
  double scale_option_;  // 0: from the scene
  Semantics semantics_;
  SoftBodyWorld world_;
  std::vector<std::unique_ptr<SoftBody>> bodies_;
};

}  // namespace

std::unique_ptr<Detector> make_bullet_vf(double margin, double scale) {
  return std::make_unique<VertexFaceDetector>(margin, scale);
}

}  // namespace contactcheck
