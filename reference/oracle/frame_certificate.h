// The certified truth of one frame: every pair of triangles of two bodies is proven to touch or to
// be disjoint; every pair of one body, to meet in more than the vertices it shares, or not to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "core/types/mesh.h"
#include "reference/oracle/pair_certificate.h"

namespace contactcheck::oracle::certify {

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
