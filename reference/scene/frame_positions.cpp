#include "reference/scene/frame_positions.h"

#include <string>
#include <utility>

#include "core/types/check.h"
#include "reference/text/file_text.h"

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

void require_judgeable(const Scene& scene, std::size_t frame, const FramePosition& position) {
  const auto refuse = [&](std::size_t body, const std::string& what) {
    throw InputError("scene " + text::in_quotes(scene.id) + ", frame " + std::to_string(frame) +
                     ", body " + text::in_quotes(scene.bodies[body].name) + ": " + what);
  };
  const auto require_finite = [&](std::size_t body, const std::string& kind,
                                  const std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!points[i].allFinite()) refuse(body, kind + " " + std::to_string(i) + " is not finite");
  };
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    require_finite(b, "node", position.nodes[b]);
    require_finite(b, "vertex", position.vertices[b]);
    if (const auto torn = torn_weld(*scene.bodies[b].shape, position.vertices[b]))
      refuse(b, "vertices " + std::to_string((*torn)[0]) + " and " + std::to_string((*torn)[1]) +
                    " are welded and come apart");
  }
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
