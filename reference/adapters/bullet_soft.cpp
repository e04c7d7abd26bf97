// Bullet's soft bodies as detectors. Both are queried on the given vertices and never stepped, in
// single precision, in a world of their own scale.
//
//   bullet-vf  Vertex-face contacts (VF_SS): an unsigned proximity query. Every vertex of one body
//              that is nearer than the sum of the two margins to a triangle of the other, strictly,
//              both ways. It says nothing about inside and outside, and does not see edges that
//              cross far from any vertex. Judged at `near` and `body`; its figures at `vertex` are
//              informative. A body with itself is compared by the path of deformable bodies
//              (VF_DD), another test: judged at `self-near`.
//   bullet-cl  Cluster contacts (CL_SS): each body is divided at rest into clusters of vertices.
//              Two bodies are in contact when the convex hulls of two of their clusters are nearer
//              than the sum of the margins (strictly) or overlap, by GJK and EPA. Hulls of concave
//              or curved pieces hold space that the surface does not: contact is reported across a
//              gap, and for a thin shell within another. Judged at `body`. A body's own clusters
//              are compared where they share no vertex: judged at `self-body`.
//
// Seen in Bullet 3.24 (Debian 12, single precision), November 2026, in all soft bodies:
// - Nodes and faces enter their trees one by one, by a descent to the nearer child: vertices in the
//   order of a grid make trees 500 to 900 deep (100,000 vertices), and points that coincide or lie
//   in order on a line make lists, through which Bullet then recurses. Hence balanced_place().
// - initializeFaceTree(), which predictMotion() calls, is O(n^2) and never returns for a mesh of
//   several components; btSoftBodyHelpers::CreateFromTriMesh allocates vertices^2 bools.
// - appendFace() silently leaves out triangles that repeat an index: faces are not triangles.
// - A margin is 0.25 world units until it is set.
// - A contact's radius grows by twice the distance of a node from where it was (m_q).
// - ProjectOrigin() sees no triangle with |cross product|^2 <= SIMD_EPSILON, in world units; it
//   says so of a slightly different float than ours: it subtracts the node from the corners first.
// - What two threads would share: a random seed in BulletSoftBody/btSoftBody.h (for repulsion
//   forces, which are not used) and a counter in btSoftBodyInternals.h (of cluster pairs skipped
//   within one body, which nothing reads). Projections, trees and btGjkEpaSolver2 keep their state
//   on the stack.
// with VF_SS:
// - A contact needs (distance)^2 < (sum of the margins)^2, in floats: a margin of 0 finds nothing.
// - Contacts are added to m_scontacts of the body whose node it is, nodes of both bodies against
//   faces of the other, and are cleared only by predictMotion().
// - A vertex exactly on a triangle has the normal 0 / 0.
// - The normal points from the face to the node, on whichever side it is: the solver pushes a
//   vertex that is inside further in.
// with VF_DD, of a body with itself:
// - A pair of faces is left out when they share a node, and with it every vertex of the one against
//   the other: a vertex is compared with a face if any face of it shares no node with that face.
// - Near is: the distance from the face's plane is at most the margins, and the barycentric
//   coordinates of the projection exceed the triangle by at most margins / sqrt(area). That is no
//   distance: too far for the corners of some triangles, and too near for those of others.
// - Of a part of the tree nothing is compared with itself unless its cone of normals is wider than
//   pi, and cones are halved as they are joined: folds are left out. There is no test of contours.
// - Faces whose 4 area^2 is below SIMD_EPSILON in world units are invisible here, too.
// - The tree with cones is made by initializeFaceTree() alone, which is O(n^2): it is copied here.
// with CL_SS:
// - The hulls themselves have no margin; a joint is made when their signed distance is less than
//   the sum of the bodies' margins, whose default is 0.25 world units each.
// - GJK and EPA stop at 1e-4 world units, so that the scale counts here too; an EPA that fails is
//   no contact, without an error.
// - Joints go to the first body, and stay until cleanupClusters(): they are freed here.
// - generateClusters() numbers nodes by i * 29873 in an int: from 71,889 nodes on that overflows,
//   and the negative remainder indexes in front of an array (segmentation fault).
// - Of k clusters fewer remain: all centres start near the body's own, and those that get no node
//   are dropped. A sphere of 45,000 vertices has 18 of 64.
// - It compares every node with every other for a table of connected clusters that only collisions
//   within a body read: seconds for 45,000 nodes.
// - CL_SELF is without effect, and ends collisions with others too: defaultCollisionHandler() looks
//   for CL_SS alone among the flags of SVSmask, which has held CL_SELF since it was widened for
//   VF_DD. So the collider that it would call is called here.
// There is no early-out in either.
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyInternals.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/detect/option_info.h"
#include "core/types/check.h"
#include "core/types/semantics.h"
#include "reference/adapters/adapters.h"
#include "reference/adapters/body_pair_detector.h"
#include "reference/adapters/bullet.h"

