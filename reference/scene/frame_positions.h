// The nodes and vertices of a scene, frame by frame.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

struct FramePosition {
  std::vector<std::vector<Vec3>> nodes;     ///< [body]
  std::vector<std::vector<Vec3>> vertices;  ///< [body], canonical mapping
};

/// Maps every body by its nodes, [body][node], to vertices, [body][vertex].
std::vector<std::vector<Vec3>> map_bodies(const Scene& scene,
                                          const std::vector<std::vector<Vec3>>& nodes);

/// @throws InputError naming the scene, the frame, the body and the first node, or else vertex,
/// that is not finite, or two welded vertices that come apart
void require_judgeable(const Scene& scene, std::size_t frame, const FramePosition& position);

/// Evaluates a frame on demand and caches only the last two, both ends of a step: all frames need
/// more memory than all detectors together, and mapping one again takes less time than any
/// detector.
class FramePositions {
 public:
  FramePositions() = default;
  /// `scene` must outlive this object.
  explicit FramePositions(const Scene& scene);

  /// The reference is valid until two other frames have been requested. @pre the scene has this
  /// frame
  const FramePosition& operator[](std::size_t frame) const;

 private:
  const Scene* scene_ = nullptr;
  struct Held {
    std::optional<std::size_t> frame;
    FramePosition position;
  };
  mutable std::array<Held, 2> held_;  // the last one requested is the first
};

}  // namespace contactcheck::scene
