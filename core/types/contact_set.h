// The answer of a detector to one frame, or to one step: sets of pairs.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck {

/// Two bodies; canonical when a < b.
struct BodyPair {
  std::uint32_t a = 0, b = 0;
  std::array<std::uint32_t, 2> ids() const { return {a, b}; }
  auto operator<=>(const BodyPair&) const = default;
};

/// An element (cell or triangle, by the set that contains it) of body_a with one of body_b;
/// canonical when body_a < body_b. Element indices are those of the input mesh and of the kept
/// cells.
struct ElementPair {
  std::uint32_t body_a = 0, body_b = 0, a = 0, b = 0;
  std::array<std::uint32_t, 4> ids() const { return {body_a, body_b, a, b}; }
  auto operator<=>(const ElementPair&) const = default;
};

/// Two triangles of one body that share no vertex, one or two, and meet in more than that (levels
/// self, self-vertex, self-edge); canonical when a < b.
struct SelfPair {
  std::uint32_t body = 0, a = 0, b = 0;
  std::array<std::uint32_t, 3> ids() const { return {body, a, b}; }
  auto operator<=>(const SelfPair&) const = default;
};

/// Makes pairs a set: orients each (lower body first), sorts, removes repeats.
void canonicalize(std::vector<ElementPair>& pairs);

/// A vertex of `body` that lies strictly inside the solid body `in`.
struct VertexInBody {
  std::uint32_t body = 0, in = 0, vertex = 0;
  std::array<std::uint32_t, 3> ids() const { return {body, in, vertex}; }
  auto operator<=>(const VertexInBody&) const = default;
};

/// A vertex of `body` nearer than a margin to a triangle of `other`, which may be `body` itself
/// (level self-near).
struct NearPair {
  std::uint32_t body = 0, other = 0, vertex = 0, triangle = 0;
  std::array<std::uint32_t, 4> ids() const { return {body, other, vertex, triangle}; }
  auto operator<=>(const NearPair&) const = default;
};

/// Two bodies whose surfaces meet within a step, and when first; canonical when bodies.a <
/// bodies.b.
struct BodyImpact {
  BodyPair bodies;
  std::optional<double> time;  ///< a fraction of the step, in [0, 1]; none: not reported
  std::array<std::uint32_t, 2> ids() const { return bodies.ids(); }
};

/// Two convex pieces in contact (triangles or mapped FFD-AABB boxes, by what the detector claims)
/// and how to separate them: depth kind `convex-pair`.
struct PieceContact {
  ElementPair pieces;
  double depth = 0.0;          ///< metres
  Vec3 normal = Vec3::Zero();  ///< unit; moving piece b by depth * normal separates them
};

/// A vertex in contact with the surface of another body and the way out: depth kind
/// `vertex-surface`.
struct VertexContact {
  VertexInBody where;
  double depth = 0.0;          ///< metres: how far the vertex has to go
  Vec3 normal = Vec3::Zero();  ///< unit; moving the vertex by depth * normal takes it out
};

/// What was reported for one frame or one step. A detector appends in any order and orientation and
/// may repeat itself; canonicalize() makes it a set.
struct ContactSet {
  std::vector<BodyPair> bodies;
  std::vector<ElementPair> cells;
  std::vector<ElementPair> triangles;
  std::vector<VertexInBody> vertices;
  std::vector<NearPair> near;
  /// This list and the next three answer the question `self`.
  std::vector<std::uint32_t> self_bodies;
  std::vector<SelfPair> self;        ///< all three classes; the mesh tells which
  std::vector<SelfPair> self_cells;  ///< cells (level self-cell)
  std::vector<NearPair> self_near;   ///< other = body
  /// This list and the next three answer the question `impacts`, about a step; edges are numbers of
  /// MeshEdges.
  std::vector<BodyImpact> impacts;
  std::vector<ElementPair> impact_triangles;
  std::vector<NearPair> impact_vertices;
  std::vector<ElementPair> impact_edges;
  /// These two answer the question `self-impacts`: other = body.
  std::vector<NearPair> self_impact_vertices;
  std::vector<SelfPair> self_impact_edges;
  /// For the question `contacts`, in addition to the sets above: several per pair or vertex are
  /// allowed.
  std::vector<PieceContact> piece_contacts;
  std::vector<VertexContact> vertex_contacts;

  /// Keeps the capacity, so a reused set does not allocate.
  void clear();
  /// Sorts all lists, and removes repeats from all but the two lists of contacts. Unordered pairs
  /// are oriented (lower body or element first), a contact's normal with them. Adds the body pairs
  /// and bodies that pairs of triangles and cells, near pairs and self pairs imply, and the impacts
  /// of bodies, without a time, that those of elements imply. Of several impacts of two bodies the
  /// earliest time is kept.
  void canonicalize();
};

/// The lists of a set. A list comes before those that imply its entries: bodies before cells.
enum class ContactList : std::size_t {
  kBodies,
  kCells,
  kTriangles,
  kVertices,
  kNear,
  kSelfBodies,
  kSelf,
  kSelfCells,
  kSelfNear,
  kImpacts,
  kImpactTriangles,
  kImpactVertices,
  kImpactEdges,
  kSelfImpactVertices,
  kSelfImpactEdges,
  kPieceContacts,
  kVertexContacts
};
inline constexpr std::size_t kContactLists = 17;
/// True for lists that answer questions about a step.
constexpr bool is_of_step(ContactList list) {
  return list >= ContactList::kImpacts && list <= ContactList::kSelfImpactEdges;
}

/// Calls visit(ContactList, list...) once per list, with that list of each of `sets`. Code that
/// treats all lists alike uses it, so a new list needs only one line here.
template <typename Visit, typename... Set>
void for_each_list(const Visit& visit, Set&... sets) {
  visit(ContactList::kBodies, sets.bodies...);
  visit(ContactList::kCells, sets.cells...);
  visit(ContactList::kTriangles, sets.triangles...);
  visit(ContactList::kVertices, sets.vertices...);
  visit(ContactList::kNear, sets.near...);
  visit(ContactList::kSelfBodies, sets.self_bodies...);
  visit(ContactList::kSelf, sets.self...);
  visit(ContactList::kSelfCells, sets.self_cells...);
  visit(ContactList::kSelfNear, sets.self_near...);
  visit(ContactList::kImpacts, sets.impacts...);
  visit(ContactList::kImpactTriangles, sets.impact_triangles...);
  visit(ContactList::kImpactVertices, sets.impact_vertices...);
  visit(ContactList::kImpactEdges, sets.impact_edges...);
  visit(ContactList::kSelfImpactVertices, sets.self_impact_vertices...);
  visit(ContactList::kSelfImpactEdges, sets.self_impact_edges...);
  visit(ContactList::kPieceContacts, sets.piece_contacts...);
  visit(ContactList::kVertexContacts, sets.vertex_contacts...);
}

/// Hash of a canonical set, chained over frames: `previous` is the value of the frame before. The
/// two lists of contacts, with their depths and normals, are not hashed, nor times of impacts.
std::uint64_t chain_hash(std::uint64_t previous, std::uint64_t frame, const ContactSet& contacts);

}  // namespace contactcheck
