// Where all nodes and vertices of a scene are, frame by frame.
#pragma once

#include <cstddef>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck {

struct FramePosition {
  std::vector<std::vector<Vec3>> nodes;     ///< [body]
  std::vector<std::vector<Vec3>> vertices;  ///< [body], canonical mapping
};

/// The canonical mapping of every body.
std::vector<std::vector<Vec3>> map_bodies(const Scene& scene,
                                          const std::vector<std::vector<Vec3>>& nodes);

/// Frames are evaluated when they are first asked for. They are kept, but for random pairs: of
/// those only the last one asked for is held, because ten million would not fit into memory.
class FramePositions {
 public:
  FramePositions() = default;
  /// `scene` must outlive it.
  explicit FramePositions(const Scene& scene);

  /// Of random pairs valid until another frame is asked for. @pre the scene has this frame
  const FramePosition& operator[](std::size_t frame) const;

 private:
  FramePosition evaluated(std::size_t frame) const;

  const Scene* scene_ = nullptr;
  mutable std::vector<FramePosition> kept_;
  mutable std::size_t last_ = 0;  // of random pairs: the frame in kept_[0], if there is one
};

}  // namespace contactcheck
