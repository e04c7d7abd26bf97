// Scenes with recorded bodies: what they give, and what is refused.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "core/deform/recording.h"
#include "reference/scene/scene.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/cache_bytes.h"
#include "tests/support/mesh_text.h"
#include "tests/support/shapes.h"

namespace contactcheck::scene {
namespace {

using test::CacheSamples;
using test::sentence_of;
using testing::ElementsAre;
using testing::HasSubstr;

// A box that sways: exact in floats.
std::vector<Vec3> swaying(std::size_t frame) {
  std::vector<Vec3> out = test::unit_box_mesh(1).vertices;
  for (Vec3& v : out) v.x() += 0.25 * static_cast<double>(frame) * v.y();
  return out;
}

class RecordedScene : public testing::Test {
 protected:
  RecordedScene() {
    TriangleMesh mesh = test::unit_box_mesh(1);
    CacheSamples samples;
    for (std::size_t f = 0; f < 5; ++f) {
      mesh.vertices = swaying(f);
      samples.push_back(mesh.vertices);
      scratch_.write("box_0" + std::to_string(f + 5) + ".obj", test::obj_text(mesh));
    }
    scratch_.write("rest.obj", test::obj_text(test::unit_box_mesh(1)));
    scratch_.write("box.pc2", test::pc2_bytes(samples));
    scratch_.write("box.mdd", test::mdd_bytes(samples));
  }

  static std::string text(const std::string& body, const std::string& head = R"("frames": 5)") {
    return R"({"id": "s", )" + head + R"(, "duration": 1, "levels": ["triangle"],
  "bodies": [{"name": "box", )" +
           body + R"(}, {"name": "other", "mesh": {"shape": "box"}, "lattice": {"cells": [1, 1, 1]},
   "motion": {"position": [[0, [3, 0, 0]], [1, [0.5, 0, 0]]]}}]})";
  }
  Scene load(const std::string& body, const std::string& head = R"("frames": 5)",
             std::size_t frames = 0) const {
    return load_scene(scratch_.write("s.json", text(body, head)), frames);
  }
  std::string sentence(const std::string& body, const std::string& head = R"("frames": 5)") const {
    return sentence_of([&] { load(body, head); });
  }

  const test::Scratch scratch_;
};

const std::string kFiles = R"("recording": {"frames": "box_%02d.obj", "first": 5})";
const std::string kListed =
    R"("recording": {"files": ["box_05.obj", "./box_06.obj", "box_07.obj", "box_08.obj", "box_09.obj"]})";
const std::string kPc2Body = R"("mesh": {"file": "rest.obj"}, "recording": {"cache": "box.pc2"})";

// "./" before a name that is a number alone is no part of the name.
TEST_F(RecordedScene, NamesOfNumbersAloneStandInTheScenesFolder) {
  TriangleMesh mesh = test::unit_box_mesh(1);
  for (std::size_t f = 0; f < 2; ++f) {
    mesh.vertices = swaying(f);
    scratch_.write("000" + std::to_string(f) + ".obj", test::obj_text(mesh));
  }
  const std::string body = R"("recording": {"frames": "./%04d.obj"})";
  EXPECT_EQ(load(body, R"("frames": 2)").nodes_of_frame(1)[0], swaying(1));
}

TEST_F(RecordedScene, HasTheFramesOfTheFilesAndTheScriptedBodiesBesideThem) {
  for (const std::string& body :
       {kFiles, kListed, kPc2Body,
        std::string(R"("mesh": {"file": "rest.obj"}, "recording": {"cache": "box.mdd"})")}) {
    SCOPED_TRACE(body);
    const Scene scene = load(body);
    EXPECT_FALSE(scene.scripted());
    EXPECT_FALSE(scene.bodies[0].shape->lattice);
    EXPECT_TRUE(scene.fits.empty());
    ASSERT_EQ(scene.frames, 5u);
    for (std::size_t f = 0; f < 5; ++f) EXPECT_EQ(scene.nodes_of_frame(f)[0], swaying(f)) << f;
    EXPECT_EQ(scene.bodies[1].shape->mesh.vertices.front().x(), -0.5);
    EXPECT_DOUBLE_EQ(scene.nodes_of_frame(4)[1].front().x(), 1.0 - 0.52);  // 3 - 2.5 * 0.8
  }
}

