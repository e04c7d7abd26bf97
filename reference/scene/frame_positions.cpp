#include "reference/scene/frame_positions.h"

#include "core/types/check.h"

namespace contactcheck::scene {

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

const FramePosition& FramePositions::operator[](std::size_t frame) const {
  CONTACTCHECK_INVARIANT(scene_ != nullptr, "a scene was given");
  if (held_frame_ != frame) {
    held_frame_.reset();
    held_.nodes = scene_->nodes_of_frame(frame);
    held_.vertices = map_bodies(*scene_, held_.nodes);
    held_frame_ = frame;
  }
  return held_;
}

}  // namespace contactcheck::scene
