// The certified truth of one frame: every pair of triangles of two bodies is proven to touch or to
// be apart.
#pragma once

#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "reference/certify/certificate.h"
#include "reference/certify/range_tree.h"

namespace contactcheck::certify {

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
  /// apart along that axis, and for one triangle on either side 't' that they touch and 's' that a
  /// plane separates them.
  std::string decisions;
  std::vector<CertifiedContact> contacts;  ///< one for every 't', canonical
  std::vector<CertifiedGap> gaps;          ///< one for every 's', canonical
};

class Certifier {
 public:
  /// @pre every body has triangles
  explicit Certifier(const std::vector<Body>& bodies);

  /// Proofs of what the oracle has found: `touching` are all pairs of triangles that share a point.
  /// @pre frame has vertices for every body, all finite; `touching` is canonical
  /// @throws std::runtime_error naming the pair where a verdict is wrong, so that no proof exists
  FrameCertificate certify(const Frame& frame, const std::vector<ElementPair>& touching);

  /// Place -> triangle, per body: the order that `decisions` refers to.
  const std::vector<std::uint32_t>& order(std::size_t body) const { return trees_[body].order(); }

 private:
  std::vector<Body> bodies_;
  std::vector<RangeTree> trees_;
};

}  // namespace contactcheck::certify
