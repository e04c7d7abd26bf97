// Scenes out of mesh files: apart, in contact, apart again, whatever the meshes are.
#include "reference/scene/mesh_scene.h"

#include <gmock/gmock.h>

#include <fstream>

#include "reference/oracle/oracle.h"
#include "tests/reference/scene/odd_meshes.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/mesh_text.h"

namespace contactcheck::scene {
namespace {

namespace fs = std::filesystem;
using test::odd_meshes;
using test::sentence_of;
using testing::ElementsAre;
using testing::HasSubstr;

class MeshScene : public testing::Test {
 protected:
  MeshScene() {
    for (const auto& [name, mesh] : odd_meshes())
      scratch_.write(name + ".obj", test::obj_text(mesh));
  }

  MeshSceneRequest request(const std::vector<std::string>& names,
                           const std::string& motion = "approach") const {
    MeshSceneRequest out;
    for (const std::string& name : names) out.meshes.push_back(file(name));
    out.motion = motion;
    return out;
  }
  fs::path file(const std::string& name) const { return scratch_.folder() / (name + ".obj"); }
  Scene scene(const MeshSceneRequest& request) const {
    return load_scene_text(mesh_scene(request, scratch_.folder()));
  }

  // Per frame: the pairs of bodies whose surfaces share a point.
  static std::vector<std::vector<BodyPair>> contacts(const Scene& scene) {
    oracle::Oracle oracle(scene.bodies);
    std::vector<std::vector<BodyPair>> out;
    for (std::size_t f = 0; f < scene.frames; ++f) {
      const test::FrameData data = test::make_frame(scene.bodies, scene.nodes_of_frame(f));
      out.push_back(oracle.judge(data.frame(f), oracle::WantedTruth{}).surface.bodies);
    }
    return out;
  }

  // The first body meets every other one, long enough; at the ends nobody touches anybody.
  static void expect_meeting(const Scene& scene) {
    const auto frames = contacts(scene);
    EXPECT_THAT(frames.front(), ElementsAre());
    EXPECT_THAT(frames.back(), ElementsAre());
    for (std::uint32_t b = 1; b < scene.bodies.size(); ++b) {
      std::size_t count = 0;
      for (const auto& pairs : frames)
        count += static_cast<std::size_t>(std::count(pairs.begin(), pairs.end(), BodyPair{0, b}));
      EXPECT_GE(count, 6u) << "frames of body " << b;
    }
  }

