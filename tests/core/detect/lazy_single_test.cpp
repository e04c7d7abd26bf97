// ffd-lazy and full-refit in single precision: they find exactly the pairs of triangles that
// intersect among the vertices in floats, on every instruction set and number of threads, wherever
// their bounds come from.

#include <gmock/gmock.h>

#include <algorithm>

#include "core/detect/lazy_detector.h"
#include "core/types/check.h"
#include "tests/core/detect/single_scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::FrameData;
using test::Scene;
using test::SingleScene;

constexpr Precision kFloats = Precision::kSingle;

LazyConfig config_of(BoundSource bounds, const std::string& isa = "best", std::size_t threads = 1) {
  return {bounds, isa, threads, kFloats};
}

std::vector<LazyConfig> single_configs() {
  std::vector<LazyConfig> all;
  for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kVertices, BoundSource::kCheaper})
    for (const std::string& isa : lazy_isas()) all.push_back(config_of(bounds, isa));
  return all;
}

std::string name_of_single(const LazyConfig& config) {
  return config.isa + " " + std::to_string(static_cast<int>(config.bounds)) + " " +
         std::to_string(config.threads);
}

std::unique_ptr<LazyDetector> prepared_single(const LazyConfig& config, const Scene& scene) {
  auto detector = std::make_unique<LazyDetector>(config);
  detector->prepare(scene.bodies);
  return detector;
}

TEST(LazySingleScenes, HaveContact) {
  for (const SingleScene& scene : test::single_scenes()) {
    std::size_t most = 0;
    for (const auto& pairs : scene.mapped) most = std::max(most, pairs.size());
    EXPECT_GT(most, 20u) << scene.name;
    most = 0;
    for (const auto& pairs : scene.fed) most = std::max(most, pairs.size());
    EXPECT_GT(most, 20u) << scene.name << ", of the vertices that are fed";
  }
}

TEST(LazySingle, FindsWhatIntersectsForEverySourceAndInstructionSet) {
  for (const SingleScene& single : test::single_scenes())
    for (const LazyConfig& config : single_configs()) {
      SCOPED_TRACE(name_of_single(config));
      test::expect_pairs(*prepared_single(config, single.scene), single, single.mapped);
    }
}

TEST(LazySingle, FindsTheSameOnEveryNumberOfThreads) {
  for (const SingleScene& single : test::single_scenes())
    for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kVertices})
      for (std::size_t threads : {2u, 3u, 8u}) {
        const LazyConfig config = config_of(bounds, "best", threads);
        const auto detector = prepared_single(config, single.scene);
        for (std::size_t f = 0; f < single.mapped.size(); ++f)
          EXPECT_EQ(answer(*detector, single.scene.frames[f], Question::kTriangles).triangles,
                    single.mapped[f])
              << single.name << " " << f << " " << name_of_single(config);
      }
}

TEST(LazySingle, KeepsThePromisesOfItsBounds) {
  for (const SingleScene& single : test::single_scenes())
    for (const LazyConfig& config : single_configs()) {
      const auto detector = prepared_single(config, single.scene);
      for (const FrameData& data : single.scene.frames) {
        detector->update(data.frame());
        EXPECT_EQ(detector->validate(data.vertices), "") << single.name << name_of_single(config);
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
    const auto detector = prepared_single(config_of(BoundSource::kNodes), scene);
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
    for (const LazyConfig& config : single_configs()) {
      const auto detector = prepared_single(config, scene);
      for (const FrameData& frame : scene.frames)
        EXPECT_EQ(answer(*detector, frame, Question::kTriangles).triangles,
                  test::true_pairs(scene, frame))
            << shift.transpose() << " " << name_of_single(config);
    }
  }
}

TEST(LazySingle, SaysWhatItIs) {
  for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kVertices, BoundSource::kCheaper}) {
    const LazyDetector detector(config_of(bounds));
    EXPECT_EQ(detector.semantics().precision, kFloats);
    EXPECT_TRUE(detector.semantics().local_origin);
    EXPECT_FALSE(detector.semantics().exact);
    EXPECT_TRUE(detector.semantics().closed);
    EXPECT_FALSE(detector.needs_vertices());
  }
  EXPECT_TRUE(LazyDetector({}).semantics().exact);
}

TEST(LazySingle, CountsWhatDoublesCount) {
  const auto names = [](LazyDetector& detector) {
    std::vector<std::string> out;
    for (const Count& count : detector.counts()) out.emplace_back(count.name);
    return out;
  };
  LazyDetector doubles{LazyConfig{}}, floats{config_of(BoundSource::kCheaper)};
  EXPECT_EQ(names(floats), names(doubles));
}

TEST(LazySingle, RefusesWhatIsBeyondTheLimitAndAnswersTheNextFrame) {
  const Scene scene = test::approach({910, 0.3}, 4);
  for (const LazyConfig& config : single_configs()) {
    const auto detector = prepared_single(config, scene);
    FrameData far = scene.frames[3];
    for (Vec3& n : far.nodes[1]) n.x() += 5e12;
    EXPECT_THROW(detector->update(far.frame()), RefusedInput);
    far.nodes[1][0].x() = 1e308;
    EXPECT_THROW(detector->update(far.frame()), RefusedInput);
    EXPECT_EQ(
        answer(*detector, scene.frames[3], Question::kTriangles).triangles,
        test::meeting_pairs(scene.bodies, test::mapped_in_floats(scene.bodies, scene.frames[3])));
  }
}

}  // namespace
}  // namespace contactcheck
