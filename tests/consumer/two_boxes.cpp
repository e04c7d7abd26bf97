// Two boxes in lattices, one of which is squeezed: which of their triangles meet? Prints the number
// of pairs at rest and after the squeeze.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "core/core.h"

using contactcheck::Vec3;

namespace {

contactcheck::TriangleMesh box(const Vec3& low, const Vec3& high) {
  contactcheck::TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.emplace_back(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                               corner & 4 ? high.z() : low.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

contactcheck::Body body_of(const char* name, const contactcheck::TriangleMesh& mesh) {
  return {name, contactcheck::make_shape(mesh, {2, 2, 2})};
}

std::size_t pairs_that_meet(contactcheck::Detector& detector,
                            const std::vector<std::vector<Vec3>>& nodes) {
  contactcheck::Frame frame;
  for (const std::vector<Vec3>& each : nodes) frame.bodies.push_back({each, {}});
  detector.update(frame);
  contactcheck::ContactSet contacts;
  detector.query(contactcheck::Question::kTriangles, contacts);
  contacts.canonicalize();
  return contacts.triangles.size();
}

}  // namespace

int main() {
  contactcheck::DetectorCatalog catalog;
  contactcheck::register_core_detectors(catalog);
  const auto detector = catalog.make(catalog.parse("ffd-lazy"));

  const std::vector<contactcheck::Body> bodies = {
      body_of("lower", box({0, 0, 0}, {1, 1, 1})),
      body_of("upper", box({0.25, 0.25, 1.5}, {0.75, 0.75, 2}))};
  detector->prepare(bodies);
  std::vector<std::vector<Vec3>> nodes = {bodies[0].shape->lattice->rest_nodes(),
                                          bodies[1].shape->lattice->rest_nodes()};
  const std::size_t at_rest = pairs_that_meet(*detector, nodes);
  for (Vec3& node : nodes[0]) node.z() *= 1.75;  // stretched upwards, into the upper box
  const std::size_t stretched = pairs_that_meet(*detector, nodes);
  std::printf("%zu pairs at rest, %zu pairs stretched\n", at_rest, stretched);
  return at_rest == 0 && stretched > 0 ? 0 : 1;
}
