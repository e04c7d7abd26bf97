// Proofs about a step of two bodies, or of one body with itself, that anybody can check with exact
// arithmetic: that nothing of them meets while all vertices move straight from t = 0 to t = 1, or
// that something does.
//
// What is proved of two bodies: their surfaces have no common point at any t in [0, 1]. Of one
// body: no two triangles without a common vertex have one; nor has a vertex with a triangle, or an
// edge with an edge, without a common vertex. Vertices that are welded are one.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "core/types/impact.h"
#include "reference/oracle/frame_certificate.h"
#include "reference/oracle/impact_certificate.h"
#include "reference/oracle/pair_certificate.h"
#include "reference/oracle/step_truth.h"

namespace contactcheck::oracle::certify {

/// A vertex and a triangle, or two edges, of one body, by the vertices that linked() names.
struct OwnElements {
  ImpactKind kind = ImpactKind::vertex_triangle;
  std::array<std::uint32_t, 4> vertices{};  ///< vertex, corners of `triangle`; or both edges' ends
  std::uint32_t triangle = 0;               ///< of a vertex and a triangle
};

/// Those without a common vertex of which no two triangles without a common vertex have one each:
/// that such triangles are apart says nothing of them. Vertices with triangles come first, by
/// vertex and triangle; then edges by their ends, the lower first, of edges and of ends.
std::vector<OwnElements> loose_elements(const BodyShape& shape);

/// At both ends of a part of the step, direction * p > direction * q for all corners p of the first
/// triangles and q of the second; and so in between, as corners move straight.
using StepDirection = std::array<std::int64_t, 3>;

/// Two triangles are apart throughout a step: they are at its start, and none of their elements
/// meet (core/detect/step_contacts.h has the proof that this is enough).
struct ApartByElements {
  Plane at_start;
  /// Each vertex of the first with the second; each of the second with the first; side i of the
  /// first with side j of the second, by i, then j. Side i: corners i and (i + 1) % 3.
  std::vector<ImpactCertificate> elements;
};

struct ApartCertificate {
  /// How the pairs of triangles were covered: a recursion over two ranges of triangles (RangeTree)
  /// and a part of the step, which starts with all triangles of both and the whole step. Of one
  /// body: with the pairs within the lower half of all, within the upper half, and between the two.
  /// A letter each: 'a' or 'b' splits the first or second range, 'h' the part of the step in its
  /// middle (of each the lower or earlier half first, with all below it); 'x', 'y' or 'z' says that
  /// the boxes of the ranges are disjoint along the axis, in the same order, at both ends of the
  /// part; 's' that a direction separates them. Boxes at a time t are those at both ends of the
  /// step times 1 - t and t. Of one triangle on either side, 'n' says that they are of one body and
  /// share a vertex, 'f' that elements prove them apart, in the whole step.
  std::string decisions;
  std::vector<StepDirection> directions;    ///< in the order of the 's'
  std::vector<ApartByElements> triangles;   ///< in the order of the 'f'
  std::vector<ImpactCertificate> elements;  ///< of one body: of its loose_elements()
};

/// Two triangles that share a point at the start.
struct TouchAtStart {
  ElementPair triangles;
  Witness witness;
};

/// Elements of both bodies that meet: none is earlier by more than kImpactTimeWidth.
struct ElementsMeet {
  ImpactKind kind = ImpactKind::vertex_triangle;
  std::array<std::uint32_t, 2> bodies{};  ///< of the vertex and the triangle, or of the edges
  std::array<std::uint32_t, 4> vertices{};
  std::uint32_t triangle = 0;  ///< of a vertex and a triangle
  Impact time;
  ImpactCertificate proof;
};

using ContactProof = std::variant<TouchAtStart, ElementsMeet>;

/// For one step after the other.
class StepCertifier {
 public:
  /// @pre every body has triangles
  explicit StepCertifier(const std::vector<Body>& bodies);
  ~StepCertifier();
  StepCertifier(const StepCertifier&) = delete;
  StepCertifier& operator=(const StepCertifier&) = delete;

  /// The step that is spoken of from now on; it must outlive that.
  /// @pre vertices for every body at both ends, all finite
  void begin(const Step& step);

  /// A proof that nothing of the two meets, or with a == b of one body. Nothing if something does,
  /// or where no proof is found, as happens with coordinates over the whole range of doubles.
  std::optional<ApartCertificate> prove_apart(BodyPair bodies) const;

  /// A proof of one contact among those listed, which are canonical and of this step: `at_start`
  /// the pairs of triangles that share a point at the start, of one body those that also share no
  /// vertex. Nothing if there is none, or no proof is found.
  std::optional<ContactProof> prove_contact(BodyPair bodies,
                                            const std::vector<ElementPair>& at_start,
                                            const ContactSet& in_step) const;

  /// Place -> triangle, per body: the order that `decisions` refers to.
  const std::vector<std::uint32_t>& order(std::size_t body) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactcheck::oracle::certify
