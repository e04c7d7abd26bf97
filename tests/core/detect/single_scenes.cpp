#include "tests/core/detect/single_scenes.h"

#include <gmock/gmock.h>

#include "core/deform/mapping.h"
#include "core/narrow/triangle_triangle.h"
#include "core/types/local_origin.h"
#include "tests/core/detect/bare_scenes.h"

namespace contactcheck::test {
namespace {

TrianglePointsOf<float> points_of(const std::vector<Vec3f>& vertices, const Triangle& t) {
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}

// Lattices of many cells and of one, and none, in one place.
Scene all_kinds() {
  const TriangleMesh ball = sphere_mesh(Vec3::Zero(), 1.0, 2);
  Scene scene;
  scene.bodies = {make_body("cells", ball, {4, 4, 4}),
                  {"bare", make_bare_shape(unit_box_mesh(4))},
                  make_body("one cell", ball, {1, 1, 1}),
                  make_body("fine", unit_box_mesh(3), {10, 10, 10})};
  TriangleSource random(901);
  for (double spread : {2.0, 0.5}) {
    std::vector<std::vector<Vec3>> nodes;
    for (const Body& body : scene.bodies) {
      nodes.push_back(rest_nodes_at(*body.shape, random.point(Vec3::Zero(), spread)));
      for (Vec3& n : nodes.back()) n = random.point(n, 0.2);
    }
    scene.frames.push_back(make_frame(scene.bodies, std::move(nodes)));
  }
  return scene;
}

Scene soups(const Vec3& at) {
  TriangleSource random(902);
  const auto soup = [&] { return test::scaled(grid_soup(random, 150, 3), 0.25, at); };
  const TriangleMesh first = soup(), second = soup();
  return still({first, second, first});  // the third coincides with the first
}

// Triangles whose planes are lost in rounding.
Scene needles() {
  TriangleSource random(911);
  Scene scene;
  std::vector<std::vector<Vec3>> nodes;
  for (const char* name : {"left", "right"}) {
    std::vector<TrianglePoints> triangles;
    for (int i = 0; i < 400; ++i) {
      const Vec3 a = random.point(Vec3::Zero(), 1.0), b = random.point(Vec3::Zero(), 1.0);
      triangles.push_back({a, b, random.point(0.5 * (a + b), 1e-7)});
    }
    scene.bodies.push_back(make_body(name, soup(triangles), {3, 3, 3}));
    nodes.push_back(rest_nodes_at(*scene.bodies.back().shape, Vec3::Zero()));
    for (Vec3& n : nodes.back()) n = random.point(n, 0.05);
  }
  scene.frames = {make_frame(scene.bodies, std::move(nodes))};
  return scene;
}

SingleScene single(const std::string& name, Scene scene) {
  SingleScene out{name, std::move(scene), true, {}, {}};
  for (const Body& body : out.scene.bodies)
    if (!body.shape->lattice) out.lattices = false;
  for (const FrameData& frame : out.scene.frames) {
    const std::vector<Body>& bodies = out.scene.bodies;
    out.mapped.push_back(meeting_pairs(bodies, mapped_in_floats(bodies, frame)));
    out.fed.push_back(meeting_pairs(bodies, fed_in_floats(frame)));
  }
  return out;
}

}  // namespace

FloatVertices mapped_in_floats(const std::vector<Body>& bodies, const FrameData& data) {
  const Vec3 origin = local_origin(data.frame());
  FloatVertices out;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyShape& shape = *bodies[b].shape;
    std::vector<Vec3f> nodes(data.nodes[b].size());
    round_to_local(data.nodes[b], origin, nodes);
    if (shape.lattice) {
      out.emplace_back(shape.mesh.vertices.size());
      map_vertices(*shape.lattice, shape.embedding, single_local(shape.embedding), nodes,
                   out.back());
    } else {
      out.push_back(std::move(nodes));
    }
  }
  return out;
}

FloatVertices fed_in_floats(const FrameData& data) {
  const Vec3 origin = local_origin(data.frame());
  FloatVertices out;
  for (const std::vector<Vec3>& body : data.vertices) {
    out.emplace_back(body.size());
    round_to_local(body, origin, out.back());
  }
  return out;
}

std::vector<ElementPair> meeting_pairs(const std::vector<Body>& bodies,
                                       const FloatVertices& vertices) {
  std::vector<ElementPair> out;
  const auto triangles = [&](std::size_t body) -> const std::vector<Triangle>& {
    return bodies[body].shape->mesh.triangles;
  };
  for (std::uint32_t a = 0; a < bodies.size(); ++a)
    for (std::uint32_t b = a + 1; b < bodies.size(); ++b)
      for (std::uint32_t i = 0; i < triangles(a).size(); ++i)
        for (std::uint32_t j = 0; j < triangles(b).size(); ++j)
          if (triangles_intersect(points_of(vertices[a], triangles(a)[i]),
                                  points_of(vertices[b], triangles(b)[j])))
            out.push_back({a, b, i, j});
  return out;
}

const std::vector<SingleScene>& single_scenes() {
  static const std::vector<SingleScene> all = {
      single("all kinds", all_kinds()),
      single("three bodies", three_bodies({903, 0.3})),
      single("inverted cells", approach({904, 3.0}, 3)),
      single("far away", approach({905, 0.3, 1.0, Vec3(1e9, -1e9, 5e8)}, 4)),
      single("few digits left", approach({906, 0.3, 1e-6, Vec3(1e9, -1e9, 5e8)}, 4)),
      single("small", approach({907, 0.3, 1e-6}, 4)),
      single("large", approach({908, 0.3, 1e10}, 4)),
      single("exact boxes", exact_boxes(Vec3(3, 0, 0))),
      single("soups", soups(Vec3(1e6, 0, -1e5))),
      single("needles", needles())};
  return all;
}

void expect_pairs(Detector& detector, const SingleScene& single,
                  const std::vector<std::vector<ElementPair>>& expected) {
  for (std::size_t f = 0; f < expected.size(); ++f) {
    const FrameData& frame = single.scene.frames[f];
    EXPECT_EQ(answer(detector, frame, Question::kTriangles).triangles, expected[f])
        << single.name << " " << f;
    ContactSet bodies;
    bodies.triangles = expected[f];
    bodies.canonicalize();
    EXPECT_EQ(answer(detector, frame, Question::kBody).bodies, bodies.bodies)
        << single.name << " " << f;
  }
}

}  // namespace contactcheck::test
