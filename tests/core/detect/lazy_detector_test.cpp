// ffd-lazy and full-refit against brute force, with every source of bounds and instruction set.

#include "core/detect/lazy_detector.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "core/deform/node_shape.h"
#include "tests/core/detect/bare_scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::FrameData;
using test::make_frame;
using test::rest_nodes_at;
using test::Scene;
using test::TriangleSource;
using test::true_pairs;
using ::testing::IsEmpty;

std::vector<LazyConfig> configs() {
  std::vector<LazyConfig> all;
  for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kVertices, BoundSource::kCheaper})
    for (const std::string& isa : lazy_isas()) all.push_back({bounds, isa});
  return all;
}

std::string name_of(const LazyConfig& config) {
  return config.isa + " " + std::to_string(static_cast<int>(config.bounds));
}

struct JudgedLazyScene {
  std::string name;
  Scene scene;
  std::vector<ContactSet> truth;  // per frame
};

JudgedLazyScene judged(const std::string& name, Scene scene) {
  JudgedLazyScene out{name, std::move(scene), {}};
  for (const FrameData& frame : out.scene.frames) {
    out.truth.emplace_back().triangles = true_pairs(out.scene, frame);
    out.truth.back().canonicalize();
  }
  return out;
}

void add_frame(Scene& scene, TriangleSource& random, double spread, double strength) {
  std::vector<std::vector<Vec3>> nodes;
  for (const Body& body : scene.bodies) {
    nodes.push_back(rest_nodes_at(*body.shape, random.point(Vec3::Zero(), spread)));
    for (Vec3& n : nodes.back()) n = random.point(n, strength);
  }
  scene.frames.push_back(make_frame(scene.bodies, std::move(nodes)));
}

Scene with_frames(std::vector<Body> bodies, std::uint64_t seed) {
  TriangleSource random(seed);
  Scene scene;
  scene.bodies = std::move(bodies);
  for (double spread : {4.0, 1.0, 0.3}) add_frame(scene, random, spread, 0.2);
  return scene;
}

Scene lattices_and_none() {
  const TriangleMesh ball = test::sphere_mesh(Vec3::Zero(), 1.0, 2);
  return with_frames({test::make_body("cells", ball, {4, 4, 4}),
                      {"bare", make_bare_shape(test::unit_box_mesh(4))},
                      test::make_body("one cell", ball, {1, 1, 1}),
                      {"bare ball", make_bare_shape(ball)},
                      test::make_body("fine", test::unit_box_mesh(3), {10, 10, 10})},
                     701);
}

Scene instances() {
  const Body ball = test::make_body("ball", test::sphere_mesh(Vec3::Zero(), 1.0, 2), {4, 5, 3});
  const Body bare{"bare", make_bare_shape(test::unit_box_mesh(3))};
  return with_frames({ball, bare, ball, bare, ball}, 702);
}

// Sizes from tiny to huge in one scene, in one place: pairs of one size meet.
Scene sizes() {
  const TriangleMesh ball = test::sphere_mesh(Vec3::Zero(), 1.0, 1);
  Scene scene;
  std::vector<std::vector<Vec3>> nodes;
  constexpr double kSizes[] = {1.0, 1.1, 1e-12, 1.2e-12, 1e-300, 1.1e-300, 1e200};
  for (double size : kSizes) {
    scene.bodies.push_back(test::make_body("ball", ball, {3, 3, 3}));
    nodes.push_back(rest_nodes_at(*scene.bodies.back().shape, Vec3(0.01, 0.4, 0.3)));
    for (Vec3& n : nodes.back()) n *= size;
  }
  for (std::size_t b : {0u, 2u, 4u})  // into the next one
    for (Vec3& n : nodes[b]) n.x() += 0.5 * kSizes[b];
  scene.frames.push_back(make_frame(scene.bodies, std::move(nodes)));
  return scene;
}

