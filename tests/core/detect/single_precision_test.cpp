// The FFD-AABB family in single precision about the local origin of each frame.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/detect/ffd_detector.h"
#include "core/types/check.h"
#include "tests/core/detect/safe_config.h"
#include "tests/core/detect/single_scenes.h"

namespace contactcheck {
namespace {

using test::safe_config;
using test::Scene;
using SingleDetector = FfdDetectorOf<float>;

const std::string kSingle = ":precision=single";

std::vector<FfdConfig> safe_configs() {
  return {safe_config(CellVolume::kLatticeCell, 0), safe_config(CellVolume::kFfdAabb, 0),
          safe_config(CellVolume::kFfdAabb, 1), safe_config(CellVolume::kFfdAabb, 3)};
}

TEST(SinglePrecision, DeclaresWhatItIs) {
  for (const std::string& name : test::family_with_triangles()) {
    const auto detector = test::prepared(name + kSingle, test::exact_boxes(Vec3::Zero()));
    const Semantics& s = detector->semantics();
    EXPECT_EQ(s.precision, Precision::kSingle) << name;
    EXPECT_TRUE(s.local_origin) << name;
    EXPECT_EQ(s.scale, 1.0) << name;
    EXPECT_FALSE(s.exact) << name;
    EXPECT_FALSE(detector->needs_vertices()) << name;
  }
  EXPECT_TRUE(test::prepared("ffd-aabb+tri:precision=double", test::exact_boxes(Vec3::Zero()))
                  ->semantics()
                  .exact);
}

// The bounds of the safe reading, in floats, lose nothing of what they bound.
TEST(SinglePrecision, SafeFindsWhatItsOwnVerticesDo) {
  std::uint64_t seed = 700;
  for (double strength : {0.0, 0.4, 5.0})
    for (double scale : {1e-6, 1.0, 1e6})
      for (double offset : {0.0, 1e9}) {
        const Scene scene = test::approach({++seed, strength, scale, Vec3(offset, 0, -offset)}, 3);
        std::vector<std::vector<ElementPair>> expected;
        for (const test::FrameData& frame : scene.frames)
          expected.push_back(
              test::meeting_pairs(scene.bodies, test::mapped_in_floats(scene.bodies, frame)));
        for (const FfdConfig& config : safe_configs()) {
          SingleDetector detector(config);
          detector.prepare(scene.bodies);
          for (std::size_t f = 0; f < expected.size(); ++f)
            EXPECT_EQ(test::answer(detector, scene.frames[f]).triangles, expected[f])
                << strength << " " << scale << " " << offset;
        }
      }
}

TEST(SinglePrecision, SafeBoundsHoldTheVerticesItMaps) {
  std::uint64_t seed = 800;
  for (double strength : {0.0, 0.3, 2.0, 50.0})
    for (double scale : {1e-30, 1e-9, 1.0, 1e9}) {
      const Scene scene = test::approach({++seed, strength, scale, Vec3::Constant(10 * scale)}, 2);
      for (const FfdConfig& config : safe_configs()) {
        SingleDetector detector(config);
        detector.prepare(scene.bodies);
        for (const test::FrameData& data : scene.frames) {
          const Frame frame = data.frame();
          detector.update(frame);
          const test::FloatVertices own = test::mapped_in_floats(scene.bodies, data);
          for (std::size_t b = 0; b < scene.bodies.size(); ++b)
            EXPECT_EQ(validate(detector.models()[b], detector.states()[b], own[b]), "")
                << strength << " " << scale;
        }
      }
    }
}

TEST(SinglePrecision, SmallerBoundsAreReported) {
  const Scene scene = test::approach({850, 0.3}, 1);
  const test::FloatVertices own = test::mapped_in_floats(scene.bodies, scene.frames[0]);
  FfdConfig config = safe_config(CellVolume::kFfdAabb, 1);
  SingleDetector detector(config);
  detector.prepare(scene.bodies);
  detector.update(scene.frames[0].frame());
  auto state = detector.states()[0];
  for (auto& box : state.cell_box) box = test::shrunk(box, 0.99f);
  EXPECT_NE(validate(detector.models()[0], state, own[0]), "");
}

// No triangles of these scenes come within rounding of touching.
TEST(SinglePrecision, SaysWhatDoublesSayWhereNothingIsClose) {
  std::size_t pairs = 0;
  for (std::uint64_t seed : {901, 902, 903, 904}) {
    const Scene scene = test::approach({seed, 0.4});
    for (const std::string& name : test::family()) {
      const auto plain = test::prepared(name, scene),
                 single = test::prepared(name + kSingle, scene);
      for (const test::FrameData& frame : scene.frames)
        EXPECT_EQ(test::answer(*single, frame).cells, test::answer(*plain, frame).cells)
            << name << " " << seed;
    }
    for (const std::string& name : test::family_with_triangles()) {
      const auto single = test::prepared(name + kSingle, scene);
      for (const test::FrameData& frame : scene.frames) {
        const std::vector<ElementPair> truth = test::true_pairs(scene, frame);
        EXPECT_EQ(test::answer(*single, frame).triangles, truth) << name << " " << seed;
        EXPECT_EQ(test::answer(*single, frame, Question::kBody).bodies.empty(), truth.empty());
        pairs += truth.size();
      }
    }
  }
  EXPECT_GT(pairs, 1000u);
}

// The truth for vertices rounded to floats where they are, without a local origin.
std::vector<ElementPair> pairs_of_plain_floats(const Scene& scene, test::FrameData frame) {
  for (std::vector<Vec3>& body : frame.vertices)
    for (Vec3& v : body)
      for (int k = 0; k < 3; ++k) {
        const volatile float rounded = static_cast<float>(v[k]);
        v[k] = rounded;
      }
  return test::true_pairs(scene, frame);
}

// A thousand kilometres out a float moves in steps of 6 cm; the bodies are 2 m wide.
TEST(SinglePrecision, KeepsItsDigitsFarFromTheOrigin) {
  const Scene scene = test::approach({911, 0.4, 1.0, Vec3(1e6, -1e6, 1e6)});
  const auto single = test::prepared("ffd-aabb-sphere2+tri" + kSingle, scene);
  const auto cells = test::prepared("ffd-aabb-sphere2", scene),
             single_cells = test::prepared("ffd-aabb-sphere2" + kSingle, scene);
  bool plain_floats_differ = false;
  for (const test::FrameData& frame : scene.frames) {
    const std::vector<ElementPair> truth = test::true_pairs(scene, frame);
    EXPECT_EQ(test::answer(*single, frame).triangles, truth);
    EXPECT_EQ(test::answer(*single_cells, frame).cells, test::answer(*cells, frame).cells);
    plain_floats_differ = plain_floats_differ || pairs_of_plain_floats(scene, frame) != truth;
  }
  EXPECT_TRUE(plain_floats_differ) << "the scene shows nothing";
}

TEST(SinglePrecision, RefusesWhatIsTooFarApartAndNothingElse) {
  for (double scale : {1e13, 1e150, 1e300}) {
    const Scene scene = test::approach({921, 0.4, scale}, 1);
    for (const char* name :
         {"ffd-grid:precision=single", "ffd-aabb-sphere2+tri:precision=single"}) {
      const auto detector = test::prepared(name, scene);
      EXPECT_THROW(detector->update(scene.frames[0].frame()), RefusedInput) << name << scale;
    }
  }
  const Scene wide = test::approach({922, 0.4, 1e11}, 6);
  const auto detector = test::prepared("ffd-aabb-sphere2+tri:precision=single", wide);
  for (const test::FrameData& frame : wide.frames)
    EXPECT_EQ(test::answer(*detector, frame).triangles, test::true_pairs(wide, frame));
}

// Below the range of floats all is one point, and points that coincide are in contact.
TEST(SinglePrecision, OfWhatIsTooSmallForItMakesOnePoint) {
  const Scene scene = test::approach({931, 0.4, 1e-60}, 2);
  for (const std::string& name : test::family_with_triangles()) {
    const auto detector = test::prepared(name + kSingle, scene);
    const std::size_t all =
        scene.bodies[0].shape->mesh.triangles.size() * scene.bodies[1].shape->mesh.triangles.size();
    EXPECT_EQ(test::answer(*detector, scene.frames[0]).triangles.size(), all) << name;
  }
}

// At rest beyond the range of floats, now of usual size: radii and grid cells of rest are infinite.
TEST(SinglePrecision, IsUsableWhateverTheSizeAtRest) {
  for (double at_rest : {1e-300, 1e300}) {
    Scene scene = test::approach({941, 0.0, at_rest}, 6);
    for (test::FrameData& frame : scene.frames) {
      auto nodes = frame.nodes;
      for (std::vector<Vec3>& body : nodes)
        for (Vec3& n : body) n /= at_rest;
      frame = test::make_frame(scene.bodies, std::move(nodes));
    }
    for (const char* bounds : {"safe", "paper"}) {
      const auto detector = test::prepared(
          "ffd-aabb-sphere2+tri:precision=single,bounds=" + std::string(bounds), scene);
      for (const test::FrameData& frame : scene.frames) {
        const std::vector<ElementPair> found = test::answer(*detector, frame).triangles;
        if (std::string(bounds) == "safe") {
          EXPECT_EQ(found, test::true_pairs(scene, frame)) << at_rest;
        }
      }
    }
  }
}

}  // namespace
}  // namespace contactcheck
