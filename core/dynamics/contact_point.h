// Where and how two bodies (or a body and the ground) are to be separated, at material points of
// their lattices.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"

namespace contactcheck {

/// A point of a body as a blend of its nodes (lattice nodes; vertices for a body without a
/// lattice): the weights are those of the embedding, not negative, with sum 1 up to rounding.
struct NodeBlend {
  std::vector<std::uint32_t> nodes;
  std::vector<double> weights;
};

struct ContactPoint {
  std::uint32_t body_a = 0, body_b = 0;
  NodeBlend a, b;
  Vec3 normal = Vec3::Zero();  ///< unit, from a to b: moving b along it separates them
  double depth = 0.0;          ///< metres, not negative
};

/// The box of a cell that the driving detector tests.
enum class ContactVolume { kCell, kFfdAabb };

/// Turns the answers of a detector to one frame into points to respond at, in the order of the
/// canonical set: from pairs of triangles where there are any, else from pairs of cells. The
/// geometry is computed here and is the same for every detector: a detector decides where there is
/// contact, not how it is answered. Two bodies are separated in one direction
/// (agree_on_directions): the sum of the contact normals of two solids' triangles, else of the
/// vectors between centres: of the cells' boxes, or of the triangles' home cells (else bodies).
class ContactPoints {
 public:
  /// The bodies outlive this object.
  ContactPoints(const std::vector<Body>& bodies, ContactVolume volume);

  /// @pre contacts is canonical; frame has vertices for every body where there are triangle pairs
  std::vector<ContactPoint> from(const ContactSet& contacts, const Frame& frame) const;

 private:
  class Insides;

  /// Both return the direction from a to b by this pair, of any length.
  Vec3 add_triangles(const ElementPair& pair, const Frame& frame, Insides& insides,
                     std::vector<ContactPoint>& out) const;
  Vec3 add_cells(const ElementPair& pair, const Frame& frame, std::vector<ContactPoint>& out) const;

  const std::vector<Body>& bodies_;
  ContactVolume volume_;
  std::vector<std::vector<Aabb>> boxes_;  // per body and cell, local; kFfdAabb only
};

/// A vertex of the mesh as a blend: of the 8 nodes of its home cell, or of itself without a
/// lattice.
NodeBlend blend_of_vertex(const BodyShape& shape, std::uint32_t vertex);
/// A point of a kept cell, at local coordinates in [0, 1], as a blend of the cell's 8 nodes.
NodeBlend blend_of_local(const Lattice& lattice, std::uint32_t cell, const Vec3& local);

// One direction of separation for two bodies. A point of contact has the direction out of one box
// or triangle. Deep inside a body that can be any direction: through a face between two cells, or
// along the surface. So all contacts of two bodies have one common direction, and points that would
// push across it or against it push along it.

/// Per pair of bodies a vector from a to b, of any length.
using Directions = std::map<BodyPair, Vec3>;

/// Gives every point whose normal is more than 60 degrees off its bodies' common direction that
/// direction instead. Points keep their depths and places. A direction of zero is ignored.
void agree_on_directions(const Directions& common, std::vector<ContactPoint>& points);

}  // namespace contactcheck