// Two boxes that share a face at the largest double, bit for bit by lattice nodes.
Scene at_the_largest_double() {
  Scene scene;
  std::vector<std::vector<Vec3>> nodes;
  for (const Vec3& lo : {Vec3(-1, -1, -1), Vec3(0.5, -0.5, 0)}) {
    TriangleMesh mesh = test::box_mesh(lo, Vec3::Ones(), 3);
    for (Vec3& v : mesh.vertices) v *= std::numeric_limits<double>::max();
    const NodeShape shape = make_node_shape(mesh.vertices.size(), mesh.triangles);
    scene.bodies.push_back({"box", shape.shape});
    nodes.push_back(shape.nodes_for(mesh.vertices));
  }
  scene.frames.push_back(make_frame(scene.bodies, std::move(nodes)));
  return scene;
}

// Made once: brute force is the expensive part.
const std::vector<JudgedLazyScene>& scenes() {
  static const std::vector<JudgedLazyScene> all = {
      judged("lattices and none", lattices_and_none()),
      judged("instances", instances()),
      judged("sizes", sizes()),
      judged("three bodies", test::three_bodies({703, 0.3})),
      judged("inverted cells", test::approach({704, 3.0}, 3)),
      judged("far away", test::approach({705, 0.3, 1e-3, Vec3(1e9, -1e9, 5e8)}, 4)),
      judged("huge", test::approach({706, 0.3, 1e200}, 4)),
      judged("exact boxes", test::exact_boxes(Vec3(3, 0, 0))),
      judged("at the largest double", at_the_largest_double())};
  return all;
}

std::unique_ptr<LazyDetector> prepared(const LazyConfig& config, const Scene& scene) {
  auto detector = std::make_unique<LazyDetector>(config);
  detector->prepare(scene.bodies);
  return detector;
}

TEST(LazyDetectorScenes, HaveFramesWithAndWithoutContact) {
  for (const JudgedLazyScene& scene : scenes()) {
    std::size_t most = 0;
    for (const ContactSet& truth : scene.truth) most = std::max(most, truth.triangles.size());
    EXPECT_GT(most, 20u) << scene.name;
  }
  EXPECT_GE(scenes()[2].truth[0].bodies.size(), 3u);
}

TEST(LazyDetector, AgreesWithBruteForceForEverySourceAndInstructionSet) {
  for (const JudgedLazyScene& judged : scenes())
    for (const LazyConfig& config : configs()) {
      const auto detector = prepared(config, judged.scene);
      for (std::size_t f = 0; f < judged.truth.size(); ++f) {
        const ContactSet got = answer(*detector, judged.scene.frames[f], Question::kTriangles);
        const ContactSet boolean = answer(*detector, judged.scene.frames[f], Question::kBody);
        EXPECT_EQ(got.triangles, judged.truth[f].triangles)
            << judged.name << " " << f << " " << name_of(config);
        EXPECT_EQ(boolean.bodies, judged.truth[f].bodies)
            << judged.name << " " << f << " " << name_of(config);
        EXPECT_THAT(boolean.triangles, IsEmpty());
      }
    }
}

TEST(LazyDetector, KeepsThePromisesOfItsBounds) {
  for (const JudgedLazyScene& judged : scenes())
    for (const LazyConfig& config : configs()) {
      const auto detector = prepared(config, judged.scene);
      for (const FrameData& data : judged.scene.frames) {
        const Frame frame = data.frame();
        detector->update(frame);
        EXPECT_EQ(detector->validate(data.vertices), "") << judged.name << name_of(config);
      }
    }
}

TEST(LazyDetector, ReportsVerticesThatItsBoundsDoNotHold) {
  const Scene& scene = scenes()[0].scene;
  for (const LazyConfig& config : configs()) {
    const auto detector = prepared(config, scene);
    const Frame frame = scene.frames[0].frame();
    detector->update(frame);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      auto vertices = scene.frames[0].vertices;
      vertices[b][3] += Vec3(0, 5, 0);
      EXPECT_NE(detector->validate(vertices).find("body " + std::to_string(b)), std::string::npos);
    }
  }
}

