// The exact part of a detector of contact within steps: candidate pairs of triangles in, contacts
// out.
//
// Two triangles that do not touch at t = 0 first meet where a vertex of one meets the other or two
// of their edges meet, degenerate triangles included: at the first time, an extreme point of their
// convex intersection is a vertex of one, lies on an edge of both, or is a strict crossing of an
// edge and a triangle's inside, which would hold shortly before as well. So pairs of triangles are
// those that touch at t = 0 and those with an elementary impact (core/narrow/impact.h).
//
// Each vertex and each edge is tested with the candidates of one of its triangles alone, its owner:
// the owner's box over the step holds the element's, so whatever meets the element is a candidate
// of the owner, and each pair of elements is tested once.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/deform/body.h"
#include "core/detect/exact_pairs.h"
#include "core/narrow/moving_triangles.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "core/types/impact.h"
#include "core/types/mesh_edges.h"

namespace contactcheck {

class StepContacts {
 public:
  /// Keeps the shapes of `bodies`, which must outlive their use.
  void prepare(const std::vector<Body>& bodies);
  /// Starts a step. @pre its vertices are finite, and outlive the calls that follow
  void begin(const Step& step);
  /// The same with the vertices at both ends, per body, of which only those of candidates are read.
  void begin(std::vector<std::span<const Vec3>> start, std::vector<std::span<const Vec3>> end);

  /// A pair of triangles of two bodies. Candidates are a superset of the pairs whose closed boxes
  /// over the step meet, each exactly once (repeats cost time and change nothing).
  void add(const ElementPair& candidate, ContactSet& out);
  /// The same within a body, neighbours included.
  void add_own(const SelfPair& candidate, ContactSet& out);
  /// Appends what is still to be tested and the pairs of bodies with their first times, and forgets
  /// them.
  void finish(ContactSet& out);

  /// Pairs of elements that were tested exactly, since begin().
  std::uint64_t tested() const { return tested_; }

 private:
  /// What depends on the mesh alone.
  struct Elements {
    std::shared_ptr<const BodyShape> shape;
    MeshEdges edges;
    /// Which corners (bit i) and sides (bit 3 + i) each triangle owns.
    std::vector<std::uint8_t> owned;
    /// The triangles at vertex v: vertex_triangles[vertex_begin[v]] up to vertex_begin[v + 1];
    /// those of edges likewise.
    std::vector<std::uint32_t> vertex_begin, vertex_triangles, edge_begin, edge_triangles;
    std::vector<std::uint32_t> linked;  ///< of each vertex: the one it is welded to, or itself
  };
  static Elements elements_of(const std::shared_ptr<const BodyShape>& shape);

  MovingTriangle moving(std::uint32_t body, std::uint32_t triangle) const;
  void enter(std::uint32_t body_a, std::uint32_t body_b, ContactSet& out);
  void flush(ContactSet& out);

  template <typename Meet>
  void test_vertices(std::uint32_t body, std::uint32_t triangle, const MovingTriangle& of,
                     std::uint32_t other, std::uint32_t face, const MovingTriangle& with,
                     Meet&& meet);
  template <typename Meet>
  void test_edges(std::uint32_t body_a, std::uint32_t a, const MovingTriangle& p,
                  std::uint32_t body_b, std::uint32_t b, const MovingTriangle& q, Meet&& meet);

  std::vector<std::shared_ptr<const Elements>> bodies_;
  std::vector<std::span<const Vec3>> start_, end_;  // per body
  std::array<std::uint32_t, 2> pair_ = {};          // bodies of the candidates that come
  bool entered_ = false;
  ExactPairs at_start_;               // tests them at t = 0
  std::map<BodyPair, double> first_;  // times of the pairs that were entered before
  double until_ = 0.0;  // of this pair the first time so far: later ones need not be certified
  std::uint64_t tested_ = 0;
};

}  // namespace contactcheck