namespace contactcheck::adapters {
namespace {

// --- One body ---

Vec3 wide(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// Places on a line at which leaf after leaf falls into the widest gap: a tree that takes its
/// leaves in at these is balanced, whatever the leaves will stand for.
float balanced_place(std::uint32_t index) {
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

/// A soft body that is fed with vertices and never stepped: a node of mass 1 per vertex, a face per
/// triangle that does not repeat an index; no links.
class SoftBody {
 public:
  /// Takes time of order n log n and memory of order n, connected or not, however vertices
  /// coincide. `scale`: world units per metre. `margin`: of this body, world units. `collisions`:
  /// VF_SS or CL_SS.
  /// @pre world outlives it
  /// @throws RefusedInput as feed() does
  SoftBody(btSoftBodyWorldInfo& world, const TriangleMesh& rest, double scale, float margin,
           int collisions)
      : scale_(scale), body_(std::make_unique<btSoftBody>(&world, 0, nullptr, nullptr)) {
    body_->getCollisionShape()->setMargin(margin);
    body_->m_cfg.collisions = collisions;
    body_->m_sst.radmrg = margin;  // by which the leaves of the trees are grown
    // Reserved first: Bullet's trees and faces point at the nodes.
    body_->m_nodes.reserve(static_cast<int>(rest.vertices.size()));
    for (std::uint32_t v = 0; v < rest.vertices.size(); ++v)
      body_->appendNode(btVector3(balanced_place(v), 0.0f, 0.0f), /*m=*/1.0f);
    feed(rest.vertices);
    body_->m_faces.reserve(static_cast<int>(rest.triangles.size()));
    for (std::uint32_t t = 0; t < rest.triangles.size(); ++t) {
      const auto [i, j, k] = rest.triangles[t];
      if (i == j || j == k || k == i) continue;
      body_->appendFace(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
      triangle_of_face_.push_back(t);
    }
  }

  /// Moves every node to float(scale * x), without velocity or memory of where it was.
  /// @throws RefusedInput when a coordinate is not finite as a float
  void feed(std::span<const Vec3> vertices) {
    CONTACTCHECK_INVARIANT(static_cast<int>(vertices.size()) == body_->m_nodes.size(),
                           "one position per vertex");
    for (int v = 0; v < body_->m_nodes.size(); ++v) {
      btSoftBody::Node& node = body_->m_nodes[v];
      node.m_x = node.m_q = fed_point(vertices[static_cast<std::size_t>(v)], scale_);
      node.m_v.setZero();
    }
    body_->updateBounds();
  }

  /// For VF_SS: trees of nodes and of faces around the positions last fed.
  void build_trees() {
    for (int f = 0; f < body_->m_faces.size(); ++f) {
      const btVector3 place(balanced_place(static_cast<std::uint32_t>(f)), 0.0f, 0.0f);
      body_->m_faces[f].m_leaf =
          body_->m_fdbvt.insert(btDbvtVolume::FromCR(place, 0.0f), &body_->m_faces[f]);
    }
    refit_trees();
    body_->m_ndbvt.optimizeTopDown(kLeavesToMergeBottomUp);
    body_->m_fdbvt.optimizeTopDown(kLeavesToMergeBottomUp);
  }

  /// What collide_self() needs beside, refitted with the trees from then on.
  void build_own_tree() {
    if (body_->m_fdbvnt != nullptr) return;
    body_->m_fdbvnt = copied(body_->m_fdbvt.m_root);
    body_->updateNormals();
  }

  /// The same trees around new positions.
  void refit_trees() {
    body_->updateNodeTree(/*use_velocity=*/false, /*margin=*/true);
    body_->updateFaceTree(/*use_velocity=*/false, /*margin=*/true);
    if (body_->m_fdbvnt != nullptr) body_->updateNormals();
  }

  /// By VF_DD, into m_faceNodeContacts. @pre build_trees()
  void collide_self() {
    build_own_tree();
    const int collisions = std::exchange(body_->m_cfg.collisions, btSoftBody::fCollision::VF_DD);
    body_->setSelfCollision(true);
    body_->m_softSoftCollision = true;
    body_->m_faceNodeContacts.resize(0);
    body_->defaultCollisionHandler(body_.get());
    body_->m_cfg.collisions = collisions;
  }

  btSoftBody& bullet() { return *body_; }

  /// Closed; of the boxes grown by the margins, as Bullet's broad phase compares them.
  bool boxes_meet(const SoftBody& other) const {
    const btVector3 *a = body_->m_bounds, *b = other.body_->m_bounds;
    for (int axis = 0; axis < 3; ++axis)
      if (a[0][axis] > b[1][axis] || b[0][axis] > a[1][axis]) return false;
    return true;
  }

  /// Indices of the input mesh.
  std::uint32_t vertex_of(const btSoftBody::Node& node) const {
    return static_cast<std::uint32_t>(&node - &body_->m_nodes[0]);
  }
  std::uint32_t triangle_of(const btSoftBody::Face& face) const {
    return triangle_of_face_[static_cast<std::size_t>(&face - &body_->m_faces[0])];
  }

  /// True when Bullet takes a triangle with area for degenerate at its last positions.
  bool has_invisible_triangle() const {
    for (int f = 0; f < body_->m_faces.size(); ++f) {
      const auto& corners = body_->m_faces[f].m_n;
      const btVector3 &a = corners[0]->m_x, &b = corners[1]->m_x, &c = corners[2]->m_x;
      if (btCross(b - a, c - a).length2() <= SIMD_EPSILON &&
          (wide(b) - wide(a)).cross(wide(c) - wide(a)).squaredNorm() > 0.0)
        return true;
    }
    return false;
  }

 private:
  /// Groups of at most this many leaves are merged pair by pair, in O(n^3); above, boxes are
  /// halved. Bullet's default is 128: three times the set-up for queries that take as long; with
  /// 16, queries of 40,000 to 100,000 vertices took 1.3 to 2 times as long.
  static constexpr int kLeavesToMergeBottomUp = 64;

  // btSoftBody frees it.
  static btDbvntNode* copied(const btDbvtNode* node) {
    if (node == nullptr) return nullptr;
    auto* copy = new btDbvntNode(node);
    if (node->isinternal())
      for (const int child : {0, 1}) copy->childs[child] = copied(node->childs[child]);
    return copy;
  }

  double scale_;
  std::unique_ptr<btSoftBody> body_;
  std::vector<std::uint32_t> triangle_of_face_;
};

// --- What both detectors share ---

/// The world, its scale and margins, one soft body per body, and the pairs of bodies whose boxes
/// meet.
class BulletSoftDetector : public BodyPairDetector {
 public:
  const Semantics& semantics() const override { return semantics_; }

  void prepare(const std::vector<Body>& bodies) override {
    set_bodies(bodies, margin_, kRoundingOfFedBoxes);
    set_scale(scale_option_ > 0.0 ? scale_option_ : automatic_bullet_scale(bodies));
    bodies_.clear();
    for (const Body& body : bodies) {
      bodies_.push_back(std::make_unique<SoftBody>(world_, body.shape->mesh, scale(),
                                                   fed_value(margin_, scale()), collisions_));
      prepare_body(*bodies_.back());
    }
  }

 protected:
  /// `semantics` without scale and margin. `collisions`: VF_SS or CL_SS. `margin`: of one body,
  /// metres. `scale`: world units per metre; 0: from the scene.
  BulletSoftDetector(Semantics semantics, int collisions, double margin, double scale,
                     Prefilter prefilter)
      : BodyPairDetector(prefilter),
        collisions_(collisions),
        margin_(margin),
        scale_option_(scale),
        semantics_(std::move(semantics)) {
    world_.m_sparsesdf.Initialize();
    set_scale(scale > 0.0 ? scale : 1.0);
  }

  /// Once per body, at rest.
  virtual void prepare_body(SoftBody& body) = 0;
  /// The body has been fed new vertices.
  virtual void refit(SoftBody& body) = 0;
  /// Two bodies, a < b, whose boxes meet.
  virtual void collide_bodies(std::uint32_t a, std::uint32_t b, Question question,
                              ContactSet& out) = 0;

  double scale() const { return semantics_.scale; }
  const std::vector<std::unique_ptr<SoftBody>>& bodies() const { return bodies_; }

 private:
  void check(const Aabb& box) const override {
    for (const Vec3* corner : {&box.lo, &box.hi}) fed_point(*corner, scale());
  }

  void move(std::span<const CandidateBody> bodies) override {
    for (const CandidateBody& body : bodies) {
      bodies_[body.body]->feed(body.vertices);
      refit(*bodies_[body.body]);
    }
  }

  void collide(BodyPair pair, Question question, ContactSet& out) override {
    if (bodies_[pair.a]->boxes_meet(*bodies_[pair.b]))
      collide_bodies(pair.a, pair.b, question, out);
  }

  void set_scale(double scale) {
    semantics_.scale = scale;
    // As Bullet adds the margins of two bodies; the sum of two equal floats is exact.
    const float one = fed_value(margin_, scale);
    semantics_.margin = static_cast<double>(one + one) / scale;
  }

  int collisions_;
  double margin_;        // of one body, metres
  double scale_option_;  // 0: from the scene
  Semantics semantics_;
  // There is neither a dispatcher nor a broad phase in it, and no field of it has a part in an
  // answer. One per detector, so that detectors share nothing.
  btSoftBodyWorldInfo world_;
  std::vector<std::unique_ptr<SoftBody>> bodies_;
};

// --- bullet-vf ---

Semantics vf_semantics() {
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kNear, Level::kSelfNear};
  semantics.informative = {Level::kVertex};
  semantics.questions = {Question::kContacts, Question::kBody, Question::kSelf};
  semantics.closed = false;
  semantics.precision = Precision::kSingle;
  semantics.depth = DepthKind::kVertexSurface;
  semantics.no_early_end = true;
  semantics.means =
      "a vertex of one body is nearer to a triangle of the other than the sum of their margins, on "
      "either side";
  return semantics;
}

class VertexFaceDetector final : public BulletSoftDetector {
 public:
  VertexFaceDetector(double margin, double scale, Prefilter prefilter)
      : BulletSoftDetector(vf_semantics(), btSoftBody::fCollision::VF_SS, margin, scale,
                           prefilter) {}

  // No trace(): a stage "visible" would have to list every pair of visible triangles.

  std::vector<std::string> notes() override {
    for (const CandidateBody& body : candidates())
      if (bodies()[body.body]->has_invisible_triangle()) {
        std::ostringstream out;
        out << "triangles below Bullet's area cut (|cross|^2 <= FLT_EPSILON in its units) are "
               "invisible to it at scale "
            << scale();
        return {out.str()};
      }
    return {};
  }

 private:
  void prepare_body(SoftBody& body) override {
    body.build_trees();
    if (expects_self()) body.build_own_tree();
  }
  void refit(SoftBody& body) override { body.refit_trees(); }
  void collide_bodies(std::uint32_t a, std::uint32_t b, Question question,
                      ContactSet& out) override {
    btSoftBody &first = bodies()[a]->bullet(), &second = bodies()[b]->bullet();
    first.m_scontacts.resize(0);
    second.m_scontacts.resize(0);
    first.defaultCollisionHandler(&second);
    if (question != Question::kBody) {
      append_contacts(a, b, out);
      append_contacts(b, a, out);
    } else if (first.m_scontacts.size() + second.m_scontacts.size() > 0) {
      out.bodies.push_back({a, b});
    }
  }

  void collide_self(std::uint32_t body, ContactSet& out) override {
    SoftBody& soft = *bodies()[body];
    soft.collide_self();
    const auto& contacts = soft.bullet().m_faceNodeContacts;
    for (int i = 0; i < contacts.size(); ++i) {
      const NearPair pair{body, body, soft.vertex_of(*contacts[i].m_node),
                          soft.triangle_of(*contacts[i].m_face)};
      // Bullet knows nothing of welds.
      if (!shape(body).uses(pair.triangle, pair.vertex)) out.self_near.push_back(pair);
    }
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

// --- bullet-cl ---

/// The most nodes that generateClusters() can divide: beyond these it overflows an int and crashes.
constexpr int kMostNodesForBullet = 71888;

// Centres hardly move after this many; each costs k times the number of nodes.
constexpr int kMostIterations = 64;

// Enough nodes for centres of any k that is allowed; comparing all with all takes well under 1 s.
constexpr int kSampleNodes = 20000;

using Members = std::vector<std::vector<std::uint32_t>>;  // nodes of each cluster

/// The centres of the clusters of a sample of the nodes.
std::vector<btVector3> centres_of_sample(const btSoftBody& body, int k) {
  const int count = body.m_nodes.size();
  const int stride = (count + kSampleNodes - 1) / kSampleNodes;
  std::vector<btVector3> places;
  for (int v = 0; v < count; v += stride) places.push_back(body.m_nodes[v].m_x);
  const auto sample = std::make_unique<btSoftBody>(
      body.m_worldInfo, static_cast<int>(places.size()), places.data(), nullptr);
  sample->generateClusters(k, kMostIterations);
  std::vector<btVector3> centres;
  for (int c = 0; c < sample->m_clusters.size(); ++c)
    if (sample->m_clusters[c]->m_collide) centres.push_back(sample->clusterCom(c));
  return centres;
}

/// Each node goes to its nearest centre; each cluster takes the direct neighbours of its nodes too,
/// as generateClusters() does.
Members divide(const btSoftBody& body, const std::vector<btVector3>& centres) {
  Members members(centres.size());
  std::vector<std::uint32_t> cluster_of(static_cast<std::size_t>(body.m_nodes.size()));
  for (std::uint32_t v = 0; v < cluster_of.size(); ++v) {
    const btVector3& x = body.m_nodes[static_cast<int>(v)].m_x;
    std::uint32_t nearest = 0;
    for (std::uint32_t c = 1; c < centres.size(); ++c)
      if (centres[c].distance2(x) < centres[nearest].distance2(x)) nearest = c;
    cluster_of[v] = nearest;
    members[cluster_of[v]].push_back(v);
  }
  for (int f = 0; f < body.m_faces.size(); ++f) {
    for (const btSoftBody::Node* corner : body.m_faces[f].m_n) {
      const std::uint32_t cluster = cluster_of[static_cast<std::size_t>(corner - &body.m_nodes[0])];
      for (const btSoftBody::Node* node : body.m_faces[f].m_n)
        members[cluster].push_back(static_cast<std::uint32_t>(node - &body.m_nodes[0]));
    }
  }
  return members;
}

void append_cluster(btSoftBody& body, std::vector<std::uint32_t>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  auto* cluster = new (btAlignedAlloc(sizeof(btSoftBody::Cluster), 16)) btSoftBody::Cluster();
  cluster->m_collide = true;
  cluster->m_clusterIndex = body.m_clusters.size();
  for (const std::uint32_t v : members)
    cluster->m_nodes.push_back(&body.m_nodes[static_cast<int>(v)]);
  body.m_clusters.push_back(cluster);
}

/// As generateClusters() does: clusters that share a node are never compared.
void connect_clusters(btSoftBody& body) {
  const int count = body.m_clusters.size();
  body.m_clusterConnectivity.resize(count * count, false);
  std::vector<std::vector<int>> of_node(static_cast<std::size_t>(body.m_nodes.size()));
  for (int c = 0; c < count; ++c)
    for (int n = 0; n < body.m_clusters[c]->m_nodes.size(); ++n)
      of_node[static_cast<std::size_t>(body.m_clusters[c]->m_nodes[n] - &body.m_nodes[0])]
          .push_back(c);
  for (const std::vector<int>& clusters : of_node)
    for (const int c : clusters)
      for (const int d : clusters) body.m_clusterConnectivity[c + count * d] = true;
}

/// Divides the nodes, at their places now, into at most k clusters. A body with more nodes than
/// generateClusters() can divide takes the centres of the clusters of a sample. @pre k >= 1
void make_clusters(btSoftBody& body, int k) {
  if (body.m_nodes.size() == 0) return;
  if (body.m_nodes.size() <= kMostNodesForBullet) {
    body.generateClusters(k, kMostIterations);
    return;
  }
  Members members = divide(body, centres_of_sample(body, k));
  for (std::vector<std::uint32_t>& nodes : members)
    if (!nodes.empty()) append_cluster(body, nodes);
  body.initializeClusters();
  body.updateClusters();
  connect_clusters(body);
}

/// Bullet's frames and boxes of the clusters around the nodes' places now. The boxes are grown by
/// the margin, in every frame anew: left to itself Bullet does that only to boxes that have moved
/// out of their old ones, and what it finds within the margins depends on the frames before.
void refit_clusters(btSoftBody& body) {
  body.m_cdbvt.clear();
  for (int c = 0; c < body.m_clusters.size(); ++c) body.m_clusters[c]->m_leaf = nullptr;
  body.updateClusters();  // inserts boxes without margins
  const btScalar margin = body.m_sst.radmrg;
  for (int c = 0; c < body.m_clusters.size(); ++c) {
    btDbvtNode* leaf = body.m_clusters[c]->m_leaf;
    if (leaf == nullptr) continue;  // the cluster of all nodes collides with nothing
    btDbvtVolume grown = leaf->volume;
    grown.Expand(btVector3(margin, margin, margin));
    body.m_cdbvt.update(leaf, grown);
  }
}

Semantics cl_semantics() {
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kSelfBody};
  semantics.questions = {Question::kBody, Question::kSelf};
  semantics.closed = false;
  semantics.precision = Precision::kSingle;
  semantics.no_early_end = true;
  semantics.means =
      "the convex hulls of two clusters of vertices (k-means at rest) overlap or are nearer than "
      "the sum of the margins";
  return semantics;
}

class ClusterDetector final : public BulletSoftDetector {
 public:
  ClusterDetector(int clusters, double margin, double scale, Prefilter prefilter)
      : BulletSoftDetector(cl_semantics(), btSoftBody::fCollision::CL_SS, margin, scale, prefilter),
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
  void collide_bodies(std::uint32_t a, std::uint32_t b, Question, ContactSet& out) override {
    if (make_joints(a, b)) out.bodies.push_back({a, b});
  }
  void collide_self(std::uint32_t body, ContactSet& out) override {
    if (make_joints(body, body)) out.self_bodies.push_back(body);
  }
  bool make_joints(std::uint32_t a, std::uint32_t b) {
    btSoftBody& first = bodies()[a]->bullet();
    if (a == b) {
      btSoftColliders::CollideCL_SS().ProcessSoftSoft(&first, &first);
    } else {
      first.defaultCollisionHandler(&bodies()[b]->bullet());
    }
    const bool any = first.m_joints.size() > 0;
    for (int j = 0; j < first.m_joints.size(); ++j) btAlignedFree(first.m_joints[j]);
    first.m_joints.resize(0);
    return any;
  }

  int clusters_;
};

}  // namespace

Adapter bullet_soft_adapter() {
  DetectorInfo vf;
  vf.id = "bullet-vf";
  vf.summary = "Bullet's soft bodies: vertices nearer to faces than the margins";
  vf.options = {numeric_option("margin", "0.001", 0.0, 1.0, false, "metres around each body"),
                numeric_option("scale", "0", 0.0, 1e6, false,
                               "world units per metre; 0: as the smallest triangles need"),
                prefilter_option()};
  vf.given = std::string(kSweepAndPrune) + "boxes are grown by the margins; no early end";
  vf.make = [](const Options& options) {
    return std::make_unique<VertexFaceDetector>(
        number_option(options, "margin"), number_option(options, "scale"), prefilter_of(options));
  };
  DetectorInfo cl;
  cl.id = "bullet-cl";
  cl.summary = "Bullet's soft bodies: convex hulls of clusters of vertices";
  cl.given = vf.given;
  cl.options = vf.options;
  cl.options.push_back(
      numeric_option("k", "64", 1.0, 4096.0, true, "at most so many clusters per body"));
  cl.make = [](const Options& options) {
    return std::make_unique<ClusterDetector>(
        static_cast<int>(number_option(options, "k")), number_option(options, "margin"),
        number_option(options, "scale"), prefilter_of(options));
  };
  return {"bullet", bullet_version(), {std::move(vf), std::move(cl)}};
}

}  // namespace contactcheck::adapters
