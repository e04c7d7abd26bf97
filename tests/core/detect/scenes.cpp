#include "tests/core/detect/scenes.h"

#include <algorithm>
#include <utility>

#include "core/lazy/kernels.h"
#include "core/narrow/triangle_triangle.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

TriangleMesh scaled(TriangleMesh mesh, double scale) {
  for (Vec3& v : mesh.vertices) v *= scale;
  return mesh;
}

Body random_body(TriangleSource& random, const std::string& name, double scale) {
  const auto cells = [&] { return static_cast<std::uint32_t>(3 + random.below(3)); };
  const Resolution resolution{cells(), cells(), cells()};
  TriangleMesh mesh = random.below(2) ? sphere_mesh(Vec3::Zero(), 1.0, 2)
                                      : box_mesh(Vec3(-1, -0.75, -0.5), Vec3(1, 0.75, 0.5), 3);
  return make_body(name, scaled(std::move(mesh), scale), resolution);
}

std::vector<Vec3> random_nodes(TriangleSource& random, const BodyShape& shape, const Vec3& at,
                               double strength) {
  std::vector<Vec3> nodes = rest_nodes_at(shape, at);
  for (Vec3& n : nodes) n = random.point(n, strength);
  return nodes;
}

std::vector<TrianglePoints> triangles_of(const Body& body, const std::vector<Vec3>& vertices) {
  std::vector<TrianglePoints> out;
  for (const Triangle& t : body.shape->mesh.triangles)
    out.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
  return out;
}

void add_true_pairs(const std::vector<TrianglePoints>& first,
                    const std::vector<TrianglePoints>& second, const BodyPair& bodies,
                    std::vector<ElementPair>& out) {
  for (std::uint32_t i = 0; i < first.size(); ++i)
    for (std::uint32_t j = 0; j < second.size(); ++j)
      if (triangles_intersect(first[i], second[j])) out.push_back({bodies.a, bodies.b, i, j});
}

}  // namespace

Scene approach(const SceneSettings& settings, int frames) {
  TriangleSource random(settings.seed);
  Scene scene;
  scene.bodies = {random_body(random, "still", settings.scale),
                  random_body(random, "moving", settings.scale)};
  for (int f = 0; f < frames; ++f) {
    const double gap = 3.2 - 2.6 * f / std::max(1, frames - 1);
    const Vec3 direction(1.0, 0.25 * random.unit(), 0.25 * random.unit());
    const double strength = settings.strength * settings.scale;
    scene.frames.push_back(
        make_frame(scene.bodies,
                   {random_nodes(random, *scene.bodies[0].shape, settings.offset, strength),
                    random_nodes(random, *scene.bodies[1].shape,
                                 settings.offset + gap * settings.scale * direction, strength)}));
  }
  return scene;
}

Scene three_bodies(const SceneSettings& settings) {
  TriangleSource random(settings.seed);
  Scene scene;
  std::vector<std::vector<Vec3>> nodes;
  for (const char* name : {"first", "second", "third"}) {
    const Vec3 at(1.5 * static_cast<double>(scene.bodies.size()), 0.2, 0.1);
    scene.bodies.push_back(random_body(random, name, 1.0));
    nodes.push_back(random_nodes(random, *scene.bodies.back().shape, at, settings.strength));
  }
  scene.frames.push_back(make_frame(scene.bodies, std::move(nodes)));
  return scene;
}

Scene exact_boxes(const Vec3& shift, double scale) {
  Scene scene;
  // [-1, 1]^3 in a lattice of [-2, 2]^3 with cells of side 1; vertices at multiples of 1/2.
  const TriangleMesh box = scaled(box_mesh(Vec3::Constant(-1), Vec3::Ones(), 4), scale);
  scene.bodies = {make_body("left", box, {4, 4, 4}, 0.5), make_body("right", box, {4, 4, 4}, 0.5)};
  TriangleSource random(71);
  for (double gap : {2.5, 2.0, 1.75, 0.5}) {
    std::vector<std::vector<Vec3>> nodes;
    for (double x : {0.0, gap}) {
      nodes.push_back(rest_nodes_at(*scene.bodies[0].shape, scale * (shift + Vec3(x, 0, 0))));
      if (gap < 2.0)  // multiples of 1/64
        for (Vec3& n : nodes.back()) n += scale * random.grid_point(24) / 64.0;
    }
    scene.frames.push_back(make_frame(scene.bodies, std::move(nodes)));
  }
  return scene;
}

std::vector<ElementPair> true_pairs(const Scene& scene, const FrameData& frame) {
  std::vector<std::vector<TrianglePoints>> triangles;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    triangles.push_back(triangles_of(scene.bodies[b], frame.vertices[b]));
  std::vector<ElementPair> pairs;
  for (std::uint32_t a = 0; a < triangles.size(); ++a)
    for (std::uint32_t b = a + 1; b < triangles.size(); ++b)
      add_true_pairs(triangles[a], triangles[b], {a, b}, pairs);
  return pairs;
}

std::vector<std::string> family() {
  return {"ffd-grid", "ffd-aabb", "ffd-aabb-sphere", "ffd-aabb-sphere2", "ffd-aabb-sphereN"};
}

std::vector<std::string> family_with_triangles() {
  std::vector<std::string> ids = family();
  for (std::string& id : ids) id += "+tri";
  return ids;
}

std::vector<std::string> exact_detectors() {
  std::vector<std::string> names = family_with_triangles();
  for (const char* name : {"ffd-lazy", "ffd-lazy:bounds=nodes", "ffd-lazy:bounds=nodes,threads=3",
                           "full-refit", "full-refit:threads=2"})
    names.push_back(name);
  for (const std::string& isa : lazy_isas()) names.push_back("ffd-lazy:bounds=nodes,isa=" + isa);
  return names;
}

std::unique_ptr<Detector> prepared(const std::string& name, const Scene& scene) {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  std::unique_ptr<Detector> detector = catalog.make(catalog.parse(name));
  detector->prepare(scene.bodies);
  return detector;
}

ContactSet answer(Detector& detector, const FrameData& frame, Question question) {
  const Frame f = frame.frame();
  detector.update(f);
  ContactSet out;
  detector.query(question, out);
  out.canonicalize();
  return out;
}

ContactSet answer(Detector& detector, const FrameData& frame) {
  return answer(detector, frame, detector.semantics().questions.front());
}

}  // namespace contactcheck::test
