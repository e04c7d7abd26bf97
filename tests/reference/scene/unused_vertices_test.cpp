// Vertices that no triangle uses, through every door of a scene: no part of a body, and the others
// keep their numbers.
#include <gmock/gmock.h>

#include "core/deform/recording.h"
#include "reference/mesh/mesh_spec.h"
#include "reference/scene/mesh_scene.h"
#include "reference/scene/scene.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/cache_bytes.h"
#include "tests/support/mesh_text.h"
#include "tests/support/shapes.h"

namespace contactcheck::scene {
namespace {

using test::CacheSamples;
using test::sentence_of;
using testing::HasSubstr;
using testing::Not;

const std::string kNote = "1 vertex that no triangle uses, dropped";

// Before the second vertex: those of the mesh but the first have other numbers than in memory.
TriangleMesh with_stray(TriangleMesh mesh, const Vec3& stray) {
  mesh.vertices.insert(mesh.vertices.begin() + 1, stray);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v += v == 0 ? 0 : 1;
  return mesh;
}

class UnusedVertices : public testing::Test {
 protected:
  UnusedVertices() {
    write("plain.obj", sphere_);
    write("stray.obj", with_stray(sphere_, {70, -3, 0}));
  }
  void write(const std::string& name, const TriangleMesh& mesh) const {
    scratch_.write(name, test::obj_text(mesh));
  }
  Scene load(const std::string& body, const std::string& head = R"("frames": 2)") const {
    return load_scene(scratch_.write("s.json", R"({"id": "s", )" + head + R"(, "duration": 1,
        "levels": ["triangle", "near"], "bodies": [{"name": "ball", )" +
                                                   body + "}]}"));
  }
  void expect_numbered(const Scene& scene) const {
    const BodyShape& shape = *scene.bodies[0].shape;
    EXPECT_EQ(shape.given.dropped, 1u);
    EXPECT_EQ(shape.given.number_of(0), 0u);
    EXPECT_EQ(shape.given.number_of(1), 2u);
    EXPECT_EQ(shape.given_vertex_count(), sphere_.vertices.size() + 1);
    EXPECT_THAT(scene.origins[0].notes, HasSubstr(kNote));
  }
  void expect_as_without(const Scene& stray, const Scene& plain) const {
    expect_numbered(stray);
    const BodyShape &a = *stray.bodies[0].shape, &b = *plain.bodies[0].shape;
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(stray.size(), plain.size());
    EXPECT_THAT(plain.origins[0].notes, Not(HasSubstr("no triangle uses")));
    for (std::size_t f = 0; f < plain.frames; ++f)
      EXPECT_EQ(stray.nodes_of_frame(f), plain.nodes_of_frame(f)) << f;
  }

  const TriangleMesh sphere_ = test::sphere_mesh({1, 2, 3}, 0.5, 2);
  const test::Scratch scratch_;
};

TEST_F(UnusedVertices, OfAFileCountInNoSizeCentreLatticeOrMotion) {
  for (const char* more : {"", R"(, "size": 2)", R"(, "scale": 3)", R"(, "center": [1, 2, 3])",
                           R"(, "size": 0.5, "center": [-9, 0, 0])", R"(, "weld": true)"})
    for (const char* rest :
         {"", R"(, "lattice": {"kept": 60})", R"(, "lattice": {"cells": [3, 4, 5]})",
          R"(, "motion": {"spins": [{"axis": [1, 0, 0], "degrees": [[0, 0], [1, 90]]}]})"}) {
      const auto body = [&](const char* file) {
        return R"("mesh": {"file": ")" + std::string(file) + '"' + more + "}" + rest;
      };
      SCOPED_TRACE(body("stray.obj"));
      expect_as_without(load(body("stray.obj")), load(body("plain.obj")));
    }
}

TEST_F(UnusedVertices, WhereverTheyAre) {
  for (const Vec3& place :
       {Vec3(1e300, 0, 0), Vec3(0, -1.7e308, 0), Vec3(1, 2, 3), sphere_.vertices[4]}) {
    write("there.obj", with_stray(sphere_, place));
    const std::string rest = R"(, "scale": 1000}, "lattice": {"kept": 60})";
    expect_as_without(load(R"("mesh": {"file": "there.obj")" + rest),
                      load(R"("mesh": {"file": "plain.obj")" + rest));
  }
}

TEST_F(UnusedVertices, OfASimplifiedMeshAreNotCounted) {
  const Scene stray = load(R"("mesh": {"file": "stray.obj", "triangles": 40})"),
              plain = load(R"("mesh": {"file": "plain.obj", "triangles": 40})");
  EXPECT_EQ(stray.bodies[0].shape->mesh.vertices, plain.bodies[0].shape->mesh.vertices);
  EXPECT_EQ(stray.bodies[0].shape->mesh.triangles, plain.bodies[0].shape->mesh.triangles);
  EXPECT_THAT(stray.origins[0].notes, HasSubstr(kNote));
}

TEST_F(UnusedVertices, OfASubdividedMeshLeaveTheOthersTheirNumbers) {
  expect_numbered(load(R"("mesh": {"file": "stray.obj", "subdivide": 0})"));
  const Scene stray = load(R"("mesh": {"file": "stray.obj", "subdivide": 1})"),
              plain = load(R"("mesh": {"file": "plain.obj", "subdivide": 1})");
  EXPECT_EQ(stray.bodies[0].shape->mesh.vertices, plain.bodies[0].shape->mesh.vertices);
  EXPECT_EQ(stray.bodies[0].shape->given.number_of(1), 2u);
}

TEST_F(UnusedVertices, OfRecordedFramesMayGoAnywhere) {
  CacheSamples with, without;
  for (int f = 0; f < 3; ++f) {
    TriangleMesh moved = sphere_;
    for (Vec3& v : moved.vertices) v.x() += 0.25 * f;
    const TriangleMesh stray = with_stray(moved, {f == 1 ? 1e30 : -4.0 * f, 0, 9});
    write("with_" + std::to_string(f) + ".obj", stray);
    write("without_" + std::to_string(f) + ".obj", moved);
    with.push_back(stray.vertices);
    without.push_back(moved.vertices);
  }
  scratch_.write("with.pc2", test::pc2_bytes(with));
  scratch_.write("without.pc2", test::pc2_bytes(without));
  scratch_.write("with.mdd", test::mdd_bytes(with));
  scratch_.write("without.mdd", test::mdd_bytes(without));
  const auto files = [](const std::string& name, const std::string& more) {
    return R"("recording": {"frames": ")" + name + R"(_%d.obj")" + more;
  };
  const auto cache = [](const std::string& mesh, const std::string& name, const char* ending) {
    return R"("mesh": {"file": ")" + mesh + R"(.obj"}, "recording": {"cache": ")" + name + ending +
           "\"}";
  };
  const std::string head = R"("frames": 3)";
  for (const std::string more : {R"(})", R"(, "scale": 1e9, "translate": [1, 0, 0]})",
                                 R"(}, "lattice": {"kept": 40, "fit": true})"}) {
    SCOPED_TRACE(more);
    expect_as_without(load(files("with", more), head), load(files("without", more), head));
  }
  for (const char* ending : {".pc2", ".mdd"}) {
    SCOPED_TRACE(ending);
    expect_as_without(load(cache("stray", "with", ending), head),
                      load(cache("plain", "without", ending), head));
  }
}

TEST_F(UnusedVertices, OfARecordingAreCountedInItsFrames) {
  write("few_0.obj", with_stray(sphere_, {0, 0, 0}));
  write("few_1.obj", sphere_);
  EXPECT_THAT(sentence_of([&] { load(R"("recording": {"frames": "few_%d.obj"})"); }),
              HasSubstr("has 66 vertices and 128 triangles, the body's mesh has 67 vertices"));
}

TEST_F(UnusedVertices, OfAFamilyKeepTheNumbersThatStepsName) {
  const std::string head = R"({"id": "f", "title": "t", "origin": "o", "stresses": "s",
      "parameter": {"name": "z", "values": ["2", "5"]}, "bodies": [{"name": "flap", "mesh":
      {"vertices": [[0,0,0], [99,99,99], [1,0,0], [0,1,0]], "triangles": [[0, 2, 3]]})";
  const auto family = [&](const std::string& rest) {
    return load_scene(scratch_.write("f.json", head + rest + "}]}"));
  };
  const std::string step = R"(, "steps": [{"vertex": 3, "by": [0, 0, "$"]}])";
  const Scene bare = family(step);
  EXPECT_EQ(bare.nodes_of_frame(1)[0], (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 5}}));
  EXPECT_EQ(bare.origins[0].notes, kNote);
  EXPECT_EQ(bare.bodies[0].shape->given.number_of(2), 3u);
  // There it is still a node.
  const Scene nodes = family(step + R"(, "lattice": "nodes")");
  std::vector<Vec3> mapped(3);
  map_body(*nodes.bodies[0].shape, nodes.nodes_of_frame(1)[0], mapped);
  EXPECT_EQ(mapped, bare.nodes_of_frame(1)[0]);
  EXPECT_EQ(nodes.origins[0].notes, "");
}

