// ffd-lazy and full-refit in single precision: they find exactly the pairs of triangles that
// intersect among the vertices in floats, on every instruction set and number of threads, wherever
// their bounds come from.

#include <gmock/gmock.h>

#include <algorithm>

#include "core/deform/mapping.h"
#include "core/detect/lazy_detector.h"
#include "core/narrow/triangle_triangle.h"
#include "core/types/check.h"
#include "core/types/local_origin.h"
#include "tests/core/detect/bare_scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::FrameData;
using test::Scene;
using test::TriangleSource;

constexpr Precision kSingle = Precision::kSingle;

LazyConfig config_of(BoundSource bounds, const std::string& isa = "best", std::size_t threads = 1) {
  return {bounds, isa, threads, kSingle};
}

std::vector<LazyConfig> configs() {
  std::vector<LazyConfig> all;
  for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kVertices, BoundSource::kCheaper})
    for (const std::string& isa : lazy_isas()) all.push_back(config_of(bounds, isa));
  return all;
}

std::string name_of(const LazyConfig& config) {
  return config.isa + " " + std::to_string(static_cast<int>(config.bounds)) + " " +
         std::to_string(config.threads);
}

std::unique_ptr<LazyDetector> prepared(const LazyConfig& config, const Scene& scene) {
  auto detector = std::make_unique<LazyDetector>(config);
  detector->prepare(scene.bodies);
  return detector;
}

// Vertices as single precision has them, about the local origin, in metres.
std::vector<Vec3f> float_vertices(const BodyShape& shape, const std::vector<Vec3>& nodes,
                                  const Vec3& origin) {
  std::vector<Vec3f> rounded(nodes.size());
  round_to_local(nodes, origin, rounded);
  if (!shape.lattice) return rounded;
  std::vector<Vec3f> out(shape.mesh.vertices.size());
  map_vertices(*shape.lattice, shape.embedding, single_local(shape.embedding), rounded, out);
  return out;
}

std::vector<TrianglePointsOf<float>> float_triangles(const Body& body,
                                                     const std::vector<Vec3>& nodes,
                                                     const Vec3& origin) {
  const std::vector<Vec3f> vertices = float_vertices(*body.shape, nodes, origin);
  std::vector<TrianglePointsOf<float>> out;
  for (const Triangle& t : body.shape->mesh.triangles)
    out.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
  return out;
}

std::vector<ElementPair> exact_pairs(const Scene& scene, const FrameData& data) {
  const Vec3 origin = local_origin(data.frame());
  std::vector<std::vector<TrianglePointsOf<float>>> bodies;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    bodies.push_back(float_triangles(scene.bodies[b], data.nodes[b], origin));
  std::vector<ElementPair> out;
  for (std::uint32_t a = 0; a < bodies.size(); ++a)
    for (std::uint32_t b = a + 1; b < bodies.size(); ++b)
      for (std::uint32_t i = 0; i < bodies[a].size(); ++i)
        for (std::uint32_t j = 0; j < bodies[b].size(); ++j)
          if (triangles_intersect(bodies[a][i], bodies[b][j])) out.push_back({a, b, i, j});
  return out;
}

struct SingleScene {
  std::string name;
  Scene scene;
  std::vector<std::vector<ElementPair>> exact;  // per frame
};

SingleScene single(const std::string& name, Scene scene) {
  SingleScene out{name, std::move(scene), {}};
  for (const FrameData& frame : out.scene.frames)
    out.exact.push_back(exact_pairs(out.scene, frame));
  return out;
}

// Lattices of many cells and of one, and none, in one place.
Scene all_kinds() {
  const TriangleMesh ball = test::sphere_mesh(Vec3::Zero(), 1.0, 2);
  Scene scene;
  scene.bodies = {test::make_body("cells", ball, {4, 4, 4}),
                  {"bare", make_bare_shape(test::unit_box_mesh(4))},
                  test::make_body("one cell", ball, {1, 1, 1}),
                  test::make_body("fine", test::unit_box_mesh(3), {10, 10, 10})};
  TriangleSource random(901);
  for (double spread : {2.0, 0.5}) {
    std::vector<std::vector<Vec3>> nodes;
    for (const Body& body : scene.bodies) {
      nodes.push_back(test::rest_nodes_at(*body.shape, random.point(Vec3::Zero(), spread)));
      for (Vec3& n : nodes.back()) n = random.point(n, 0.2);
    }
    scene.frames.push_back(test::make_frame(scene.bodies, std::move(nodes)));
  }
  return scene;
}

Scene soups(const Vec3& at) {
  TriangleSource random(902);
  const auto soup = [&] { return test::scaled(test::grid_soup(random, 150, 3), 0.25, at); };
  const TriangleMesh first = soup(), second = soup();
  return test::still({first, second, first});  // the third coincides with the first
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
    scene.bodies.push_back(test::make_body(name, test::soup(triangles), {3, 3, 3}));
    nodes.push_back(test::rest_nodes_at(*scene.bodies.back().shape, Vec3::Zero()));
    for (Vec3& n : nodes.back()) n = random.point(n, 0.05);
  }
  scene.frames = {test::make_frame(scene.bodies, std::move(nodes))};
  return scene;
}

