#include "reference/plugin/warm_up.h"

#include <algorithm>

#include "reference/mesh/shapes.h"

namespace contactcheck::plugin {
namespace {

constexpr double kFarthest = 1.2, kNearest = 0.5;  // metres between centres: diameters are 1
constexpr double kStretch = 0.2;                   // along z, at the nearest

// 1 at the nearest, 0 at the farthest: up, then down.
double nearness(std::size_t pose) {
  constexpr double kHalf = WarmUpScene::kPoses / 2;
  const auto at = static_cast<double>(pose);
  return std::min(at, 2.0 * kHalf - at) / kHalf;
}

}  // namespace

WarmUpScene::WarmUpScene()
    : bodies_{{"torus", make_shape(mesh::make_torus(0.4, 12), {3, 3, 3})},
              {"sphere", make_shape(mesh::make_sphere(2), {3, 3, 3})}} {
  for (std::size_t pose = 0; pose < kPoses; ++pose) {
    const double near = nearness(pose);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const BodyShape& shape = *bodies_[b].shape;
      BodyPose& out = poses_[pose].emplace_back();
      out.nodes = shape.lattice->rest_nodes();
      for (Vec3& node : out.nodes) {
        node.z() *= 1.0 + kStretch * near;
        if (b == 1) node.x() += kFarthest - near * (kFarthest - kNearest);
      }
      out.vertices.resize(shape.mesh.vertices.size());
      map_body(shape, out.nodes, out.vertices);
    }
  }
}

Frame WarmUpScene::frame(std::size_t number) const {
  Frame out;
  out.index = number;
  out.time = static_cast<double>(number);
  for (const BodyPose& body : poses_[number % kPoses])
    out.bodies.push_back({body.nodes, body.vertices});
  return out;
}

ImpactQuery WarmUpScene::query(std::size_t number, ImpactKind kind) const {
  const TriangleMesh& torus = bodies_[0].shape->mesh;
  const Triangle& triangle = torus.triangles[number % torus.triangles.size()];
  const std::size_t spheres = bodies_[1].shape->mesh.vertices.size();
  ImpactQuery out;
  out.kind = kind;
  for (const bool end : {false, true}) {
    const std::vector<BodyPose>& pose = poses_[(number + (end ? 1 : 0)) % kPoses];
    const Vec3 first = pose[1].vertices[number % spheres];
    const Vec3 second = kind == ImpactKind::vertex_triangle
                            ? pose[0].vertices[triangle[0]]
                            : pose[1].vertices[(number + 1) % spheres];
    (end ? out.end : out.start) = {first, second, pose[0].vertices[triangle[1]],
                                   pose[0].vertices[triangle[2]]};
  }
  return out;
}

}  // namespace contactcheck::plugin
