#include "reference/judge/scene_export.h"

#include <gmock/gmock.h>

#include <limits>

#include "reference/judge/export_folder.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"
#include "tests/support/shapes.h"

namespace contactcheck::judge {
namespace {

/// Two boxes without lattices, recorded for two frames, that touch in the second.
scene::Scene two_boxes() {
  scene::Scene scene;
  scene.id = "boxes";
  for (const char* name : {"still", "../moving"})
    scene.bodies.push_back({name, make_bare_shape(test::unit_box_mesh(1))});
  scene.frames = 2;
  for (double x : {3.0, 1.0}) {
    auto& frame = scene.recorded.emplace_back();
    for (const Body& body : scene.bodies)
      frame.push_back(test::rest_nodes_at(*body.shape, Vec3(frame.empty() ? 0.0 : x, 0, 0)));
  }
  return scene;
}

TEST(SceneExport, CountsWhatItCertifies) {
  const test::Scratch scratch;
  int frames = 0;
  const ExportSummary summary = export_scene(two_boxes(), 1, scratch.folder(), [&] { ++frames; });
  EXPECT_EQ(frames, 2);
  EXPECT_EQ(summary.frames, 2u);
  EXPECT_GT(summary.contacts, 2u);
  EXPECT_NE(summary.contact_hash, 0u);
  EXPECT_TRUE(is_export(scratch.folder()));
}

TEST(SceneExport, NamesOfBodiesStayWithinTheFolder) {
  const test::Scratch scratch;
  export_scene(two_boxes(), 1, scratch.folder(), [] {});
  EXPECT_THAT(test::names_in(scratch.folder() / "bodies"),
              testing::ElementsAre("0-still", "1-___moving"));
}

TEST(SceneExport, RefusesWhatIsNotFiniteAndIsNotWhole) {
  const test::Scratch scratch;
  scene::Scene scene = two_boxes();
  scene.recorded[1][1][6].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(test::sentence_of([&] { export_scene(scene, 1, scratch.folder(), [] {}); }),
            "scene \"boxes\", frame 1, body \"../moving\": node 6 is not finite");
  EXPECT_FALSE(is_export(scratch.folder()));
}

TEST(SceneExport, IsToldFromOtherFolders) {
  const test::Scratch scratch;
  EXPECT_FALSE(is_export(scratch.folder()));
  for (const char* text : {"[1]", "{", R"({"schema": "contactcheck-results/2"})"}) {
    scratch.write("scene.json", text);
    EXPECT_FALSE(is_export(scratch.folder())) << text;
  }
  scratch.write("scene.json", R"({"schema": "contactcheck-certificates/1"})");
  EXPECT_TRUE(is_export(scratch.folder()));
}

// What other programs read: header, then 8 vertices of 24 bytes and 12 faces of 13.
TEST(SceneExport, SurfacesAreOrdinaryPlyFiles) {
  const test::Scratch scratch;
  export_scene(two_boxes(), 1, scratch.folder(), [] {});
  const std::string ply = test::text_of(scratch.folder() / "bodies/0-still/frame_0001.ply");
  const std::string end = "\nend_header\n";
  EXPECT_THAT(ply, testing::StartsWith("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_EQ(ply.size(), ply.find(end) + end.size() + 8 * 24 + 12 * 13);
}

}  // namespace
}  // namespace contactcheck::judge
