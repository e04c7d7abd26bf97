// The certified truth of one frame: every pair of triangles of two bodies is proven to touch or to
// be disjoint; every pair of one body, to meet in more than the vertices it shares, or not to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "core/types/mesh.h"
#include "core/types/shared_corners.h"
#include "core/types/vec3.h"
#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle::certify {

// Proofs about one pair of closed triangles that anybody can check with exact arithmetic: a common
// point, or a plane between the two. Degenerate triangles are the segment or the point that they
// are. Constructed in rational arithmetic of this layer's own, so that a wrong verdict of the
// oracle leaves nothing to write down.

/// A common point, as weights of the corners of either triangle: integers, not negative, with a
/// positive sum, in hexadecimal digits ("1f"). The point is the sum of the corners times their
/// weights over the sum of the weights.
struct Witness {
  std::array<std::string, 3> p, q;
};

/// A finite double, or, where none serves, a rational: an integer or two with '/' between them, in
/// hexadecimal digits ("-1f/20").
using ExactNumber = std::variant<double, std::string>;

/// normal * x <= offset for the corners x of p, > offset for those of q.
struct Plane {
  std::array<ExactNumber, 3> normal;
  ExactNumber offset;
};

/// Nothing when the triangles share no point. @pre all coordinates finite, of all three functions
std::optional<Witness> common_point(const oracle::TriangleCorners& p,
                                    const oracle::TriangleCorners& q);
/// Nothing when they share one; exactly one of the two functions answers.
std::optional<Plane> separating_plane(const oracle::TriangleCorners& p,
                                      const oracle::TriangleCorners& q);

/// A point of either triangle, as near to one another as the triangles are; each coordinate cut to
/// a double.
std::array<Vec3, 2> nearest_points_rounded(const oracle::TriangleCorners& p,
                                           const oracle::TriangleCorners& q);

/// Of two triangles of one mesh, the corners they share first in both: a common point off the hull
/// of these. Nothing when there is none. @pre 1 or 2 are shared, and stand at the same places
std::optional<Witness> further_point(const oracle::TriangleCorners& p,
                                     const oracle::TriangleCorners& q, std::uint32_t shared);
/// Of two triangles that share one corner, the first of both, and not both segments: a plane
/// through it with p on one closed side and q on the other, and all corners of one of them, but the
/// shared one, off it. Then that corner is all they share. Nothing when they share more.
std::optional<Plane> plane_through_corner(const oracle::TriangleCorners& p,
                                          const oracle::TriangleCorners& q);
/// Of two that share an edge, or that are both segments: do they share its hull alone? A matter of
/// few products, which a checker does itself.
bool share_hull_alone(const oracle::TriangleCorners& p, const oracle::TriangleCorners& q,
                      std::uint32_t shared);

// Boxes over ranges of one body's triangles: what the proof that no pair was forgotten speaks of.
//
// The triangles stand in a fixed order; a range of two or more splits in its middle. So a range is
// known by its ends alone, and a checker needs the order and no tree.

/// The places first .. last of the order, not empty, with the node that holds its box.
struct Range {
  std::size_t node = 0, first = 0, last = 0;

  std::size_t size() const { return last - first; }
  std::size_t middle() const { return first + size() / 2; }
  /// @pre size() > 1, of both. Nodes are numbered in preorder: n triangles below make 2n - 1.
  Range lower_half() const { return {node + 1, first, middle()}; }
  Range upper_half() const { return {node + 2 * (middle() - first), middle(), last}; }
};

class RangeTree {
 public:
  /// An order in which near triangles stand near one another. @pre at least one triangle
  explicit RangeTree(const TriangleMesh& rest);

  /// Boxes for new positions of the vertices.
  void refit(std::span<const Vec3> vertices);

  Range all() const { return {0, 0, order_.size()}; }
  const Aabb& box(const Range& range) const { return boxes_[range.node]; }
  /// Place -> triangle.
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  const Aabb& refit(const Range& range, std::span<const Vec3> vertices);

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Aabb> boxes_;  // per node
};

struct CertifiedContact {
  ElementPair triangles;
  Witness witness;
};

struct CertifiedGap {
  ElementPair triangles;
  Plane plane;  ///< p is triangle a, q is triangle b
};

struct FrameCertificate {
  /// How the pairs of triangles were covered: for all pairs of bodies (0,1), (0,2), ... (1,2), ...
  /// in turn, a recursion over two ranges of triangles that starts with all of one body and all of
  /// the other. A letter each: 'a' or 'b' splits the first or second range (the lower half is
  /// treated first, with all below it), 'x', 'y' or 'z' says that the boxes of the two ranges are
  /// disjoint along that axis, and for one triangle on either side 't' that they touch and 's' that
  /// a plane separates them.
  ///
  /// Where contacts of bodies with themselves are certified, too, every body follows with itself:
  /// all of it is the pairs within its lower half, those within its upper half and those between
  /// the two, without a letter; one triangle alone has none. Of two triangles that share vertices
  /// 't' says that they share more, 's' that a plane through the one shared corner separates them,
  /// 'e' that they share an edge, or are segments, and no more than that (share_hull_alone), 'd'
  /// that they name the same vertices.
  std::string decisions;
  /// One for every 't', canonical; of one body with body_a = body_b, a < b.
  std::vector<CertifiedContact> contacts;
  std::vector<CertifiedGap> gaps;  ///< one for every 's', likewise
};

class Certifier {
 public:
  /// @pre every body has triangles
  explicit Certifier(const std::vector<Body>& bodies);

  /// Proofs of what the oracle has found: `touching` are all pairs of triangles that share a point,
  /// and, if `own` is given, those are all of one body that meet in more than they share.
  /// @pre frame has vertices for every body, all finite; `touching` is canonical
  /// @throws std::runtime_error naming the pair where a verdict is wrong, so that no proof exists
  FrameCertificate certify(const Frame& frame, const std::vector<ElementPair>& touching,
                           const std::vector<SelfPair>* own = nullptr);

  /// Place -> triangle, per body: the order that `decisions` refers to.
  const std::vector<std::uint32_t>& order(std::size_t body) const { return trees_[body].order(); }

 private:
  std::vector<Body> bodies_;
  std::vector<RangeTree> trees_;
};

}  // namespace contactcheck::oracle::certify
