// Where all nodes and vertices of a scene are, frame by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

struct FramePosition {
  std::vector<std::vector<Vec3>> nodes;     ///< [body]
  std::vector<std::vector<Vec3>> vertices;  ///< [body], canonical mapping
};

/// The canonical mapping of every body.
std::vector<std::vector<Vec3>> map_bodies(const Scene& scene,
                                          const std::vector<std::vector<Vec3>>& nodes);

/// A frame is evaluated when it is asked for, and only the last one is held: all of them are more
/// memory than all detectors together, and mapping one again takes less time than any detector.
class FramePositions {
 public:
  FramePositions() = default;
  /// `scene` must outlive it.
  explicit FramePositions(const Scene& scene);

  /// Valid until another frame is asked for. @pre the scene has this frame
  const FramePosition& operator[](std::size_t frame) const;

 private:
  const Scene* scene_ = nullptr;
  mutable FramePosition held_;
  mutable std::optional<std::size_t> held_frame_;
};

}  // namespace contactcheck::scene
