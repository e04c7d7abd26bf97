#include "reference/tune/measuring.h"

#include <gmock/gmock.h>

#include "core/types/check.h"
#include "reference/tune/frame_split.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/installed.h"

namespace contactcheck::tune {
namespace {

using test::Scratch;
using test::sentence_of;
using test::tiny_scene;
using ::testing::HasSubstr;

TEST(LatticeVariant, HasOtherCellsAndTheSameMeshes) {
  const Scratch scratch;
  const auto file = scratch.write("tiny.json", tiny_scene());
  const auto finer_file = write_lattice_variant(file, 8.0, scratch.folder() / "variants");
  const scene::Scene scene = scene::load_scene(file), finer = scene::load_scene(finer_file);
  EXPECT_EQ(finer.id, "tiny-lattice-800");
  EXPECT_GT(finer.bodies[0].shape->lattice->cells.size(),
            2 * scene.bodies[0].shape->lattice->cells.size());
  EXPECT_EQ(content_hash(finer.bodies[1].shape->mesh), content_hash(scene.bodies[1].shape->mesh));
}

// The first body rests; the second is twisted, which lattices of other cells follow otherwise.
TEST(LatticeVariant, DeviatesByWhatTheLatticeMakesOfTheDeformation) {
  const Scratch scratch;
  const auto file = scratch.write("tiny.json", tiny_scene());
  const scene::Scene scene = scene::load_scene(file);
  EXPECT_EQ(deviation(scene, scene::load_scene(file)), 0.0);
  const double by = deviation(
      scene, scene::load_scene(write_lattice_variant(file, 0.04, scratch.folder() / "variants")));
  EXPECT_GT(by, 1e-4);
  EXPECT_LT(by, 0.5);
}

TEST(LatticeVariant, FindsMeshFilesFromItsNewFolder) {
  const Scratch scratch;
  scratch.write("box.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const auto file = scratch.write("mine.json", R"({"id": "mine", "frames": 4, "duration": 1,
    "levels": ["body"], "bodies": [
      {"name": "a", "mesh": {"file": "box.obj"}, "lattice": {"kept": 8}},
      {"name": "b", "mesh": {"file": "box.obj"}, "lattice": {"kept": 8}}]})");
  const scene::Scene variant =
      scene::load_scene(write_lattice_variant(file, 2.0, scratch.folder() / "elsewhere"));
  EXPECT_EQ(variant.bodies[0].shape->mesh.triangles.size(), 4u);
}

TEST(LatticeVariant, RefusesABodyWithoutLattice) {
  const Scratch scratch;
  const auto file = scratch.write("bare.json", R"({"id": "bare", "frames": 4, "duration": 1,
    "levels": ["body"], "bodies": [{"name": "a", "mesh": {"shape": "box"}},
                                   {"name": "b", "mesh": {"shape": "box"}}]})");
  EXPECT_THAT(sentence_of([&] { write_lattice_variant(file, 2.0, scratch.folder() / "x"); }),
              HasSubstr("body \"a\" has no lattice"));
}

TEST(FrameSplit, OfAScriptedSceneSharesTheEndsAlone) {
  const Scratch scratch;
  const auto file = scratch.write("tiny.json", tiny_scene("tiny", "9"));
  const FrameSplit split = split_frames(file, 0, scratch.folder());
  EXPECT_EQ(split.chosen_by.frames, 9u);
  EXPECT_EQ(split.held_out.frames, 8u);
  EXPECT_EQ(split_frames(file, 6, scratch.folder()).chosen_by.frames, 6u);
}

TEST(FrameSplit, RefusesWhatHasTooFewFrames) {
  const Scratch scratch;
  const auto file = scratch.write("tiny.json", tiny_scene("tiny", "3"));
  EXPECT_THAT(sentence_of([&] { split_frames(file, 0, scratch.folder()); }),
              HasSubstr("at least 4 are needed"));
}

}  // namespace
}  // namespace contactcheck::tune
