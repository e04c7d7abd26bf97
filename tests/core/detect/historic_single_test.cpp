// The historic detectors in single precision: they find exactly the pairs of triangles that
// intersect among their floats, those that they are fed (boxes and spheres of triangles) or map
// (bd-tree).

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "core/types/check.h"
#include "tests/core/detect/single_scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::FrameData;
using test::prepared;
using test::Scene;
using test::single_scenes;
using test::SingleScene;

const std::string kSinglePrecision = "precision=single";

// Options at both ends.
std::vector<std::string> fed_detectors() {
  return {"spatial-hash:" + kSinglePrecision,         "spatial-hash:cell=0.05," + kSinglePrecision,
          "spatial-hash:table=1," + kSinglePrecision, "aabb-tree:" + kSinglePrecision,
          "aabb-tree:leaf=1," + kSinglePrecision,     "aabb-tree:leaf=64," + kSinglePrecision,
          "sphere-tree:" + kSinglePrecision,          "sphere-tree:leaf=1," + kSinglePrecision,
          "sphere-tree:leaf=64," + kSinglePrecision};
}

std::vector<std::string> mapping_detectors() {
  return {"bd-tree:" + kSinglePrecision, "bd-tree:leaf=1,reference=none," + kSinglePrecision,
          "bd-tree:leaf=64,reference=rigid," + kSinglePrecision,
          "bd-tree:bound=paper," + kSinglePrecision,
          "bd-tree:bound=paper,reference=none," + kSinglePrecision};
}

std::vector<std::string> defaults() {
  return {"spatial-hash:" + kSinglePrecision, "aabb-tree:" + kSinglePrecision,
          "sphere-tree:" + kSinglePrecision, "bd-tree:" + kSinglePrecision};
}

void expect_pairs(const std::string& name, const SingleScene& single,
                  const std::vector<std::vector<ElementPair>>& expected) {
  SCOPED_TRACE(name);
  test::expect_pairs(*prepared(name, single.scene), single, expected);
}

TEST(HistoricSingle, FindsWhatIntersectsAmongTheVerticesItIsFed) {
  for (const SingleScene& single : single_scenes())
    for (const std::string& name : fed_detectors()) expect_pairs(name, single, single.fed);
}

TEST(HistoricSingle, FindsWhatIntersectsAmongTheVerticesItMaps) {
  int with_lattices = 0;
  for (const SingleScene& single : single_scenes()) {
    if (!single.lattices) continue;
    ++with_lattices;
    for (const std::string& name : mapping_detectors()) expect_pairs(name, single, single.mapped);
  }
  EXPECT_GE(with_lattices, 5);
}

// What is mapped in floats and what is mapped in doubles and then rounded is not the same, and the
// scenes tell.
TEST(HistoricSingle, FedAndMappedDifferSomewhere) {
  const std::vector<SingleScene>& all = single_scenes();
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const SingleScene& single) {
    return single.lattices && single.fed != single.mapped;
  }));
}

TEST(HistoricSingle, SaysWhatItIs) {
  for (const std::string& name : defaults()) {
    const auto detector = prepared(name, test::approach({961}, 1));
    const Semantics& s = detector->semantics();
    EXPECT_EQ(s.precision, Precision::kSingle) << name;
    EXPECT_TRUE(s.local_origin) << name;
    EXPECT_EQ(s.scale, 1.0) << name;
    EXPECT_FALSE(s.exact) << name;
    EXPECT_TRUE(s.closed) << name;
    EXPECT_EQ(detector->needs_vertices(), !name.starts_with("bd-tree")) << name;
  }
}

TEST(HistoricSingle, KeepsItsDigitsFarFromTheOrigin) {
  const Scene scene = test::approach({911, 0.4, 1.0, Vec3(1e6, -1e6, 1e6)});
  for (const std::string& name : defaults()) {
    const auto detector = prepared(name, scene);
    for (const FrameData& frame : scene.frames)
      EXPECT_EQ(answer(*detector, frame).triangles, test::true_pairs(scene, frame)) << name;
  }
}

TEST(HistoricSingle, RefusesWhatIsBeyondTheLimitAndAnswersTheNextFrame) {
  const Scene scene = test::approach({962, 0.4}, 4);
  for (const std::string& name : defaults()) {
    const auto detector = prepared(name, scene);
    for (double far : {5e12, 1e308}) {
      FrameData data = scene.frames[3];
      data.nodes[1][0].x() = data.vertices[1][0].x() = far;
      EXPECT_THROW(detector->update(data.frame()), RefusedInput) << name << " " << far;
    }
    EXPECT_EQ(answer(*detector, scene.frames[3]).triangles,
              test::true_pairs(scene, scene.frames[3]))
        << name;
  }
}

// Below the range of floats all is one point, and points that coincide are in contact.
TEST(HistoricSingle, OfWhatIsTooSmallForItMakesOnePoint) {
  const Scene scene = test::approach({931, 0.4, 1e-60}, 2);
  const std::size_t all =
      scene.bodies[0].shape->mesh.triangles.size() * scene.bodies[1].shape->mesh.triangles.size();
  for (const std::string& name : defaults())
    EXPECT_EQ(answer(*prepared(name, scene), scene.frames[0]).triangles.size(), all) << name;
}

// At rest beyond the range of floats, now of usual size: grid cells and stretches of rest are no
// floats.
TEST(HistoricSingle, IsUsableWhateverTheSizeAtRest) {
  for (double at_rest : {1e-300, 1e-42, 1e42, 1e300}) {
    Scene scene = test::approach({941, 0.0, at_rest}, 4);
    for (FrameData& frame : scene.frames) {
      auto nodes = frame.nodes;
      for (std::vector<Vec3>& body : nodes)
        for (Vec3& n : body) n /= at_rest;
      frame = test::make_frame(scene.bodies, std::move(nodes));
    }
    for (const std::string& name : defaults()) {
      const auto detector = prepared(name, scene);
      for (const FrameData& frame : scene.frames)
        EXPECT_EQ(answer(*detector, frame).triangles, test::true_pairs(scene, frame))
            << name << " " << at_rest;
    }
  }
}

}  // namespace
}  // namespace contactcheck
