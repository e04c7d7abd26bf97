// What must not change when the question is only put differently.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::prepared;
using test::Scene;

std::vector<std::string> all_members() {
  std::vector<std::string> ids = test::family();
  for (const std::string& id : test::exact_detectors()) ids.push_back(id);
  return ids;
}

// Cells or triangles, whatever the detector answers with.
const std::vector<ElementPair>& elements(const ContactSet& set) {
  return set.triangles.empty() ? set.cells : set.triangles;
}

// Both lists of nodes in the other order.
Scene swapped(Scene scene) {
  std::swap(scene.bodies[0], scene.bodies[1]);
  for (test::FrameData& frame : scene.frames) {
    std::swap(frame.nodes[0], frame.nodes[1]);
    std::swap(frame.vertices[0], frame.vertices[1]);
  }
  return scene;
}

TEST(Metamorphic, SwappedBodiesGiveTheMirroredSet) {
  std::size_t pairs = 0;
  for (std::uint64_t seed : {201, 202, 203}) {
    const Scene scene = test::approach({seed, 0.4});
    const Scene other = swapped(scene);
    for (const std::string& name : all_members()) {
      const auto forward = prepared(name, scene), backward = prepared(name, other);
      for (std::size_t f = 0; f < scene.frames.size(); ++f) {
        std::vector<ElementPair> mirrored = elements(answer(*backward, other.frames[f]));
        for (ElementPair& p : mirrored) std::swap(p.a, p.b);
        std::sort(mirrored.begin(), mirrored.end());
        EXPECT_EQ(elements(answer(*forward, scene.frames[f])), mirrored) << name << " frame " << f;
        pairs += mirrored.size();
      }
    }
  }
  EXPECT_GT(pairs, 1000u);
}

TEST(Metamorphic, ExactTranslationChangesNothing) {
  const Scene here = test::exact_boxes(Vec3::Zero());
  std::size_t pairs = 0;
  for (const Vec3& shift : {Vec3(4096, -8192, 0.25), Vec3(-0x1p30, 0, 0x1p30), Vec3(0, 0, -0.5)}) {
    const Scene there = test::exact_boxes(shift);
    for (const std::string& name : test::exact_detectors()) {
      const auto a = prepared(name, here), b = prepared(name, there);
      for (std::size_t f = 0; f < here.frames.size(); ++f) {
        const auto expected = answer(*a, here.frames[f]).triangles;
        EXPECT_EQ(answer(*b, there.frames[f]).triangles, expected) << name << " frame " << f;
        EXPECT_EQ(expected.empty(), f == 0);
        pairs += expected.size();
      }
    }
  }
  EXPECT_GT(pairs, 1000u);
}

TEST(Metamorphic, ScalingASceneByAPowerOfTwoChangesNothing) {
  for (double scale : {0x1p-100, 0x1p-20, 0x1p20}) {
    const Scene plain = test::approach({211, 0.4}), scaled = test::approach({211, 0.4, scale});
    std::size_t pairs = 0;
    for (const std::string& name : all_members()) {
      const auto a = prepared(name, plain), b = prepared(name, scaled);
      for (std::size_t f = 0; f < plain.frames.size(); ++f) {
        const auto expected = elements(answer(*a, plain.frames[f]));
        EXPECT_EQ(elements(answer(*b, scaled.frames[f])), expected) << name << " " << scale;
        pairs += expected.size();
      }
    }
    EXPECT_GT(pairs, 500u);
  }
}

TEST(Metamorphic, BodiesDeformedToAnotherSizeAreFoundTheSame) {
  // The nodes alone scale: the hash grid, made at rest, no longer fits.
  const Scene plain = test::approach({212, 0.4});
  for (double scale : {0x1p-300, 0x1p-12, 0x1p12, 0x1p300}) {
    Scene scaled = plain;
    for (test::FrameData& frame : scaled.frames) {
      auto nodes = frame.nodes;
      for (auto& body : nodes)
        for (Vec3& n : body) n *= scale;
      frame = test::make_frame(scaled.bodies, std::move(nodes));
    }
    for (const std::string& name : test::exact_detectors()) {
      const auto a = prepared(name, plain), b = prepared(name, scaled);
      for (std::size_t f = 0; f < plain.frames.size(); ++f)
        EXPECT_EQ(answer(*b, scaled.frames[f]).triangles, answer(*a, plain.frames[f]).triangles)
            << name << " " << scale;
    }
  }
}

TEST(Metamorphic, FramesInAnyOrderAndRepeatedGiveTheSame) {
  const Scene scene = test::approach({213, 0.4});
  for (const std::string& name : all_members()) {
    const auto detector = prepared(name, scene);
    std::vector<ContactSet> first;
    for (const test::FrameData& frame : scene.frames) first.push_back(answer(*detector, frame));
    EXPECT_FALSE(elements(first.back()).empty());
    for (std::size_t f : {5, 0, 5, 3, 3, 1, 4, 2, 0})
      EXPECT_EQ(elements(answer(*detector, scene.frames[f])), elements(first[f])) << name;
  }
}

TEST(Metamorphic, QueryingAgainWithoutUpdateGivesTheSame) {
  const Scene scene = test::approach({214, 0.4});
  for (const std::string& name : all_members()) {
    const auto detector = prepared(name, scene);
    const ContactSet once = answer(*detector, scene.frames.back());
    detector->trace();
    ContactSet ignored, again;
    detector->query(Question::kBody, ignored);
    detector->query(detector->semantics().questions.front(), again);
    again.canonicalize();
    EXPECT_EQ(elements(again), elements(once)) << name;
    EXPECT_FALSE(elements(once).empty()) << name;
  }
}

TEST(Metamorphic, PreparingAgainForgetsTheLastScene) {
  const Scene first = test::approach({215, 0.4}), second = test::three_bodies({216, 0.3});
  for (const std::string& name : all_members()) {
    const auto used = prepared(name, first), fresh = prepared(name, second);
    answer(*used, first.frames.back());
    used->prepare(second.bodies);
    EXPECT_EQ(elements(answer(*used, second.frames[0])), elements(answer(*fresh, second.frames[0])))
        << name;
  }
}

}  // namespace
}  // namespace contactcheck
