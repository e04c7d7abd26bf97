#include "reference/scene/frame_positions.h"

#include <utility>

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
  if (held_[0].frame == frame) return held_[0].position;
  std::swap(held_[0], held_[1]);
  Held& held = held_[0];
  if (held.frame != frame) {
    held.frame.reset();
    held.position.nodes = scene_->nodes_of_frame(frame);
    held.position.vertices = map_bodies(*scene_, held.position.nodes);
    held.frame = frame;
  }
  return held.position;
}

}  // namespace contactcheck::scene
