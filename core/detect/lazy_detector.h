// ffd-lazy and full-refit: all intersecting pairs of triangles over one tree per shape, and in
// doubles all contact within steps; in doubles exactly.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/detect/detector.h"
#include "core/detect/lazy_steps.h"
#include "core/lazy/embedded_patch.h"
#include "core/lazy/pair_tasks.h"

namespace contactcheck {

/// The source of a tree's bounds.
enum class BoundSource {
  kNodes,     ///< from lattice nodes, on demand; bodies without a lattice from their vertices
  kVertices,  ///< from the given mapped vertices, all of them in every frame
  kCheaper    ///< kNodes, or mapping all and kVertices where the mesh is small for its lattice
};

struct LazyConfig {
  BoundSource bounds = BoundSource::kCheaper;
  std::string isa = "best";
  std::size_t threads = 1;
  Precision precision = Precision::kDouble;
};

/// Exact in doubles for all finite frames: bounds only cull, and contain what they bound. In single
/// precision, for every source of bounds, nodes are rounded about the local origin, vertices mapped
/// from those floats, and these triangles tested exactly (core/lazy/lazy_state.h). Contacts do not
/// depend on the instruction set or the number of threads.
class LazyDetector : public Detector {
 public:
  explicit LazyDetector(const LazyConfig& config);

  const Semantics& semantics() const override { return semantics_; }
  /// In single precision it maps its own vertices.
  bool needs_vertices() const override { return bounds_all() && !single(); }
  void expect(const std::vector<Question>& questions) override;
  /// @throws RefusedInput as refuse_many_adjacent_pairs() does, where self-contact is expected;
  /// elsewhere query() does
  void prepare(const std::vector<Body>& bodies) override;
  void update(const Frame& frame) override;
  /// In doubles.
  void update_step(const Step& step) override;
  void query(Question question, ContactSet& out) override;
  StageTrace trace() override;
  std::vector<Count> counts() override;

  /// Bounds everything in the frame of the last update and checks it against `vertices`, per body,
  /// or in single precision against vertices mapped one by one from its rounded nodes. Returns a
  /// sentence for the first violation, or "".
  std::string validate(const std::vector<std::vector<Vec3>>& vertices);
  /// Work since the last update.
  LazyCounters counters() const;
  /// Bytes of trees and patches, which instances share; bytes of the bodies' states and arenas.
  std::size_t shared_bytes() const;
  std::size_t instance_bytes() const;

 private:
  bool single() const { return config_.precision == Precision::kSingle; }
  bool bounds_all() const { return config_.bounds == BoundSource::kVertices; }
  void find_self(std::vector<SelfPair>& out);
  void know_patches(std::size_t index);
  void bound(std::size_t index, LazyScratch& scratch);
  void know_steps();

  LazyConfig config_;
  const LazyKernels& kernels_;
  Semantics semantics_;
  std::vector<std::shared_ptr<const LatticeTree>> trees_;  // per body; instances share
  std::vector<LazyState> states_;
  std::map<const BodyShape*, PatchTree> patches_;  // for self-contact
  std::vector<std::vector<Vec3>> mapped_;          // per body that is mapped here
  std::vector<std::vector<Vec3f>> single_mapped_;  // instead in single precision
  std::vector<BodyPair> candidates_;
  std::vector<std::size_t> to_bound_;
  std::vector<bool> bounded_;  // per body: bound() was called in this frame
  bool expects_self_ = false;
  std::vector<ElementPair> found_;
  std::vector<std::vector<ElementPair>> own_found_;  // per body, with itself
  ThreadTeam team_;
  PairTasks tasks_;
  std::vector<Body> bodies_;
  std::unique_ptr<LazySteps>
      steps_;  // if questions of steps are expected, or from the first one on
  bool expects_steps_ = false;
  bool in_step_ = false;  // the last update was of a step
};

}  // namespace contactcheck