// Made once: brute force is the expensive part.
const std::vector<SingleScene>& scenes() {
  static const std::vector<SingleScene> all = {
      single("all kinds", all_kinds()),
      single("three bodies", test::three_bodies({903, 0.3})),
      single("inverted cells", test::approach({904, 3.0}, 3)),
      single("far away", test::approach({905, 0.3, 1.0, Vec3(1e9, -1e9, 5e8)}, 4)),
      single("few digits left", test::approach({906, 0.3, 1e-6, Vec3(1e9, -1e9, 5e8)}, 4)),
      single("small", test::approach({907, 0.3, 1e-6}, 4)),
      single("large", test::approach({908, 0.3, 1e10}, 4)),
      single("exact boxes", test::exact_boxes(Vec3(3, 0, 0))),
      single("soups", soups(Vec3(1e6, 0, -1e5))),
      single("needles", needles())};
  return all;
}

TEST(LazySingleScenes, HaveContact) {
  for (const SingleScene& scene : scenes()) {
    std::size_t most = 0;
    for (const auto& pairs : scene.exact) most = std::max(most, pairs.size());
    EXPECT_GT(most, 20u) << scene.name;
  }
}

TEST(LazySingle, FindsWhatIntersectsForEverySourceAndInstructionSet) {
  for (const SingleScene& single : scenes())
    for (const LazyConfig& config : configs()) {
      const auto detector = prepared(config, single.scene);
      for (std::size_t f = 0; f < single.exact.size(); ++f) {
        const FrameData& frame = single.scene.frames[f];
        EXPECT_EQ(answer(*detector, frame, Question::kTriangles).triangles, single.exact[f])
            << single.name << " " << f << " " << name_of(config);
        ContactSet bodies;
        bodies.triangles = single.exact[f];
        bodies.canonicalize();
        EXPECT_EQ(answer(*detector, frame, Question::kBody).bodies, bodies.bodies)
            << single.name << " " << f << " " << name_of(config);
      }
    }
}

TEST(LazySingle, FindsTheSameOnEveryNumberOfThreads) {
  for (const SingleScene& single : scenes())
    for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kVertices})
      for (std::size_t threads : {2u, 3u, 8u}) {
        const LazyConfig config = config_of(bounds, "best", threads);
        const auto detector = prepared(config, single.scene);
        for (std::size_t f = 0; f < single.exact.size(); ++f)
          EXPECT_EQ(answer(*detector, single.scene.frames[f], Question::kTriangles).triangles,
                    single.exact[f])
              << single.name << " " << f << " " << name_of(config);
      }
}

TEST(LazySingle, KeepsThePromisesOfItsBounds) {
  for (const SingleScene& single : scenes())
    for (const LazyConfig& config : configs()) {
      const auto detector = prepared(config, single.scene);
      for (const FrameData& data : single.scene.frames) {
        detector->update(data.frame());
        EXPECT_EQ(detector->validate(data.vertices), "") << single.name << name_of(config);
      }
    }
}

// Pairs found by one and not by the other.
std::size_t differences(const std::vector<ElementPair>& a, const std::vector<ElementPair>& b) {
  std::vector<ElementPair> out;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out.size();
}

TEST(LazySingle, DiffersFromTheTruthByFewPairsWhereverTheSceneIs) {
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1e6, -1e6, 5e5)}) {
    const Scene scene = test::approach({909, 0.3, 1.0, at}, 4);
    std::size_t found = 0, different = 0;
    const auto detector = prepared(config_of(BoundSource::kNodes), scene);
    for (const FrameData& frame : scene.frames) {
      const std::vector<ElementPair> truth = test::true_pairs(scene, frame);
      found += truth.size();
      different += differences(truth, answer(*detector, frame, Question::kTriangles).triangles);
    }
    EXPECT_GT(found, 150u);
    EXPECT_LE(100 * different, found);
  }
}

// Nodes and local coordinates of few bits: no operation rounds, and the local origin moves along.
TEST(LazySingle, IsExactWhereFloatsAre) {
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0x1p30, -0x1p31, 0x1p29)}) {
    const Scene scene = test::exact_boxes(shift);
    for (const LazyConfig& config : configs()) {
      const auto detector = prepared(config, scene);
      for (const FrameData& frame : scene.frames)
        EXPECT_EQ(answer(*detector, frame, Question::kTriangles).triangles,
                  test::true_pairs(scene, frame))
            << shift.transpose() << " " << name_of(config);
    }
  }
}

TEST(LazySingle, SaysWhatItIs) {
  for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kVertices, BoundSource::kCheaper}) {
    const LazyDetector detector(config_of(bounds));
    EXPECT_EQ(detector.semantics().precision, kSingle);
    EXPECT_TRUE(detector.semantics().local_origin);
    EXPECT_FALSE(detector.semantics().exact);
    EXPECT_TRUE(detector.semantics().closed);
    EXPECT_FALSE(detector.needs_vertices());
  }
  EXPECT_TRUE(LazyDetector({}).semantics().exact);
}

TEST(LazySingle, RefusesWhatIsBeyondTheLimitAndAnswersTheNextFrame) {
  const Scene scene = test::approach({910, 0.3}, 4);
  for (const LazyConfig& config : configs()) {
    const auto detector = prepared(config, scene);
    FrameData far = scene.frames[3];
    for (Vec3& n : far.nodes[1]) n.x() += 5e12;
    EXPECT_THROW(detector->update(far.frame()), RefusedInput);
    far.nodes[1][0].x() = 1e308;
    EXPECT_THROW(detector->update(far.frame()), RefusedInput);
    EXPECT_EQ(answer(*detector, scene.frames[3], Question::kTriangles).triangles,
              exact_pairs(scene, scene.frames[3]));
  }
}

}  // namespace
}  // namespace contactcheck
