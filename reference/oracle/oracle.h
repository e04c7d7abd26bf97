// The exact oracle: computes the ground truth for the deformed doubles of a frame.
//
// It uses core's types and rest-shape data, and none of core's broad or narrow phase: its own tree
// finds the candidates, CGAL's EPICK kernel decides, and degenerate triangles have a separate path.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "reference/oracle/closed_chain.h"

namespace contactcheck::oracle {

/// The most pairs of triangles in contact that are listed for a frame, between bodies and within
/// bodies (each): some seconds and 1 GB. 6,325 triangles at one place have that many.
inline constexpr std::size_t kMostContacts = 20'000'000;

/// "more than 20000000 pairs of triangles are in contact; at most that many can be judged"
[[noreturn]] void refuse_many_contacts(std::size_t most);

/// The kinds of truth to compute; others are not computed.
struct WantedTruth {
  bool triangles = true;  ///< triangle pairs and, from them, body pairs by surface
  bool containment = false;
  bool vertices = false;
  bool boxes = false;  ///< overlapping hulls of mapped FFD-AABB boxes
  bool self = false;   ///< contacts of bodies with themselves
  std::size_t most_contacts = kMostContacts;
};

/// A body that is open, so that it encloses nothing, in one frame.
struct OpenBody {
  std::uint32_t body = 0;
  OpenEdge edge;
  bool operator==(const OpenBody&) const = default;
};

/// Pairs of bodies whose surfaces share no point, and a component of one lies inside the other.
struct Containment {
  std::vector<BodyPair> pairs;  ///< canonical; an open body contains nothing
  std::vector<OpenBody> open;   ///< in the order of the bodies
};

struct Truth {
  /// bodies: pairs whose surfaces share a point. triangles: pairs that share a point. vertices:
  /// strictly inside another solid and used by a triangle. self: pairs of triangles of one body
  /// that meet in more than their common vertices, without duplicates (the same vertices).
  /// Canonical. `cells` stays empty: cell truth is triangle truth seen through the cell labels.
  ContactSet surface;
  std::vector<BodyPair> containment;  ///< see Containment
  std::vector<OpenBody> open;         ///< set if containment or vertices are wanted
  std::vector<ElementPair> boxes;     ///< pairs of kept cells whose mapped FFD-AABB hulls overlap
};

/// Certified: lower <= true distance <= upper, and upper - lower <= 1e-9 * scale of the
/// coordinates; both are exactly 0 if the surfaces share a point, and only then.
struct DistanceInterval {
  double lower = 0.0, upper = 0.0;
  /// Set by distance(): one triangle of each surface; their distance lies in the interval.
  std::array<std::uint32_t, 2> triangles{};
};

class Oracle {
 public:
  explicit Oracle(const std::vector<Body>& bodies);
  ~Oracle();
  Oracle(const Oracle&) = delete;
  Oracle& operator=(const Oracle&) = delete;

  /// @pre frame has vertices for every body, all finite
  /// @throws RefusedInput for self-contact of a mesh as refuse_many_adjacent_pairs() does, and for
  /// more than `wanted.most_contacts` pairs of triangles between bodies, or within bodies
  Truth judge(const Frame& frame, const WantedTruth& wanted);
  /// The containment in `frame`. `touching`: the pairs whose surfaces share a point, canonical.
  Containment containment(const Frame& frame, const std::vector<BodyPair>& touching);
  /// The distance between two surfaces (triangle against triangle) at the vertices of `frame`.
  DistanceInterval distance(const Frame& frame, BodyPair pair);
  /// The smallest distance between the surfaces of any two bodies: the contract of distance(), with
  /// the scale of all bodies. @pre at least two bodies
  DistanceInterval separation(const Frame& frame);
  /// All pairs of a vertex and a triangle of another body nearer than `margin` (strictly): exact,
  /// canonical. A degenerate triangle is treated as a segment or a point. None for a margin of 0.
  std::vector<NearPair> near(const Frame& frame, double margin);
  /// The same within each body, without triangles that use the vertex or one welded to it
  /// (BodyShape::uses).
  std::vector<NearPair> self_near(const Frame& frame, double margin);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactcheck::oracle
