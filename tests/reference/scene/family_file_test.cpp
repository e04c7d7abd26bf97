// Families of hard cases: amounts, steps, lattices, and what is refused.

#include <gtest/gtest.h>

#include "reference/scene/amount.h"
#include "reference/scene/scene.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::scene {
namespace {

using test::Scratch;
using test::sentence_of;

std::string family(const std::string& body, const std::string& values = R"("0", "0x1p-52", "2")") {
  return R"({"id": "f", "title": "t", "origin": "o", "stresses": "s",
             "parameter": {"name": "gap, m", "values": [)" +
         values + R"(]}, "bodies": [)" + body + "]}";
}

std::string triangle(const std::string& rest) {
  return R"({"name": "a", "mesh": {"vertices": [[0, 0, "$"], [1, 0, "1+$"], [0, "2-$*0.5", 0]],
             "triangles": [[0, 1, 2]]})" +
         rest + "}";
}

Scene load_family(const std::string& text) {
  const Scratch scratch;
  return load_scene(scratch.write("f.json", text));
}

std::string refusal(const std::string& text) {
  const Scratch scratch;
  const auto file = scratch.write("f.json", text);
  const std::string sentence = sentence_of([&] { load_scene(file); });
  const std::string head = "scene file \"" + file.string() + "\": ";
  return sentence.rfind(head, 0) == 0 ? sentence.substr(head.size()) : sentence;
}

std::vector<Vec3> vertices(const Scene& scene, std::size_t frame) {
  std::vector<Vec3> out(scene.bodies[0].shape->mesh.vertices.size());
  map_body(*scene.bodies[0].shape, scene.recorded[frame][0], out);
  return out;
}

TEST(FamilyFile, HasAFrameForEveryValue) {
  const Scene scene = load_family(family(triangle(R"(, "lattice": "nodes")")));
  ASSERT_TRUE(scene.family());
  EXPECT_EQ(scene.frames, 3u);
  EXPECT_EQ(scene.family()->parameter, "gap, m");
  EXPECT_EQ(scene.family()->values[1], "0x1p-52");
  EXPECT_FALSE(scene.scripted());
  EXPECT_EQ(vertices(scene, 1)[0], Vec3(0, 0, 0x1p-52));
  EXPECT_EQ(vertices(scene, 1)[1], Vec3(1, 0, 1 + 0x1p-52));
  EXPECT_EQ(vertices(scene, 2)[2], Vec3(0, 1, 0));
}

TEST(FamilyFile, LatticeOfNodesAndNoLatticeGiveTheSameVertices) {
  const Scene with = load_family(family(triangle(R"(, "lattice": "nodes")")));
  const Scene without = load_family(family(triangle("")));
  EXPECT_TRUE(with.bodies[0].shape->lattice);
  EXPECT_FALSE(without.bodies[0].shape->lattice);
  for (std::size_t f = 0; f < 3; ++f) EXPECT_EQ(vertices(with, f), vertices(without, f)) << f;
}

TEST(FamilyFile, StepsFollowOneAnother) {
  const Scene scene =
      load_family(family(triangle(R"(, "steps": [{"scale": [2, 1, "$"]}, {"translate": ["$", 0, 1]},
                              {"rotate": [1, 0, 0, 1]}, {"round": 0.5}, {"vertex": 2, "by": [0, 0, "-$"]}])"),
                         R"("2")"));
  // Turned by a quarter about z: (x, y) becomes (-y, x).
  EXPECT_EQ(vertices(scene, 0)[0], Vec3(0, 2, 5));
  EXPECT_EQ(vertices(scene, 0)[1], Vec3(0, 4, 7));
  EXPECT_EQ(vertices(scene, 0)[2], Vec3(-1, 2, -1));
}

TEST(FamilyFile, StepsMoveTheNodesOfALattice) {
  const Scene scene = load_family(family(R"({"name": "a", "mesh": {"shape": "box"},
      "lattice": {"cells": [1, 1, 1]}, "steps": [{"node": [1, 1, 1], "by": [0, 0, "$"]}]})"));
  const auto& still = scene.recorded[0][0];
  const auto& moved = scene.recorded[2][0];
  ASSERT_EQ(still.size(), 8u);
  for (std::size_t n = 0; n < 7; ++n) EXPECT_EQ(moved[n], still[n]);
  EXPECT_EQ(moved[7], still[7] + Vec3(0, 0, 2));
}

TEST(FamilyFile, RefusesWhatItCannotMean) {
  EXPECT_EQ(refusal(family(triangle(""), "")),
            "parameter.values is an array of 0; it must be an array of at least 1.");
  EXPECT_NE(refusal(family(triangle(""), R"("1", "1.0")")).find("parameter.values[1]"),
            std::string::npos);
  EXPECT_NE(refusal(family(triangle(""), R"("nan")")).find("parameter.values[0]"),
            std::string::npos);
  EXPECT_NE(refusal(family(triangle(""), "1")).find("parameter.values[0]"), std::string::npos);
  EXPECT_NE(refusal(family(triangle(R"(, "lattice": "cells")"))).find("bodies[0].lattice"),
            std::string::npos);
  EXPECT_NE(refusal(family(triangle(R"(, "steps": [{"scale": "$$"}])"))).find("steps[0].scale"),
            std::string::npos);
  EXPECT_NE(refusal(family(triangle(R"(, "steps": [{"node": [0, 0, 0], "by": [0, 0, 0]}])")))
                .find("node"),
            std::string::npos);
  EXPECT_NE(refusal(family(triangle(R"(, "steps": [{"vertex": 3, "by": [0, 0, 0]}])")))
                .find("steps[0].vertex"),
            std::string::npos);
  EXPECT_NE(refusal(family(triangle(R"(, "steps": [{"scale": 1e300}, {"scale": 1e300}])")))
                .find("not finite"),
            std::string::npos);
}

TEST(FamilyFile, MaySayThatItsParameterIsASizeOrADistance) {
  const auto with_range = [](const std::string& range, const std::string& values) {
    std::string text = family(triangle(""), values);
    return text.insert(1, "\"range\": \"" + range + "\", ");
  };
  EXPECT_EQ(load_family(with_range("size", R"("1e-3", "1")")).family()->range, "size");
  EXPECT_EQ(load_family(family(triangle(""))).family()->range, "");
  EXPECT_EQ(refusal(with_range("weight", R"("1")")),
            "range is \"weight\"; it must be one of size, distance.");
  for (const char* value : {"0", "-0", "-1"})
    EXPECT_EQ(refusal(with_range("distance", R"("1", ")" + std::string(value) + "\"")),
              "parameter.values[1] is \"" + std::string(value) +
                  "\"; it must be a number above 0, as the family has a \"range\".");
}

TEST(FamilyFile, HasItsOwnFrames) {
  const Scratch scratch;
  const auto file = scratch.write("f.json", family(triangle("")));
  EXPECT_NE(sentence_of([&] { load_scene(file, 5); }).find("has its own frames"),
            std::string::npos);
}

TEST(Amount, ReadsNumbersAndSums) {
  const auto number = [](const char* text) { return parse_double(text); };
  EXPECT_EQ(number("0x1p-1074"), 0x1p-1074);
  EXPECT_EQ(number("-2.5e-3"), -2.5e-3);
  for (const char* bad :
       {"", " 1", "1 ", "1e999", "nan", "inf", "$", "1+$", "0x", "1e", "--1", "1,5"})
    EXPECT_EQ(number(bad), std::nullopt) << bad;
}

}  // namespace
}  // namespace contactcheck::scene
