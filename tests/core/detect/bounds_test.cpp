// What the safe reading promises: every bound holds its triangles, whatever the deformation.

#include <gtest/gtest.h>

#include "core/detect/ffd_detector.h"
#include "tests/core/detect/safe_config.h"
#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::safe_config;
using test::Scene;

std::vector<FfdConfig> safe_configs() {
  return {safe_config(CellVolume::kLatticeCell, 0), safe_config(CellVolume::kFfdAabb, 1),
          safe_config(CellVolume::kFfdAabb, 3)};
}

// Sentences of all broken promises over the frames and bodies of a scene, with the boxes of cells
// shrunk to a share of their size.
std::vector<std::string> broken(const Scene& scene, const FfdConfig& config, double share = 1.0) {
  FfdDetector detector(config);
  detector.prepare(scene.bodies);
  std::vector<std::string> out;
  for (const test::FrameData& data : scene.frames) {
    const Frame frame = data.frame();
    detector.update(frame);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      FfdState state = detector.states()[b];
      for (Aabb& box : state.cell_box) box = test::shrunk(box, share);
      const std::string text = validate(detector.models()[b], state, data.vertices[b]);
      if (!text.empty()) out.push_back(text);
    }
  }
  return out;
}

TEST(SafeBounds, HoldTheirTrianglesUnderStrongDeformation) {
  std::uint64_t seed = 400;
  for (double strength : {0.0, 0.3, 2.0, 50.0})  // from 0.5 on, cells are turned inside out
    for (double scale : {1e-9, 1.0, 1e200})
      for (double offset : {0.0, 1e6, -1e12}) {
        const Scene scene =
            test::approach({++seed, strength, scale, Vec3(offset, -offset, 0.5 * offset)}, 2);
        for (const FfdConfig& config : safe_configs())
          EXPECT_TRUE(broken(scene, config).empty()) << strength << " " << scale << " " << offset;
      }
}

TEST(SafeBounds, HoldWhenTheLatticeIsFlattenedOrCollapsed) {
  Scene scene = test::approach({450, 0.3}, 2);
  for (double squeeze : {0.0, 0x1p-1060}) {
    for (test::FrameData& frame : scene.frames) {
      auto nodes = frame.nodes;
      for (Vec3& n : nodes[0]) n.z() *= squeeze;
      for (Vec3& n : nodes[1]) n *= squeeze;
      frame = test::make_frame(scene.bodies, std::move(nodes));
    }
    for (const FfdConfig& config : safe_configs()) EXPECT_TRUE(broken(scene, config).empty());
  }
}

TEST(SafeBounds, ShrunkByOnePercentAreReported) {
  const Scene scene = test::approach({460, 0.3}, 3);
  for (const FfdConfig& config : safe_configs()) {
    // A lattice cell's box is no tight bound of the vertices in it: more must go.
    const auto sentences =
        broken(scene, config, config.volume == CellVolume::kFfdAabb ? 0.99 : 0.5);
    EXPECT_GE(sentences.size(), 4u);
    for (const std::string& text : sentences) EXPECT_NE(text.find("owner's box"), text.npos);
  }
}

TEST(SafeBounds, AreTight) {
  // At rest, a box of vertices reaches farther than the vertices only by rounding.
  const Scene scene = test::exact_boxes(Vec3::Zero());
  FfdDetector detector(safe_config(CellVolume::kFfdAabb, 1));
  detector.prepare(scene.bodies);
  const Frame frame = scene.frames[0].frame();
  detector.update(frame);
  const FfdModel& model = detector.models()[0];
  const FfdState& state = detector.states()[0];
  for (std::uint32_t cell : model.cells) {
    Aabb triangles;
    for (std::uint32_t t : model.triangles.row(cell))
      for (std::uint32_t v : scene.bodies[0].shape->mesh.triangles[t])
        triangles.extend(scene.frames[0].vertices[0][v]);
    EXPECT_TRUE(state.cell_box[cell].contains(triangles));
    EXPECT_LT((state.cell_box[cell].extent() - triangles.extent()).maxCoeff(), 1e-13);
  }
  EXPECT_NEAR(state.spheres[0][0].radius, std::sqrt(3.0), 1e-13);
}

TEST(SafeModel, EveryTriangleHasOneOwner) {
  const Scene scene = test::approach({470, 0.0}, 1);
  for (const Body& body : scene.bodies) {
    const FfdModel model = make_ffd_model(*body.shape, safe_config(CellVolume::kFfdAabb, 0));
    std::vector<int> owned(body.shape->mesh.triangles.size(), 0);
    for (std::uint32_t cell : model.cells) {
      EXPECT_FALSE(model.pieces_of(cell).empty());
      for (std::uint32_t t : model.triangles.row(cell)) {
        EXPECT_EQ(model.owner[t], cell);
        ++owned[t];
      }
    }
    for (int count : owned) EXPECT_EQ(count, 1);
  }
}

}  // namespace
}  // namespace contactcheck
