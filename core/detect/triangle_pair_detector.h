// A detector made of two parts: a broad phase that names candidate pairs of triangles, and a test
// of two triangles.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/detect/detector.h"
#include "core/detect/fed_vertices.h"
#include "core/detect/seen_pairs.h"
#include "core/detect/triangle_record.h"
#include "core/narrow/adjacent_triangles.h"
#include "core/narrow/triangle_triangle.h"
#include "core/types/check.h"
#include "core/types/mesh_topology.h"

namespace contactcheck {

/// Core's exact test of two triangles: closed, for all finite doubles, and so for floats.
struct ExactTriangles {
  template <typename T>
  bool operator()(const TrianglePointsOf<T>& p, const TrianglePointsOf<T>& q) const {
    return triangles_intersect(p, q);
  }
};

/// The precision of a detector whose numbers are of type T.
template <typename T>
inline constexpr Precision kPrecision =
    std::is_same_v<T, float> ? Precision::kSingle : Precision::kDouble;

/// True if this broad phase finds candidates for contacts of a body with itself.
template <typename Broad>
inline constexpr bool kFindsSelf =
    requires(Broad broad) { broad.visit_own_candidates([](const SelfPair&) { return false; }); };

/// The claims of a detector that tests triangle pairs exactly. In single precision it is not exact:
/// its triangles are those of vertices, or of nodes, rounded about the local origin.
inline Semantics exact_triangle_semantics(Precision precision = Precision::kDouble,
                                          bool self = false) {
  Semantics s;
  s.levels = {Level::kBody, Level::kTriangle};
  s.questions = {Question::kTriangles, Question::kBody};
  s.precision = precision;
  s.local_origin = precision == Precision::kSingle;
  s.exact = precision == Precision::kDouble;
  if (self) {
    s.levels.insert(s.levels.end(),
                    {Level::kSelf, Level::kSelfVertex, Level::kSelfEdge, Level::kSelfBody});
    s.questions.push_back(Question::kSelf);
  }
  return s;
}

/// Broad:
///   Real                          double, or float: vertices rounded about the local origin
///   kName, kVisitedUnit           texts for the stage trace
///   kBoxesOverlap                 true: the two AABBs of every candidate overlap
///   prepare(bodies), update(vertices)   per body
///   visit_candidates(visit)       calls bool visit(const ElementPair&) for a superset of the
///                                 intersecting pairs of triangles of different bodies; once it has
///                                 returned true the rest of these two bodies may be left out
///   visit_own_candidates(visit)   optional: the same for two triangles of one body, as SelfPair;
///                                 the detector then answers the question `self`
///   visited()                     what the last visit_candidates looked at
/// Narrow:
///   bool operator()(p, q)         two triangles of Reals whose AABBs overlap
///   begin_frame()                 optional; called by every update
///   notes()                       optional; see Detector::notes
/// Exact for the vertices in Reals when Narrow is, since nothing else decides: AABBs are exact.
/// @pre the frame's vertices outlive the queries that follow update
template <typename Broad, typename Narrow = ExactTriangles>
class TrianglePairDetector : public Detector {
 public:
  using Real = typename Broad::Real;

  TrianglePairDetector(Broad broad, Narrow narrow, Semantics semantics)
      : broad_(std::move(broad)), narrow_(std::move(narrow)), semantics_(std::move(semantics)) {}

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }

  void expect(const std::vector<Question>& questions) override {
    expects_self_ =
        std::find(questions.begin(), questions.end(), Question::kSelf) != questions.end();
  }

  /// @throws RefusedInput as refuse_many_adjacent_pairs() does, where self-contact is expected;
  /// elsewhere query() does
  void prepare(const std::vector<Body>& bodies) override {
    shapes_.clear();
    for (const Body& body : bodies) {
      if (expects_self_) refuse_many_adjacent_pairs(body.shape->linked());
      shapes_.push_back(body.shape.get());
    }
    broad_.prepare(bodies);
  }

