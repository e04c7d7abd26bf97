#include "reference/suite/case_file.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "reference/judge/accuracy.h"
#include "reference/suite/job.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck::suite {
namespace {

using nlohmann::json;
using test::Scratch;

double read_back(const json& text) { return std::strtod(text.get<std::string>().c_str(), nullptr); }

TEST(HexFloat, ReadsBackBitForBit) {
  EXPECT_EQ(hex_float(3.0), "0x1.8p+1");
  for (double value :
       {0.1, -1.0 / 3.0, 5e-324, 1.7976931348623157e308, -0.0, 0x1.fffffffffffffp-1}) {
    const double again = read_back(hex_float(value));
    EXPECT_EQ(again, value);
    EXPECT_EQ(std::signbit(again), std::signbit(value));
  }
}

class CaseFile : public testing::Test {
 protected:
  CaseFile()
      : scene_(test::approach_scene(
            test::make_body("", test::unit_box_mesh(1), {2, 2, 2}).shape,
            test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 1), {3, 3, 3}).shape,
            {{0.0, 1.3}, {1.0, 0.7}}, 0.1, 0.2, 3, 0.35, {Level::kTriangle, Level::kCell})),
        judged_(judge::judge_scene(scene_, progress_)) {}

  json write(const char* level, const char* kind, ElementPair pair) {
    judge::Disagreement d;
    d.scene = "approach";
    d.detector = "fcl-aabb";
    d.level = level;
    d.kind = kind;
    d.frame = 2;
    d.pair = pair;
    write_case(scratch_.folder() / "case", judged_, d, "../recordings/approach.ccr");
    return json::parse(read_text_file(scratch_.folder() / "case"));
  }

  void expect_triangle(const json& element, std::uint32_t body, std::uint32_t triangle) {
    EXPECT_EQ(element.at("triangle"), triangle);
    ASSERT_EQ(element.at("vertices").size(), 3u);
    const Triangle& corners = scene_.bodies[body].shape->mesh.triangles[triangle];
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) {
        const double place = judged_.positions[2].vertices[body][corners[c]][k];
        EXPECT_EQ(read_back(element.at("vertices")[c][k]), place);
        EXPECT_EQ(element.at("vertices_decimal")[c][k], place);
      }
  }

  void expect_cell(const json& element, std::uint32_t body, std::uint32_t cell) {
    EXPECT_EQ(element.at("cell"), cell);
    ASSERT_EQ(element.at("nodes").size(), 8u);
    const Lattice& lattice = *scene_.bodies[body].shape->lattice;
    for (int c = 0; c < 8; ++c)
      for (int k = 0; k < 3; ++k) {
        const double place = judged_.positions[2].nodes[body][lattice.cell_nodes[cell][c]][k];
        EXPECT_EQ(read_back(element.at("nodes")[c][k]), place);
        EXPECT_EQ(element.at("nodes_decimal")[c][k], place);
      }
  }

  process::SharedProgress page_;
  process::ProgressWriter progress_{&page_};
  scene::Scene scene_;
  judge::JudgedScene judged_;
  Scratch scratch_;
};

TEST_F(CaseFile, TrianglePairHoldsItsSixDeformedVertices) {
  const json c = write("triangle", "missed", {0, 1, 5, 17});
  EXPECT_EQ(c.at("scene"), "approach");
  EXPECT_EQ(c.at("frame"), 2);
  EXPECT_EQ(c.at("detector"), "fcl-aabb");
  EXPECT_EQ(c.at("level"), "triangle");
  EXPECT_EQ(c.at("kind"), "missed");
  EXPECT_EQ(c.at("recording"), "../recordings/approach.ccr");
  EXPECT_EQ(c.at("first").at("body"), "resting");
  EXPECT_EQ(c.at("second").at("body"), "moving");
  expect_triangle(c.at("first"), 0, 5);
  expect_triangle(c.at("second"), 1, 17);
}

TEST_F(CaseFile, SpuriousCellPairHoldsTheMappedNodesOfBothCells) {
  const json c = write("cell", "spurious", {0, 1, 3, 8});
  expect_cell(c.at("first"), 0, 3);
  expect_cell(c.at("second"), 1, 8);
}

TEST_F(CaseFile, MissedAtCellLevelIsAPairOfTriangles) {
  expect_triangle(write("cell", "missed", {0, 1, 5, 17}).at("second"), 1, 17);
}

TEST_F(CaseFile, BodyPairNamesItsBodiesAlone) {
  const json c = write("body", "missed", {0, 1, 0, 0});
  EXPECT_EQ(c.at("first").size(), 1u);
  EXPECT_EQ(c.at("second").at("body"), "moving");
}

TEST_F(CaseFile, NearPairHoldsItsVertexAndItsTriangle) {
  const json c = write("near", "missed", {1, 0, 9, 4});
  EXPECT_EQ(c.at("first").at("body"), "moving");
  EXPECT_EQ(c.at("first").at("vertex"), 9);
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(read_back(c.at("first").at("position")[k]), judged_.positions[2].vertices[1][9][k]);
  EXPECT_EQ(c.at("second").at("body"), "resting");
  expect_triangle(c.at("second"), 0, 4);
}

TEST_F(CaseFile, VertexInABodyIsTheVertexAndTheBody) {
  const json c = write("vertex", "spurious", {0, 1, 3, 0});
  EXPECT_EQ(c.at("first").at("vertex"), 3);
  EXPECT_EQ(c.at("second").size(), 1u);
}

}  // namespace
}  // namespace contactcheck::suite