TEST_F(UnusedVertices, OfAReplayedRecordingAreNoted) {
  Recording recording;
  recording.scene = "s";
  recording.bodies = {{"ball", make_bare_shape(with_stray(sphere_, {9, 9, 9}))}};
  recording.frames = {{sphere_.vertices}};
  write_recording(scratch_.folder() / "s.ccr", recording);
  const Scene scene = load_recording(scratch_.folder() / "s.ccr");
  expect_numbered(scene);
  EXPECT_EQ(scene.nodes_of_frame(0)[0], sphere_.vertices);
}

TEST_F(UnusedVertices, CountInNoSizeOfMeshesThatAreGivenAlone) {
  MeshSceneRequest request;
  request.meshes = {scratch_.folder() / "plain.obj", scratch_.folder() / "stray.obj"};
  EXPECT_THAT(mesh_notes(request), testing::Contains("stray: " + kNote));
  EXPECT_THAT(mesh_notes(request), Not(testing::Contains(HasSubstr("70"))));
  const Scene scene = load_scene_text(mesh_scene(request, scratch_.folder()));
  EXPECT_EQ(scene.size(), 1.0);
  EXPECT_EQ(scene.bodies[0].shape->lattice->cells, scene.bodies[1].shape->lattice->cells);
}

}  // namespace
}  // namespace contactcheck::scene