  void update(const Frame& frame) override {
    CONTACTCHECK_INVARIANT(frame.bodies.size() == shapes_.size(), "one state per prepared body");
    for (std::size_t b = 0; b < shapes_.size(); ++b)
      CONTACTCHECK_INVARIANT(frame.bodies[b].vertices.size() == shapes_[b]->mesh.vertices.size(),
                             "one position per vertex");
    vertices_.update(frame);
    broad_.update(vertices_.spans());
    if constexpr (requires { narrow_.begin_frame(); }) narrow_.begin_frame();
  }

  void query(Question question, ContactSet& out) override {
    CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
    if (question == Question::kBody) {
      find_bodies(out.bodies);
    } else if (question == Question::kSelf) {
      find_self(out.self);
    } else {
      find_triangles(out.triangles);
    }
  }

  StageTrace trace() override {
    StageTrace out;
    std::vector<std::uint64_t> triangles;
    for (const BodyShape* shape : shapes_) triangles.push_back(shape->mesh.triangles.size());
    std::vector<ElementPair> candidates, exact;
    broad_.visit_candidates([&](const ElementPair& pair) {
      candidates.push_back(pair);
      return false;
    });
    out.stages.push_back(
        triangle_record(Broad::kName, brute_force_pairs(triangles), std::move(candidates)));
    out.stages[0].visited = broad_.visited();
    out.stages[0].visited_unit = Broad::kVisitedUnit;
    find_triangles(exact);
    out.stages.push_back(triangle_record("triangles", out.stages[0].out, std::move(exact)));
    return out;
  }

  std::vector<std::string> notes() override {
    if constexpr (requires {
                    { narrow_.notes() } -> std::convertible_to<std::vector<std::string>>;
                  }) {
      return narrow_.notes();
    } else {
      return {};
    }
  }

 protected:
  Broad& broad() { return broad_; }
  Narrow& narrow() { return narrow_; }

 private:
  using Points = TrianglePointsOf<Real>;

  Points points(std::uint32_t body, std::uint32_t triangle) const {
    const Triangle& t = shapes_[body]->mesh.triangles[triangle];
    const std::span<const Vec3Of<Real>> v = vertices_.spans()[body];
    return {v[t[0]], v[t[1]], v[t[2]]};
  }

  static AabbOf<Real> box_of(const Points& p) {
    return {p[0].cwiseMin(p[1]).cwiseMin(p[2]), p[0].cwiseMax(p[1]).cwiseMax(p[2])};
  }

  bool intersect(const ElementPair& pair) {
    const Points p = points(pair.body_a, pair.a), q = points(pair.body_b, pair.b);
    if constexpr (!Broad::kBoxesOverlap)
      if (!box_of(p).overlaps(box_of(q))) return false;
    return narrow_(p, q);
  }

  void find_triangles(std::vector<ElementPair>& out) {
    broad_.visit_candidates([&](const ElementPair& pair) {
      if (intersect(pair)) out.push_back(pair);
      return false;
    });
  }

  void find_bodies(std::vector<BodyPair>& out) {
    // A broad phase may go on with two bodies after their first hit, and mix pairs of bodies.
    SeenPairs found(shapes_.size());
    broad_.visit_candidates([&](const ElementPair& pair) {
      if (found.seen(pair.body_a, pair.body_b)) return true;
      if (!intersect(pair)) return false;
      found.mark(pair.body_a, pair.body_b);
      out.push_back({pair.body_a, pair.body_b});
      return true;
    });
  }

  void find_self(std::vector<SelfPair>& out) {
    if constexpr (kFindsSelf<Broad>) {
      if (!expects_self_)
        for (const BodyShape* shape : shapes_) refuse_many_adjacent_pairs(shape->linked());
      broad_.visit_own_candidates([&](const SelfPair& pair) {
        const BodyShape& shape = *shapes_[pair.body];
        if (meet_beyond_shared(shared_corners(shape.linked()[pair.a], shape.linked()[pair.b]),
                               points(pair.body, pair.a), points(pair.body, pair.b)))
          out.push_back(pair);
        return false;
      });
    }
  }

  Broad broad_;
  Narrow narrow_;
  Semantics semantics_;
  bool expects_self_ = false;
  std::vector<const BodyShape*> shapes_;
  FedVertices<Real> vertices_;
};

}  // namespace contactcheck
