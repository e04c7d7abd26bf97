// Seen in Bullet 3.24 (Debian 12, single precision), November 2026:
// - Nodes and faces enter their trees one by one, by a descent to the nearer child: vertices in the
//   order of a grid make trees 500 to 900 deep (100,000 vertices), and points that coincide or lie
//   in order on a line make lists, through which Bullet then recurses. Hence the made-up places.
// - initializeFaceTree(), which predictMotion() calls, is O(n^2) and never returns for a mesh of
//   several components; btSoftBodyHelpers::CreateFromTriMesh allocates vertices^2 bools.
// - appendFace() silently leaves out triangles that repeat an index: faces are not triangles.
// - A margin is 0.25 world units until it is set.
// - A contact's radius grows by twice the distance of a node from where it was (m_q).
// - ProjectOrigin() sees no triangle with |cross product|^2 <= SIMD_EPSILON, in world units; it
//   says so of a slightly different float than ours: it subtracts the node from the corners first.
// - What two threads would share: a random seed in BulletSoftBody/btSoftBody.h (for repulsion
//   forces, which are not used) and a counter in btSoftBodyInternals.h (of cluster pairs skipped
//   within one body, which are not asked for). Projections, trees and btGjkEpaSolver2 keep their
//   state on the stack.
#include "reference/adapters/bullet_soft_body.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/types/check.h"
#include "core/types/semantics.h"

namespace contactcheck {
namespace {

/// Groups of so many leaves are merged pair by pair, in time of order n^3; above, boxes are halved.
/// Bullet's default is 128: three times the set-up for queries that take as long; with 16, queries
/// of 40,000 to 100,000 vertices took 1.3 to 2 times as long.
constexpr int kLeavesToMergeBottomUp = 64;

/// Places on a line at which leaf after leaf falls into the widest gap: a tree that takes its
/// leaves in at these is balanced, whatever the leaves will stand for.
float made_up_place(std::uint32_t index) {
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= (index >> bit & 1u) << (31 - bit);
  return static_cast<float>(reversed) * 0x1p-8f;
}

[[noreturn]] void refuse(double coordinate, double scale) {
  std::ostringstream out;
  out << "Bullet's soft bodies refuse the coordinate " << coordinate
      << ": not finite in single precision at scale " << scale;
  throw RefusedInput(out.str());
}

btVector3 fed_point(const Vec3& x, double scale) {
  float fed[3];
  for (int axis = 0; axis < 3; ++axis) {
    fed[axis] = fed_value(x[axis], scale);
    if (!std::isfinite(fed[axis])) refuse(x[axis], scale);
  }
  return {fed[0], fed[1], fed[2]};
}

bool invisible(const btSoftBody::Face& face) {
  const btVector3 &a = face.m_n[0]->m_x, &b = face.m_n[1]->m_x, &c = face.m_n[2]->m_x;
  if (btCross(b - a, c - a).length2() > SIMD_EPSILON) return false;
  return (wide(b) - wide(a)).cross(wide(c) - wide(a)).squaredNorm() > 0.0;
}

}  // namespace

SoftBody::SoftBody(SoftBodyWorld& world, const TriangleMesh& rest, const SoftBodySettings& settings)
    : scale_(settings.scale),
      body_(std::make_unique<btSoftBody>(&world.info, 0, nullptr, nullptr)) {
  body_->getCollisionShape()->setMargin(settings.margin);
  body_->m_cfg.collisions = settings.collisions;
  body_->m_sst.radmrg = settings.margin;  // by which the leaves of the trees are grown
  append_nodes(rest.vertices.size());
  feed(rest.vertices);
  append_faces(rest.triangles);
}

// Reserved first: Bullet's trees and faces point at the nodes.
void SoftBody::append_nodes(std::size_t count) {
  body_->m_nodes.reserve(static_cast<int>(count));
  for (std::uint32_t v = 0; v < count; ++v)
    body_->appendNode(btVector3(made_up_place(v), 0.0f, 0.0f), /*m=*/1.0f);
}

void SoftBody::append_faces(const std::vector<Triangle>& triangles) {
  body_->m_faces.reserve(static_cast<int>(triangles.size()));
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    if (i == j || j == k || k == i) continue;
    body_->appendFace(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
    triangle_of_face_.push_back(t);
  }
}

void SoftBody::feed(std::span<const Vec3> vertices) {
  CONTACTCHECK_INVARIANT(static_cast<int>(vertices.size()) == body_->m_nodes.size(),
                         "one position per vertex");
  for (int v = 0; v < body_->m_nodes.size(); ++v) {
    btSoftBody::Node& node = body_->m_nodes[v];
    node.m_x = node.m_q = fed_point(vertices[static_cast<std::size_t>(v)], scale_);
    node.m_v.setZero();
  }
  body_->updateBounds();
}

void SoftBody::build_trees() {
  for (int f = 0; f < body_->m_faces.size(); ++f) {
    const btVector3 place(made_up_place(static_cast<std::uint32_t>(f)), 0.0f, 0.0f);
    body_->m_faces[f].m_leaf =
        body_->m_fdbvt.insert(btDbvtVolume::FromCR(place, 0.0f), &body_->m_faces[f]);
  }
  refit_trees();
  body_->m_ndbvt.optimizeTopDown(kLeavesToMergeBottomUp);
  body_->m_fdbvt.optimizeTopDown(kLeavesToMergeBottomUp);
}

void SoftBody::refit_trees() {
  body_->updateNodeTree(/*use_velocity=*/false, /*margin=*/true);
  body_->updateFaceTree(/*use_velocity=*/false, /*margin=*/true);
}

bool SoftBody::boxes_meet(const SoftBody& other) const {
  const btVector3 *a = body_->m_bounds, *b = other.body_->m_bounds;
  for (int axis = 0; axis < 3; ++axis)
    if (a[0][axis] > b[1][axis] || b[0][axis] > a[1][axis]) return false;
  return true;
}

std::uint32_t SoftBody::vertex_of(const btSoftBody::Node& node) const {
  return static_cast<std::uint32_t>(&node - &body_->m_nodes[0]);
}

std::uint32_t SoftBody::triangle_of(const btSoftBody::Face& face) const {
  return triangle_of_face_[static_cast<std::size_t>(&face - &body_->m_faces[0])];
}

bool SoftBody::has_invisible_triangle() const {
  for (int f = 0; f < body_->m_faces.size(); ++f)
    if (invisible(body_->m_faces[f])) return true;
  return false;
}

double sum_of_margins(double margin, double scale) {
  const float one = fed_value(margin, scale);
  return static_cast<double>(one + one) / scale;
}

std::string invisible_triangles_note(double scale) {
  std::ostringstream out;
  out << "triangles below Bullet's area cut (|cross|^2 <= FLT_EPSILON in its units) are invisible "
         "to it at scale "
      << scale;
  return out.str();
}

}  // namespace contactcheck