  const test::Scratch scratch_;
};

TEST_F(MeshScene, HasBodiesNamedAfterTheFilesInLatticesOfTheSizeAskedFor) {
  MeshSceneRequest wanted = request({"far", "ball", "far"});
  wanted.size = 0.25;
  const Scene out = scene(wanted);
  EXPECT_EQ(out.id, "far-ball-and-1-more-approach");
  ASSERT_EQ(out.bodies.size(), 3u);
  EXPECT_EQ(out.bodies[0].name, "far");
  EXPECT_EQ(out.bodies[1].name, "ball");
  EXPECT_EQ(out.bodies[2].name, "far-2");
  for (const Body& body : out.bodies) {
    EXPECT_DOUBLE_EQ(bounding_box(body.shape->mesh.vertices).extent().maxCoeff(), 0.25);
    ASSERT_TRUE(body.shape->lattice);
    EXPECT_NEAR(static_cast<double>(body.shape->lattice->cells.size()), 150.0, 50.0);
  }
}

TEST_F(MeshScene, BringsOddMeshesIntoContactAndApartAgain) {
  std::vector<std::string> names;
  for (const auto& [name, mesh] : odd_meshes()) names.push_back(name);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string &first = names[i], &second = names[(i + 5) % names.size()];
    SCOPED_TRACE(first + " and " + second);
    expect_meeting(scene(request({first, second})));
  }
}

TEST_F(MeshScene, BringsEveryOddMeshIntoContactWithItself) {
  for (const auto& [name, mesh] : odd_meshes()) {
    SCOPED_TRACE(name);
    expect_meeting(scene(request({name, name})));
  }
}

TEST_F(MeshScene, EveryMotionMeetsAndParts) {
  for (const std::string& motion : motion_names()) {
    SCOPED_TRACE(motion);
    expect_meeting(scene(request({"ball", "box"}, motion)));
    expect_meeting(scene(request({"plate", "rod"}, motion)));
    if (motion == "pass") continue;
    expect_meeting(scene(request({"leaning", "box", "plate", "ball"}, motion)));
  }
}

TEST_F(MeshScene, SevenMeshesComeFromAllSides) {
  expect_meeting(scene(request({"box", "ball", "plate", "rod", "open", "leaning", "ball"})));
}

TEST_F(MeshScene, KeepsTheSizesOfTheFilesWhereAskedTo) {
  for (const auto& [first, second] :
       {std::pair("tiny", "tiny"), std::pair("huge", "huge"), std::pair("huge", "box"),
        std::pair("box", "huge"), std::pair("ball", "tiny"), std::pair("far", "rod")}) {
    SCOPED_TRACE(std::string(first) + " and " + second);
    MeshSceneRequest wanted = request({first, second});
    wanted.size = std::nullopt;
    const Scene out = scene(wanted);
    EXPECT_NEAR(bounding_box(out.bodies[0].shape->mesh.vertices).extent().x(),
                bounding_box(odd_meshes().at(first).vertices).extent().x(),
                1e-9 * bounding_box(odd_meshes().at(first).vertices).extent().x());
    expect_meeting(out);
  }
}

// Press goes deeper than approach and squashes; twist and press move the first body too.
TEST_F(MeshScene, MotionsDifferWhereTheySaySo) {
  const auto nodes_at = [&](const char* motion, double time) {
    return scene(request({"ball", "box"}, motion)).nodes_at(time);
  };
  const auto approach = nodes_at("approach", 1.0), twist = nodes_at("twist", 1.0),
             press = nodes_at("press", 1.0), pass = nodes_at("pass", 0.5);
  EXPECT_NE(approach[0], twist[0]);
  EXPECT_NE(approach[0], press[0]);
  EXPECT_EQ(approach[0], pass[0]);
  EXPECT_NE(approach[1], pass[1]);
  const auto extent = [](const std::vector<Vec3>& nodes) {
    return bounding_box(nodes).extent().x();
  };
  EXPECT_NEAR(extent(press[1]), 0.85 * extent(approach[1]), 1e-9);
}

TEST_F(MeshScene, ReadsFromTheFolderThatItIsKeptIn) {
  const SceneText text = mesh_scene(request({"ball", "box"}), scratch_.folder() / "deep" / "down");
  EXPECT_THAT(text.text, HasSubstr(R"("file": "../../ball.obj")"));
  const fs::path file = scratch_.write("deep/down/kept.json", text.text);
  const Scene kept = load_scene(file), given = scene(request({"ball", "box"}));
  EXPECT_EQ(kept.id, "ball-box-approach");
  EXPECT_EQ(kept.nodes_of_frame(17), given.nodes_of_frame(17));
}

TEST_F(MeshScene, NamesTheLinkThatLeadsNowhere) {
  fs::create_symlink(file("loop"), file("loop"));
  EXPECT_EQ(sentence_of([&] {
              mesh_scene(request({"loop", "loop"}), scratch_.folder());
            }),
            "--mesh \"" + file("loop").string() +
                "\" cannot be followed to a file: Too many levels of symbolic links");
}

TEST_F(MeshScene, OneMeshComesToMeetItself) {
  for (const char* motion : {"fold", "twist"})
    for (const char* mesh : {"ball", "rod", "plate", "leaning"}) {
      SCOPED_TRACE(std::string(motion) + " " + mesh);
      const Scene out = scene(request({mesh}, motion));
      EXPECT_TRUE(out.judges(Level::kSelf));
      EXPECT_FALSE(out.judges(Level::kTriangle));
      oracle::Oracle oracle(out.bodies);
      oracle::WantedTruth wanted;
      wanted.self = true;
      const auto pairs_at = [&](std::size_t frame) {
        const test::FrameData data = test::make_frame(out.bodies, out.nodes_of_frame(frame));
        return oracle.judge(data.frame(frame), wanted).surface.self.size();
      };
      EXPECT_EQ(pairs_at(0), 0u);
      EXPECT_GT(pairs_at(out.frames - 1), 0u);
    }
}

TEST_F(MeshScene, RefusesWhatCannotBeOne) {
  const auto sentence = [&](const MeshSceneRequest& request) {
    return sentence_of([&] { scene(request); });
  };
  EXPECT_THAT(sentence(request({"ball"})), HasSubstr("ball.obj\": one mesh meets nothing"));
  EXPECT_THAT(sentence(request({"ball", "box"}, "dance")),
              HasSubstr("--motion: \"dance\" is not one of approach, press, twist, pass, fold"));
  EXPECT_THAT(sentence(request({"ball", "box"}, "fold")),
              HasSubstr("--motion fold is for one mesh; 2 are named"));
  EXPECT_THAT(sentence(request({"ball", "box", "box"}, "pass")), HasSubstr("at most 2"));
  EXPECT_THAT(sentence(request(std::vector<std::string>(8, "box"))), HasSubstr("at most 7"));
  EXPECT_THAT(sentence(request({"ball", "gone"})), HasSubstr("gone.obj\" does not exist"));
  scratch_.write("point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n");
  MeshSceneRequest points = request({"ball", "point"});
  EXPECT_THAT(sentence(points), HasSubstr("the mesh is a point"));
  points.size = std::nullopt;
  EXPECT_THAT(sentence(points), HasSubstr("body \"point\" is a point"));
  MeshSceneRequest large = request({"large", "ball"});
  large.size = std::nullopt;
  scratch_.write("large.obj", "v 0 0 0\nv 2e6 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(sentence(large), HasSubstr("is 2e+06 m large"));
}

}  // namespace
}  // namespace contactcheck::scene