// Split by itself, the dart of the second frame would be cut along its other diagonal.
TEST_F(RecordedScene, QuadsThatDeformKeepTheTrianglesOfTheFirstFrame) {
  const auto quad = [](const std::string& third) {
    return "v 0 0 0\nv 1 0 0\nv " + third + " 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n";
  };
  scratch_.write("q0.obj", quad("1 1"));
  scratch_.write("q1.obj", quad("0.2 0.2"));
  scratch_.write("q2.obj", quad("0.5 -0.5"));
  const Scene scene = load(R"("recording": {"frames": "q%d.obj"})", R"("frames": 3)");
  EXPECT_EQ(scene.bodies[0].shape->mesh.triangles,
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}}));
  EXPECT_EQ(scene.nodes_of_frame(1)[0][2], Vec3(0.2, 0.2, 0.0));
  scratch_.write("q1.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 5 4\nf 1 2 3\n");
  EXPECT_THAT(sentence(R"("recording": {"frames": "q%d.obj"})", R"("frames": 3)"),
              HasSubstr("has other triangles than the body's mesh"));
}

TEST_F(RecordedScene, FirstAndStepChooseAmongTheSamples) {
  const Scene files =
      load(R"("recording": {"frames": "box_%02d.obj", "first": 6, "step": 2})", R"("frames": 2)");
  const Scene cache = load(R"("mesh": {"file": "rest.obj"},
    "recording": {"cache": "box.pc2", "first": 1, "step": 2})",
                           R"("frames": 2)");
  EXPECT_EQ(files.nodes_of_frame(1)[0], swaying(3));
  EXPECT_EQ(cache.nodes_of_frame(1)[0], swaying(3));
  // Without a mesh of its own the body rests as in its first frame.
  EXPECT_EQ(files.bodies[0].shape->mesh.vertices, swaying(1));
}

TEST_F(RecordedScene, WithoutANumberOfFramesHasAllThereAre) {
  EXPECT_EQ(load(kFiles, R"("title": "t")").frames, 5u);
  const Scene three = load(R"("mesh": {"file": "rest.obj"},
    "recording": {"cache": "box.mdd", "step": 2})",
                           R"("title": "t")");
  EXPECT_EQ(three.frames, 3u);
  EXPECT_DOUBLE_EQ(three.time_step, 1.0 / 3.0);
}

TEST_F(RecordedScene, ScaleAndTranslateHoldForTheMeshAndForEveryFrame) {
  const Scene scene = load(R"("mesh": {"file": "rest.obj"},
    "recording": {"cache": "box.pc2", "scale": 2, "translate": [1, 0, -1]})");
  const auto placed = [](std::vector<Vec3> vertices) {
    for (Vec3& v : vertices) v = 2.0 * v + Vec3(1, 0, -1);
    return vertices;
  };
  EXPECT_EQ(scene.bodies[0].shape->mesh.vertices, placed(test::unit_box_mesh(1).vertices));
  EXPECT_EQ(scene.nodes_of_frame(3)[0], placed(swaying(3)));
}

TEST_F(RecordedScene, IsReplayedFromARecordingOfItself) {
  const Scene scene = load(kFiles);
  write_recording(scratch_.folder() / "s.ccr",
                  {scene.id, scene.bodies, scene.time_step, scene.recorded});
  EXPECT_EQ(load_recording(scratch_.folder() / "s.ccr").recorded, scene.recorded);
}

