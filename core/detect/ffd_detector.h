// The FFD-AABB family as one pipeline of shared stages:
//   boxes -> [spheres, level by level] -> spatial hash -> node-plane or triangle test.
// Source: Jeon, Hong, Choi, Jeong: Hierarchical Bounding Sphere FFD-AABB Algorithm for Fast
// Collision Handling of 3D Deformable Objects on Smart Devices, J. Internet Technology 14(5), 2013.
//
// Guarantee: with bounds `safe`, the triangle test and spheres not made smaller (`radius` from 1
// on) it reports exactly the intersecting pairs of triangles, for all finite frames; in single
// precision, exactly those among the vertices that it mapped itself in floats. With bounds `paper`
// it may have false negatives; this suite measures which, and at which stage.
//
// Members that claim the level `box` answer the question `contacts` too: per node inside a box the
// distance to the nearest of its planes, in metres, and the unit normal (see element_stages.h).
// That takes this node out, not the whole box: a lower bound of the translation along that normal
// which separates the boxes.
#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "core/deform/body.h"
#include "core/detect/detector.h"
#include "core/detect/element_stages.h"
#include "core/detect/ffd_config.h"
#include "core/detect/ffd_model.h"
#include "core/detect/ffd_state.h"
#include "core/detect/hash_stage.h"
#include "core/detect/sphere_stage.h"
#include "core/types/frame.h"

namespace contactcheck {

/// The nodes and vertices of a frame in the precision of a detector: the frame's own doubles, or
/// floats about the local origin of the frame (local_origin.h). Vertices in floats are mapped from
/// the rounded nodes.
template <typename T>
class FrameNumbers;

template <>
class FrameNumbers<double> {
 public:
  void prepare(const std::vector<Body>&, bool) {}
  /// The caller keeps the frame's nodes and vertices alive while they are used.
  void update(const Frame& frame);
  Vec3 origin() const { return Vec3::Zero(); }
  std::span<const Vec3> nodes(std::size_t body) const { return nodes_[body]; }
  const std::vector<std::span<const Vec3>>& vertices() const { return vertices_; }

 private:
  std::vector<std::span<const Vec3>> nodes_, vertices_;  // per body
};

template <>
class FrameNumbers<float> {
 public:
  /// @pre every body has a lattice
  void prepare(const std::vector<Body>& bodies, bool with_vertices);
  /// @throws RefusedInput when a node is beyond single precision (round_to_local)
  void update(const Frame& frame);
  /// The local origin of the last update.
  const Vec3& origin() const { return origin_; }
  std::span<const Vec3f> nodes(std::size_t body) const { return nodes_[body]; }
  /// Valid until the next update; without vertices the spans are empty.
  const std::vector<std::span<const Vec3f>>& vertices() const { return spans_; }

 private:
  struct Source {
    const BodyShape* shape;
    SingleLocal local;  // empty without vertices
  };
  std::vector<Source> sources_;  // per body, like the next three
  std::vector<std::vector<Vec3f>> nodes_, vertices_;
  std::vector<std::span<const Vec3f>> spans_;
  Vec3 origin_ = Vec3::Zero();
  bool with_vertices_ = false;
};

/// T: the precision. In single precision everything after the rounding of the nodes is computed in
/// floats. The +tri variants, too: they then map their own vertices and do not need the frame's.
template <typename T>
class FfdDetectorOf : public Detector {
 public:
  explicit FfdDetectorOf(const FfdConfig& config);

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override {
    return config_.element == ElementTest::kTriangle && std::is_same_v<T, double>;
  }
  void expect(const std::vector<Question>& questions) override;
  /// @throws RefusedInput when a body has no lattice, or where self-contact of triangles is
  /// expected as refuse_many_adjacent_pairs() does; update() when nodes are so near the largest
  /// double that a box overflows, or in single precision too far out for it (round_to_local)
  void prepare(const std::vector<Body>& bodies) override;
  void update(const Frame& frame) override;
  void query(Question question, ContactSet& out) override;
  StageTrace trace() override;

  /// For tests: the rest models and the states of the last update.
  const FfdModels<T>& models() const { return models_; }
  const FfdStates<T>& states() const { return states_; }

 private:
  bool safe() const { return config_.bounds == BoundsReading::kSafe; }
  void find_candidates(bool own = false);
  void find_self(ContactSet& out);
  void test_elements(bool first_only, std::vector<ElementPair>& out);
  std::vector<ElementPair> cells_of_hits() const;
  std::vector<std::vector<char>> covered_cells(int levels, const SphereSurvivors& s) const;
  void trace_spheres(StageTrace& out);
  void trace_hash_and_elements(StageTrace& out);

  FfdConfig config_;
  Semantics semantics_;
  bool expects_self_ = false;
  double hash_cell_size_ = 1.0;
  FrameNumbers<T> numbers_;
  FfdModels<T> models_;
  FfdStates<T> states_;
  SphereSurvivors survivors_;
  ProbeHashStageOf<T> probe_hash_;
  BoxHashStageOf<T> box_hash_;
  NodePlaneStageOf<T> node_plane_;
  TriangleStageOf<T> triangle_;
  std::vector<ProbeHit> hits_;
  std::vector<ElementPair> cells_;
};
using FfdDetector = FfdDetectorOf<double>;

}  // namespace contactcheck
