// The exact oracle: the ground truth for the deformed doubles of a frame.
//
// Uses core's types and its rest-shape data, none of its broad or narrow code: its own tree finds
// the candidates, CGAL's EPICK kernel decides, with a separate path for degenerate triangles.
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

/// Pairs of triangles in contact that are listed for a frame, of two bodies and of one: some
/// seconds and 1 GB. 6,325 triangles on one another have as many.
inline constexpr std::size_t kMostContacts = 20'000'000;

/// "more than 20000000 pairs of triangles are in contact; at most that many can be judged"
[[noreturn]] void refuse_many_contacts(std::size_t most);

/// What truth is wanted; what is not wanted is not computed.
struct WantedTruth {
  bool triangles = true;  ///< triangle pairs and, from them, body pairs by surface
  bool containment = false;
  bool vertices = false;
  bool boxes = false;  ///< overlapping hulls of mapped FFD-AABB boxes
  bool self = false;   ///< contacts of bodies with themselves
  std::size_t most_contacts = kMostContacts;
};

/// A body that encloses nothing in a frame.
struct OpenBody {
  std::uint32_t body = 0;
  OpenEdge edge;
  bool operator==(const OpenBody&) const = default;
};

/// Pairs of bodies whose surfaces share no point, though a component of one lies inside the other.
struct Containment {
  std::vector<BodyPair> pairs;  ///< canonical; inside an open body lies nothing
  std::vector<OpenBody> open;   ///< in the order of the bodies
};

struct Truth {
  /// bodies: pairs whose surfaces share a point; triangles: pairs that share a point; vertices:
  /// strictly inside a solid body, of those that triangles use; self: pairs of triangles of one
  /// body that meet in more than the vertices they share, without duplicates (the same vertices).
  /// Canonical. `cells` stays empty: cell truth is triangle truth read through labels.
  ContactSet surface;
  std::vector<BodyPair> containment;  ///< as Containment says
  std::vector<OpenBody> open;         ///< told where containment or vertices are wanted
  std::vector<ElementPair> boxes;     ///< pairs of kept cells whose mapped FFD-AABB hulls overlap
};

/// Certified: lower <= true distance <= upper, and upper - lower <= 1e-9 * scale of the
/// coordinates; both 0 exactly when the surfaces share a point.
struct DistanceInterval {
  double lower = 0.0, upper = 0.0;
  /// Of distance(): one triangle of each surface, whose distance lies in the interval.
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
  /// more pairs of triangles of two bodies, or of one, than `wanted.most_contacts`
  Truth judge(const Frame& frame, const WantedTruth& wanted);
  /// The containment in `frame`, where it is known which surfaces share a point (canonical).
  Containment containment(const Frame& frame, const std::vector<BodyPair>& touching);
  /// Distance between two surfaces (triangle against triangle), of the vertices of `frame`.
  DistanceInterval distance(const Frame& frame, BodyPair pair);
  /// The smallest distance between the surfaces of any two bodies: the contract of distance(), the
  /// scale being that of all bodies. @pre at least two bodies
  DistanceInterval separation(const Frame& frame);
  /// Every vertex nearer than `margin` (strictly) to a triangle of another body: exact, canonical.
  /// A degenerate triangle is the segment or point that it is. A margin of 0 gives nothing.
  std::vector<NearPair> near(const Frame& frame, double margin);
  /// The same of every body with itself: of triangles that do not use the vertex or one welded to
  /// it (BodyShape::uses).
  std::vector<NearPair> self_near(const Frame& frame, double margin);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactcheck::oracle