TEST_F(RecordedScene, AGapInTheNumbersIsNoEnd) {
  for (const char* name : {"g_0000.obj", "g_0001.obj", "g_0003.obj", "g_0007.obj"})
    scratch_.write(name, test::obj_text(test::unit_box_mesh(1)));
  const std::string whole = R"("recording": {"frames": "g_%04d.obj"})", any = R"("title": "t")";
  const auto in_folder = [&](const char* name) {
    return '"' + (scratch_.folder() / name).string() + '"';
  };
  EXPECT_THAT(sentence(whole, any),
              HasSubstr("bodies[0].recording has a gap: there is no file " +
                        in_folder("g_0002.obj") + ", but there is " + in_folder("g_0003.obj")));
  EXPECT_THAT(sentence(whole, R"("frames": 8)"), HasSubstr("has a gap: there is no file"));
  // What is not asked for does not matter, nor do other names.
  EXPECT_EQ(load(whole, R"("frames": 2)").frames, 2u);
  const std::string odd = R"("recording": {"frames": "g_%04d.obj", "first": 1, "step": 2})";
  EXPECT_THAT(sentence(odd, any),
              HasSubstr(in_folder("g_0005.obj") + ", but there is " + in_folder("g_0007.obj")));
  for (const char* name :
       {"g_9.obj", "g_0009.objx", "g_+009.obj", "xg_0009.obj", "g_00091.obj.bak"})
    scratch_.write(name, "");
  std::filesystem::remove(scratch_.folder() / "g_0003.obj");
  std::filesystem::remove(scratch_.folder() / "g_0007.obj");
  EXPECT_EQ(load(whole, any).frames, 2u);
}

TEST_F(RecordedScene, AGapInNumberedFoldersIsNoEnd) {
  for (const char* name : {"f_0/m.obj", "f_1/m.obj", "f_3/other.obj", "f_4/m.obj"})
    scratch_.write(name, test::obj_text(test::unit_box_mesh(1)));
  const std::string whole = R"("recording": {"frames": "f_%d/m.obj"})", any = R"("title": "t")";
  const auto in_folder = [&](const char* name) {
    return '"' + (scratch_.folder() / name).string() + '"';
  };
  EXPECT_THAT(sentence(whole, any),
              HasSubstr("bodies[0].recording has a gap: there is no file " +
                        in_folder("f_2/m.obj") + ", but there is " + in_folder("f_4/m.obj")));
  EXPECT_EQ(load(whole, R"("frames": 2)").frames, 2u);
  // Folders deeper down, and one whose name ends behind the number.
  for (const char* name : {"a/7_x/b/m.obj", "a/9_x/b/m.obj"})
    scratch_.write(name, test::obj_text(test::unit_box_mesh(1)));
  EXPECT_THAT(
      sentence(R"("recording": {"frames": "a/%d_x/b/m.obj", "first": 7})", any),
      HasSubstr(in_folder("a/8_x/b/m.obj") + ", but there is " + in_folder("a/9_x/b/m.obj")));
  std::filesystem::remove(scratch_.folder() / "f_4/m.obj");
  EXPECT_EQ(load(whole, any).frames, 2u);
}

// What has a frame's name is that frame: a lost file's link, a folder, a pipe that nobody writes
// to.
TEST_F(RecordedScene, AFrameThatIsNoFileIsNoEnd) {
  for (const char* name : {"p_0.obj", "p_1.obj", "p_3.obj"})
    scratch_.write(name, test::obj_text(test::unit_box_mesh(1)));
  const std::string file = (scratch_.folder() / "p_2.obj").string(),
                    whole = R"("recording": {"frames": "p_%d.obj"})", any = R"("title": "t")",
                    begin = "bodies[0].recording frame 2 (\"" + file +
                            "\") cannot be read: mesh file \"" + file + '"';
  std::filesystem::create_directory(file);
  EXPECT_THAT(sentence(whole, any), HasSubstr(begin + " is a folder, not a regular file."));
  std::filesystem::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_THAT(sentence(whole, any), HasSubstr(begin + " is a pipe, not a regular file."));
  EXPECT_EQ(load(whole, R"("frames": 2)").frames, 2u);
  std::filesystem::remove(file);
  std::filesystem::create_symlink("nowhere", file);
  EXPECT_THAT(sentence(whole, any), HasSubstr(begin + " does not exist."));
}

