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

#include "reference/adapters/bullet_soft_detector.h"

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

class VertexFaceDetector final : public BulletSoftDetector {
 public:
  VertexFaceDetector(double margin, double scale)
      : BulletSoftDetector(vf_semantics(), btSoftBody::fCollision::VF_SS, margin, scale) {}

  // No trace(): a stage "visible" would have to list every pair of visible triangles.

  std::vector<std::string> notes() override {
    for (const auto& body : bodies())
      if (body->has_invisible_triangle()) return {invisible_triangles_note(scale())};
    return {};
  }

 private:
  void prepare_body(SoftBody& body) override { body.build_trees(); }
  void refit(SoftBody& body) override { body.refit_trees(); }
  void collide(std::uint32_t a, std::uint32_t b, Question question, ContactSet& out) override {
    const bool contact = find_contacts(bodies()[a]->bullet(), bodies()[b]->bullet());
    if (question == Question::kBody) {
      if (contact) out.bodies.push_back({a, b});
      return;
    }
    append_contacts(a, b, out);
    append_contacts(b, a, out);
  }

  static bool find_contacts(btSoftBody& a, btSoftBody& b) {
    a.m_scontacts.resize(0);
    b.m_scontacts.resize(0);
    a.defaultCollisionHandler(&b);
    return a.m_scontacts.size() + b.m_scontacts.size() > 0;
  }

  /// Vertices of `body` near faces of `other`.
  void append_contacts(std::uint32_t body, std::uint32_t other, ContactSet& out) {
    const auto& contacts = bodies()[body]->bullet().m_scontacts;
    for (int i = 0; i < contacts.size(); ++i) {
      const btSoftBody::SContact& contact = contacts[i];
      const VertexInBody where{body, other, bodies()[body]->vertex_of(*contact.m_node)};
      out.near.push_back(
          {body, other, where.vertex, bodies()[other]->triangle_of(*contact.m_face)});
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
    const double depth = normal.dot(wide(contact.m_node->m_x) - point) / scale();
    out.vertex_contacts.push_back({where, std::max(depth, 0.0), normal.normalized()});
  }
};

}  // namespace

std::unique_ptr<Detector> make_bullet_vf(double margin, double scale) {
  return std::make_unique<VertexFaceDetector>(margin, scale);
}

}  // namespace contactcheck
