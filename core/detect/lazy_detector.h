// ffd-lazy and full-refit: all intersecting pairs of triangles, exactly, over one tree per shape.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/detect/detector.h"
#include "core/lazy/pair_tasks.h"

namespace contactcheck {

/// Where the bounds of the tree come from.
enum class BoundSource {
  kNodes,     ///< from lattice nodes, on demand; bodies without a lattice from their vertices
  kVertices,  ///< from the given mapped vertices, all of them in every frame
  kCheaper    ///< kNodes, or mapping all and kVertices where the mesh is small for its lattice
};

struct LazyConfig {
  BoundSource bounds = BoundSource::kCheaper;
  std::string isa = "best";
  std::size_t threads = 1;
};

/// Exact for all finite doubles: bounds only cull, and contain what they stand for. The contacts do
/// not depend on the instruction set nor on the number of threads.
class LazyDetector : public Detector {
 public:
  explicit LazyDetector(const LazyConfig& config);

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return config_.bounds == BoundSource::kVertices; }
  void prepare(const std::vector<Body>& bodies) override;
  void update(const Frame& frame) override;
  void query(Question question, ContactSet& out) override;
  StageTrace trace() override;
  std::vector<Count> counts() override;

  /// Bounds everything in the frame of the last update and checks it against `vertices`, per body;
  /// "" or a sentence for the first broken promise.
  std::string validate(const std::vector<std::vector<Vec3>>& vertices);
  /// Since the last update.
  LazyCounters counters() const;
  /// Bytes of all trees; of all that the bodies hold beside them.
  std::size_t shared_bytes() const;
  std::size_t instance_bytes() const;

 private:
  void begin_body(const BodyState& body, LazyState& state);
  void bound(std::size_t index, LazyScratch& scratch);
  void bound_bodies_that_meet();

  LazyConfig config_;
  const LazyKernels& kernels_;
  Semantics semantics_;
  std::vector<std::shared_ptr<const LatticeTree>> trees_;  // per body; instances share
  std::vector<LazyState> states_;
  std::vector<std::vector<Vec3>> mapped_;  // per body that is mapped here
  std::vector<BodyPair> candidates_;
  std::vector<std::size_t> to_bound_;
  std::vector<ElementPair> found_;
  ThreadTeam team_;
  PairTasks tasks_;
};

}  // namespace contactcheck