struct WrongRecording {
  std::string body, head, sentence;
};

TEST_F(RecordedScene, RefusesWhatDoesNotFit) {
  TriangleMesh other = test::unit_box_mesh(2);
  scratch_.write("other_0.obj", test::obj_text(test::unit_box_mesh(1)));
  scratch_.write("other_1.obj", test::obj_text(other));
  TriangleMesh turned = test::unit_box_mesh(1);
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  scratch_.write("turned_0.obj", test::obj_text(test::unit_box_mesh(1)));
  scratch_.write("turned_1.obj", test::obj_text(turned));
  scratch_.write("nan_0.obj", test::obj_text(test::unit_box_mesh(1)));
  scratch_.write("nan_1.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  scratch_.write("finer.obj", test::obj_text(other));
  // Its coordinates are finite, and the products of a fit are not.
  scratch_.write("far_0.obj",
                 "v 0 0 1e308\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 3 1 4\n");
  const std::string five = R"("frames": 5)", two = R"("frames": 2)";
  const std::vector<WrongRecording> wrong = {
      {R"("recording": {"frames": "other_%d.obj"})", two,
       "bodies[0].recording frame 1 (\"DIR/other_1.obj\") has 26 vertices and 48 triangles, the "
       "body's mesh has 8 vertices and 12 triangles."},
      {R"("recording": {"frames": "turned_%d.obj"})", two,
       "frame 1 (\"DIR/turned_1.obj\") has other triangles than the body's mesh: triangle 3 is ("},
      {R"("recording": {"frames": "nan_%d.obj"})", two,
       "frame 1 (\"DIR/nan_1.obj\") cannot be read: mesh file \"DIR/nan_1.obj\": vertex 0 (line "
       "1) has the coordinate \"nan\""},
      {R"("recording": {"frames": "gone_%d.obj"})", two,
       "bodies[0].recording frame 0 (\"DIR/gone_0.obj\") cannot be read: mesh file "
       "\"DIR/gone_0.obj\" does not exist."},
      {kFiles, R"("frames": 6)",
       "frames is 6; it must be at most 5, as many as the recording of body \"box\" has."},
      {R"("mesh": {"file": "finer.obj"}, "recording": {"cache": "box.pc2"})", five,
       "bodies[0].recording.cache has 8 points, the body's mesh has 26 vertices."},
      {R"("recording": {"cache": "box.pc2"})", five, "bodies[0].mesh is missing."},
      {R"("mesh": {"file": "rest.obj"}, "recording": {"cache": "rest.obj"})", five,
       "bodies[0].recording cannot be read: point cache \"DIR/rest.obj\" is neither .pc2 nor "
       ".mdd."},
      {R"("mesh": {"file": "rest.obj"}, "recording": {"cache": "box.pc2", "first": 5})", five,
       "bodies[0].recording.first is 5; it must be below 5, the number of samples."},
      {R"("recording": {"files": ["box_05.obj", "box_06.obj"], "first": 2})", five,
       "bodies[0].recording.first is 2; it must be below 2, the number of files."},
      {R"("recording": {"files": []})", five, "bodies[0].recording.files is an array of 0"},
      {R"("recording": {"files": ["box_05.obj", "gone.obj"]})", two,
       "frame 1 (\"DIR/gone.obj\") cannot be read: mesh file \"DIR/gone.obj\" does not exist."},
      {R"("recording": {"files": ["box_05.obj"], "frames": "box_%02d.obj"})", two,
       "bodies[0].recording has"},
      {R"("recording": {"files": ["box_05.obj"], "space": "mesh"})", two,
       "bodies[0].recording.space is of a \"cache\"."},
      {R"("mesh": {"file": "rest.obj"}, "recording": {"cache": "box.pc2", "space": "world"})", five,
       "bodies[0].recording.space is \"world\"; it must be one of file, mesh"},
      {R"("mesh": {"file": "rest.obj"}, "recording": {})", five,
       "bodies[0].recording has none of the keys frames, files, cache; exactly one is needed."},
      {R"("recording": {"frames": "box.obj"})", five,
       "bodies[0].recording.frames is \"box.obj\"; it must be the name of numbered files with one "
       "number in it, as %d or %04d."},
      {R"("recording": {"frames": "box_%d_%d.obj"})", five, "it must be the name of numbered"},
      {R"("recording": {"frames": "box_%s.obj"})", five, "it must be the name of numbered"},
      {R"("recording": {"frames": "box_%"})", five, "it must be the name of numbered"},
      {R"("recording": {"frames": "box_%0d.obj"})", five, "it must be the name of numbered"},
      {R"("recording": {"frames": "box_%02d.obj", "first": -1})", five,
       "bodies[0].recording.first is -1; it must be a whole number from 0"},
      {R"("recording": {"frames": "box_%02d.obj", "step": 0})", five,
       "bodies[0].recording.step is 0; it must be a whole number from 1"},
      {kPc2Body + R"(, "motion": {"position": [0, 0, 0]})", five,
       "bodies[0].motion is not allowed beside a \"recording\"."},
      {kPc2Body + R"(, "copies": {"counts": [2, 1, 1], "spacing": [1, 1, 1]})", five,
       "bodies[0].copies is not allowed beside a \"recording\"."},
      {R"("mesh": {"file": "rest.obj", "size": 1}, "recording": {"cache": "box.pc2"})", five,
       "bodies[0].mesh.size is not allowed beside a \"recording\""},
      {kPc2Body + R"(, "lattice": {"kept": 8})", five,
       "bodies[0].lattice has no \"fit\"; beside a recording it must be true"},
      {kPc2Body + R"(, "lattice": {"kept": 8, "fit": false})", five,
       "bodies[0].lattice.fit is false; it must be true"},
      {R"("lattice": {"kept": 4, "fit": true}, "recording": {"frames": "far_%d.obj"})",
       R"("frames": 1)",
       "bodies[0].recording frame 0 (\"DIR/far_0.obj\") cannot be fitted: overflows."},
      {R"("mesh": {"file": "rest.obj"}, "recording": {"cache": "box.pc2", "scale": 0})", five,
       "bodies[0].recording.scale is 0; it must be a number above 0"},
  };
  for (const WrongRecording& w : wrong) {
    std::string expected = w.sentence;
    for (std::size_t at; (at = expected.find("DIR")) != std::string::npos;)
      expected.replace(at, 3, scratch_.folder().string());
    EXPECT_THAT(sentence(w.body, w.head), HasSubstr(expected)) << w.body;
  }
}

TEST_F(RecordedScene, GivesTheFirstFramesAtTheirOwnTimes) {
  const Scene whole = load(kFiles, R"("frames": 5)"), first = load(kFiles, R"("frames": 5)", 3);
  ASSERT_EQ(first.frames, 3u);
  EXPECT_EQ(first.time_step, whole.time_step);
  for (std::size_t f = 0; f < 3; ++f) EXPECT_EQ(first.nodes_of_frame(f), whole.nodes_of_frame(f));
}

TEST_F(RecordedScene, RefusesASimulationAndMoreFramesThanThereAre) {
  const auto file =
      scratch_.write("s.json", R"({"id": "s", "frames": 2, "simulation": {}, "levels": ["body"],
      "bodies": [{"name": "box", "recording": {"frames": "box_%02d.obj", "first": 5}}]})");
  EXPECT_THAT(sentence_of([&] { load_scene(file); }),
              HasSubstr("bodies[0].recording is not allowed in a simulated scene."));
  EXPECT_THAT(sentence_of([&] { load(kFiles, R"("frames": 5)", 6); }),
              HasSubstr("--frames: scene \"s\" has 5 recorded frames"));
}

}  // namespace
}  // namespace contactcheck::scene
