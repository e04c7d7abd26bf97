// What a detector may be warmed up with: a scene of contactcheck's own, the same for all.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/deform/body.h"
#include "core/types/frame.h"
#include "core/types/impact.h"

namespace contactcheck::plugin {

/// A torus of 576 triangles and a sphere of 320, each in a lattice of 3 x 3 x 3 cells, in 32 poses:
/// they come nearer, stretching, until they overlap, and part again. Programs that compile what
/// they run often have then done so, on input that no result is made of. No libm: the same bits
/// everywhere.
class WarmUpScene {
 public:
  static constexpr std::size_t kPoses = 32;

  WarmUpScene();
  WarmUpScene(const WarmUpScene&) = delete;
  WarmUpScene& operator=(const WarmUpScene&) = delete;

  const std::vector<Body>& bodies() const { return bodies_; }
  /// Pose `number` modulo kPoses, at that second, with nodes and vertices; as long as this lives.
  Frame frame(std::size_t number) const;
  /// From that pose to the next.
  Step step(std::size_t number) const { return {frame(number), frame(number + 1)}; }
  /// In that step, elements of both bodies: each number other ones.
  ImpactQuery query(std::size_t number, ImpactKind kind) const;

 private:
  struct BodyPose {
    std::vector<Vec3> nodes, vertices;
  };

  std::vector<Body> bodies_;
  std::array<std::vector<BodyPose>, kPoses> poses_;
};

}  // namespace contactcheck::plugin