TEST(LazyDetector, AnswersDoNotDependOnWhatWasAskedBefore) {
  for (const JudgedLazyScene& judged : {scenes()[0], scenes()[1]})
    for (const LazyConfig& config : configs()) {
      const auto detector = prepared(config, judged.scene);
      for (std::size_t f : {2u, 0u, 0u, 1u, 2u, 1u}) {
        const Frame frame = judged.scene.frames[f].frame();
        detector->update(frame);
        ContactSet boolean, first, second;
        if (f != 1) detector->query(Question::kBody, boolean);
        detector->query(Question::kTriangles, first);
        detector->query(Question::kTriangles, second);
        EXPECT_EQ(first.triangles, second.triangles);
        first.canonicalize();
        EXPECT_EQ(first.triangles, judged.truth[f].triangles) << judged.name << name_of(config);
      }
    }
}

TEST(LazyDetector, AnswersDoNotDependOnTheOrderOfTheBodies) {
  for (const JudgedLazyScene& judged : {scenes()[0], scenes()[1]}) {
    Scene turned = judged.scene;
    std::reverse(turned.bodies.begin(), turned.bodies.end());
    const auto last = static_cast<std::uint32_t>(turned.bodies.size() - 1);
    for (const LazyConfig& config : configs()) {
      const auto detector = prepared(config, turned);
      for (std::size_t f = 0; f < judged.truth.size(); ++f) {
        FrameData frame = judged.scene.frames[f];
        std::reverse(frame.nodes.begin(), frame.nodes.end());
        std::reverse(frame.vertices.begin(), frame.vertices.end());
        std::vector<ElementPair> got = answer(*detector, frame, Question::kTriangles).triangles;
        for (ElementPair& p : got) p.body_a = last - p.body_a, p.body_b = last - p.body_b;
        canonicalize(got);
        EXPECT_EQ(got, judged.truth[f].triangles) << judged.name << f << name_of(config);
      }
    }
  }
}

// Three bodies of scene 0 whose pairs are tested in the given order, straight by the kernels.
std::vector<ElementPair> collided(const std::string& isa, const std::vector<BodyPair>& order) {
  const Scene& scene = scenes()[0].scene;
  std::vector<LatticeTree> trees;
  for (const Body& body : scene.bodies) trees.push_back(make_lattice_tree(*body.shape));
  std::vector<LazyState> states(scene.bodies.size());
  for (std::size_t b = 0; b < states.size(); ++b) {
    states[b].shape = scene.bodies[b].shape.get();
    states[b].tree = &trees[b];
    states[b].from_vertices = !states[b].shape->lattice;
    if (states[b].from_vertices) {
      begin_frame_by_vertices(states[b], scene.frames[2].nodes[b]);
    } else {
      begin_frame_by_nodes(states[b], scene.frames[2].nodes[b]);
    }
  }
  LazyScratch scratch;
  place(states);
  for (LazyState& state : states) {
    find_cells(state);
    if (state.from_vertices) lazy_kernels(isa).bound_all(state, scratch.arena);
  }
  std::vector<ElementPair> out;
  for (const BodyPair& pair : order)
    lazy_kernels(isa).collide({pair, states[pair.a], states[pair.b]}, false, scratch, out);
  canonicalize(out);
  return out;
}

TEST(LazyDetector, AnswersDoNotDependOnWhichPairWasAskedFirst) {
  std::vector<BodyPair> order = {{0, 1}, {0, 2}, {1, 2}, {2, 3}, {3, 4}, {0, 4}};
  std::vector<ElementPair> truth;
  for (const ElementPair& p : scenes()[0].truth[2].triangles)
    if (std::count(order.begin(), order.end(), BodyPair{p.body_a, p.body_b})) truth.push_back(p);
  ASSERT_GT(truth.size(), 50u);
  for (const std::string& isa : lazy_isas())
    for (std::size_t turn = 0; turn < order.size(); ++turn) {
      std::rotate(order.begin(), order.begin() + 1, order.end());
      EXPECT_EQ(collided(isa, order), truth) << isa << " " << turn;
    }
}

}  // namespace
}  // namespace contactcheck
