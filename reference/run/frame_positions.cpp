#include "reference/run/frame_positions.h"

#include "core/types/check.h"

namespace contactcheck {

std::vector<std::vector<Vec3>> map_bodies(const Scene& scene,
                                          const std::vector<std::vector<Vec3>>& nodes) {
  std::vector<std::vector<Vec3>> vertices(nodes.size());
  for (std::size_t b = 0; b < nodes.size(); ++b) {
    vertices[b].resize(scene.bodies[b].shape->mesh.vertices.size());
    map_body(*scene.bodies[b].shape, nodes[b], vertices[b]);
  }
  return vertices;
}

FramePositions::FramePositions(const Scene& scene) : scene_(&scene) {}

FramePosition FramePositions::evaluated(std::size_t frame) const {
  FramePosition out;
  out.nodes = scene_->nodes_of_frame(frame);
  out.vertices = map_bodies(*scene_, out.nodes);
  return out;
}

const FramePosition& FramePositions::operator[](std::size_t frame) const {
  CONTACTCHECK_INVARIANT(scene_ != nullptr, "a scene was given");
  if (scene_->pairs) {
    if (!kept_.empty() && last_ == frame) return kept_.front();
    kept_.resize(1);
    kept_.front() = evaluated(frame);
    last_ = frame;
    return kept_.front();
  }
  while (kept_.size() <= frame) kept_.push_back(evaluated(kept_.size()));
  return kept_[frame];
}

}  // namespace contactcheck
