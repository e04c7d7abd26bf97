// ffd-lazy on several threads: the same contacts and the same work as on one.

#include <gtest/gtest.h>

#include <atomic>

#include "core/detect/lazy_detector.h"
#include "tests/core/detect/bare_scenes.h"

namespace contactcheck {
namespace {

using test::make_frame;
using test::rest_nodes_at;
using test::Scene;

constexpr std::size_t kThreads[] = {1, 2, 3, 8};

// Balls in a row, each touching the next; deformed, so that cells bend.
Scene row_of_balls(std::size_t count, int refinements, const Resolution& cells) {
  const Body ball =
      test::make_body("ball", test::sphere_mesh(Vec3::Zero(), 1.0, refinements), cells);
  test::TriangleSource random(801);
  Scene scene;
  scene.bodies.assign(count, ball);
  for (double apart : {1.9, 1.2, 5.0}) {
    std::vector<std::vector<Vec3>> nodes;
    for (std::size_t b = 0; b < count; ++b) {
      nodes.push_back(rest_nodes_at(*ball.shape, Vec3(apart * static_cast<double>(b), 0.1, 0)));
      for (Vec3& n : nodes.back()) n = random.point(n, 0.1);
    }
    scene.frames.push_back(make_frame(scene.bodies, std::move(nodes)));
  }
  return scene;
}

// Two large bodies, whose test is cut into parts; a few of all kinds; more pairs than are cut.
const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all = {row_of_balls(2, 5, {4, 4, 4}),
                                         row_of_balls(6, 3, {3, 3, 3}),
                                         row_of_balls(300, 1, {1, 1, 1})};
  return all;
}

struct Outcome {
  ContactSet triangles, bodies;
  LazyCounters all_pairs;  // of the question for all pairs
};

std::vector<Outcome> outcomes(const Scene& scene, BoundSource bounds, std::size_t threads) {
  LazyDetector detector({bounds, "best", threads});
  detector.prepare(scene.bodies);
  std::vector<Outcome> out;
  for (const test::FrameData& frame : scene.frames) {
    Outcome& one = out.emplace_back();
    detector.update(frame.frame());
    detector.query(Question::kTriangles, one.triangles);
    one.all_pairs = detector.counters();
    detector.query(Question::kBody, one.bodies);
    const std::size_t bodies = one.bodies.bodies.size();
    one.triangles.canonicalize();
    one.bodies.canonicalize();
    EXPECT_EQ(one.bodies.bodies.size(), bodies) << "a pair of bodies named twice";
  }
  return out;
}

TEST(LazyThreads, GiveTheContactsOfOneThread) {
  std::size_t contacts = 0;
  for (std::size_t s = 0; s < scenes().size(); ++s)
    for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kVertices}) {
      const std::vector<Outcome> one = outcomes(scenes()[s], bounds, 1);
      for (std::size_t threads : kThreads) {
        const std::vector<Outcome> many = outcomes(scenes()[s], bounds, threads);
        for (std::size_t f = 0; f < one.size(); ++f) {
          contacts += one[f].triangles.triangles.size();
          EXPECT_EQ(many[f].triangles.triangles, one[f].triangles.triangles)
              << "scene " << s << ", frame " << f << ", " << threads << " threads";
          EXPECT_EQ(many[f].bodies.bodies, one[f].bodies.bodies)
              << "scene " << s << ", frame " << f << ", " << threads << " threads";
        }
      }
    }
  EXPECT_GT(contacts, 10000u);
}

TEST(LazyThreads, DoTheWorkOfOneThread) {
  for (const Scene& scene : scenes()) {
    const std::vector<Outcome> one = outcomes(scene, BoundSource::kNodes, 1);
    for (std::size_t threads : kThreads) {
      const std::vector<Outcome> many = outcomes(scene, BoundSource::kNodes, threads);
      for (std::size_t f = 0; f < one.size(); ++f) {
        const LazyCounters &a = one[f].all_pairs, &b = many[f].all_pairs;
        // Whose block is known already depends on who came first.
        EXPECT_GE(4 * b.blocks_bounded, 3 * a.blocks_bounded);
        EXPECT_LT(3 * b.blocks_bounded, 4 * a.blocks_bounded + 1);
        EXPECT_EQ(a.leaves_mapped, b.leaves_mapped);
        EXPECT_EQ(a.vertices_mapped, b.vertices_mapped);
        EXPECT_EQ(a.block_pairs, b.block_pairs);
        EXPECT_EQ(a.leaf_pairs, b.leaf_pairs);
        EXPECT_EQ(a.triangle_tests, b.triangle_tests);
        EXPECT_EQ(a.filter_failures, b.filter_failures);
      }
    }
  }
}

// Threads race for the same blocks and leaves in every frame: once is no proof.
TEST(LazyThreads, GiveTheSameAgainAndAgain) {
  const Scene& scene = scenes()[0];
  const std::vector<Outcome> one = outcomes(scene, BoundSource::kNodes, 1);
  LazyDetector detector({BoundSource::kNodes, "best", 4});
  detector.prepare(scene.bodies);
  for (int round = 0; round < 50; ++round)
    for (std::size_t f = 0; f < scene.frames.size(); ++f) {
      ContactSet got;
      detector.update(scene.frames[f].frame());
      detector.query(Question::kTriangles, got);
      got.canonicalize();
      ASSERT_EQ(got.triangles, one[f].triangles.triangles) << "round " << round;
      ASSERT_EQ(detector.validate(scene.frames[f].vertices), "") << "round " << round;
    }
}

TEST(LazyThreads, ShareTheWork) {
  ThreadTeam team(3);
  ASSERT_EQ(team.threads(), 3u);
  ASSERT_EQ(team.scratch().size(), 3u);
  std::vector<std::atomic<int>> done(1000);
  team.for_each(done.size(), [&](std::size_t i, LazyScratch& scratch) {
    ++scratch.counters.block_pairs;
    ++done[i];
  });
  std::uint64_t sum = 0;
  for (const LazyScratch& scratch : team.scratch()) sum += scratch.counters.block_pairs;
  EXPECT_EQ(sum, done.size());
  for (const auto& times : done) EXPECT_EQ(times, 1);
}

}  // namespace
}  // namespace contactcheck
