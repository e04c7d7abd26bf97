// The paper's four scenes: their counts beside those of its Table 2 (fixtures/paper/tables.json),
// and how they start.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reference/scene/catalogue.h"
#include "reference/scene/scene.h"
#include "reference/text/file_text.h"
#include "reference/text/json_field.h"
#include "tests/reference/scene/installed.h"

namespace contactcheck::scene {
namespace {

const std::filesystem::path kPaperFixtures = CONTACTCHECK_FIXTURES;

// How far ours may be from the paper's counts: its meshes and lattices are not published.
constexpr double kMeshTolerance = 0.01, kCellTolerance = 0.05;

struct Counts {
  std::string scene;
  double objects = 0, vertices = 0, triangles = 0, cells = 0;
};
void PrintTo(const Counts& counts, std::ostream* out) { *out << counts.scene; }

// The rows of Table 2.
std::vector<Counts> paper_counts() {
  const std::filesystem::path file = kPaperFixtures / "paper" / "tables.json";
  const std::string document = file.string();
  const text::JsonValue value =
      text::parse_json(text::read_file_bytes(file, "paper's tables"), document);
  std::vector<Counts> out;
  for (const text::JsonField& row : text::JsonField(value, document).at("table_2").items(1)) {
    out.push_back({row.at("scene").text(), row.at("objects").number(), row.at("vertices").number(),
                   row.at("triangles").number(), row.at("cells").number()});
  }
  return out;
}

bool solid(const Scene& scene) {
  return std::all_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& body) { return body.shape->topology.solid; });
}

class PaperScene : public ::testing::TestWithParam<Counts> {
 protected:
  void SetUp() override {
    if (!test::data_installed()) {
      GTEST_SKIP() << "install libcgal-demo and povray-examples";
    }
  }

  static Scene load(const std::string& suffix = "") {
    return load_scene(find_scene("paper-" + GetParam().scene + suffix, kPaperFixtures));
  }
};

Counts counts_of(const Scene& scene) {
  Counts out{scene.id, static_cast<double>(scene.bodies.size())};
  for (const Body& body : scene.bodies) {
    out.vertices += static_cast<double>(body.shape->mesh.vertices.size());
    out.triangles += static_cast<double>(body.shape->mesh.triangles.size());
    out.cells += static_cast<double>(body.shape->lattice->cells.size());
  }
  return out;
}

TEST_P(PaperScene, HasThePapersObjectsAndTriangles) {
  const Counts paper = GetParam(), ours = counts_of(load());
  EXPECT_EQ(ours.objects, paper.objects);
  EXPECT_NEAR(ours.triangles, paper.triangles, kMeshTolerance * paper.triangles);
}

TEST_P(PaperScene, HasThePapersVerticesUnlessNoClosedSurfaceDoes) {
  const Scene scene = load();
  const Counts paper = GetParam(), ours = counts_of(scene);
  // Euler: a closed surface has V = F / 2 + 2 vertices, less 2 for every handle.
  const double most_when_closed = paper.triangles / 2 + 2 * paper.objects;
  if (solid(scene) && paper.vertices > most_when_closed) {
    EXPECT_EQ(ours.vertices, ours.triangles / 2 + 2 * ours.objects);
  } else {
    EXPECT_NEAR(ours.vertices, paper.vertices, kMeshTolerance * paper.vertices);
  }
}

TEST_P(PaperScene, KeepsThePapersCellsOfEveryObject) {
  const double wanted = GetParam().cells / GetParam().objects;
  for (const std::string suffix : {"", "-full"}) {
    for (const Body& body : load(suffix).bodies) {
      EXPECT_NEAR(static_cast<double>(body.shape->lattice->cells.size()), wanted,
                  kCellTolerance * wanted)
          << body.name << suffix;
    }
  }
}

TEST_P(PaperScene, IsSolidUnlessItJudgesNoInside) {
  const Scene scene = load(), full = load("-full");
  EXPECT_EQ(solid(scene), scene.judges(Level::kVertex));
  EXPECT_EQ(solid(full), solid(scene));
  EXPECT_EQ(full.levels, scene.levels);
}

// The box of a body's nodes, which hold the body.
std::vector<Aabb> start_boxes(const Scene& scene) {
  std::vector<Aabb> boxes;
  for (const std::vector<Vec3>& nodes : scene.nodes_at(0.0)) boxes.push_back(bounding_box(nodes));
  return boxes;
}

TEST_P(PaperScene, StartsAboveTheGroundAndApart) {
  const Scene scene = load();
  ASSERT_NE(scene.simulation(), nullptr);
  ASSERT_TRUE(scene.simulation()->settings.ground.has_value());
  const Ground& ground = *scene.simulation()->settings.ground;
  const std::vector<Aabb> boxes = start_boxes(scene);
  double lowest = boxes[0].lo[ground.axis];
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    EXPECT_TRUE(scene.simulation()->materials[a].has_value()) << scene.bodies[a].name;
    lowest = std::min(lowest, boxes[a].lo[ground.axis]);
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_FALSE(boxes[a].overlaps(boxes[b]))
          << scene.bodies[a].name << " " << scene.bodies[b].name;
    }
  }
  EXPECT_GT(lowest, ground.height);
  // Free fall: h = 4.905 m/s^2 t^2; the ground is reached within a quarter of a second.
  EXPECT_LT(lowest, ground.height + 0.3);
}

TEST_P(PaperScene, FallsOverAnotherBodyAcrossTheGround) {
  const Scene scene = load();
  const std::vector<Aabb> boxes = start_boxes(scene);
  // Every body but the lowest ones is above another one, or it would hit nothing but the ground.
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    if (boxes[a].lo.y() < 0.3) continue;
    EXPECT_TRUE(std::any_of(boxes.begin(), boxes.end(), [&](const Aabb& below) {
      return below.hi.y() < boxes[a].lo.y() && below.lo.x() < boxes[a].hi.x() &&
             boxes[a].lo.x() < below.hi.x() && below.lo.z() < boxes[a].hi.z() &&
             boxes[a].lo.z() < below.hi.z();
    })) << scene.bodies[a].name;
  }
}

TEST_P(PaperScene, InFullDiffersInItsMeshesAlone) {
  const Scene scene = load(), full = load("-full");
  EXPECT_GE(counts_of(full).triangles, 3 * counts_of(scene).triangles);
  EXPECT_EQ(full.time_step, scene.time_step);
  ASSERT_EQ(full.bodies.size(), scene.bodies.size());
  EXPECT_EQ(full.simulation()->velocities, scene.simulation()->velocities);
  const std::vector<std::vector<Vec3>> coarse = scene.nodes_at(0.0), fine = full.nodes_at(0.0);
  for (std::size_t b = 0; b < full.bodies.size(); ++b) {
    const Material &m = *scene.simulation()->materials[b], &n = *full.simulation()->materials[b];
    EXPECT_TRUE(m.model == n.model && m.mass == n.mass && m.stiffness == n.stiffness &&
                m.damping == n.damping);
    ASSERT_EQ(full.bodies[b].shape->lattice->nodes, scene.bodies[b].shape->lattice->nodes);
    double farthest = 0.0;
    for (std::size_t i = 0; i < fine[b].size(); ++i) {
      farthest = std::max(farthest, (fine[b][i] - coarse[b][i]).norm());
    }
    // Simplification drops the outermost vertices, which moves the lattice by some millimetres.
    EXPECT_LT(farthest, 0.005) << full.bodies[b].name;
  }
}

// "| SCENE | bodies | vertices | triangles | kept cells |" as fixtures/README.md shows counts.
std::string readme_row(const std::string& id, const Counts& counts) {
  const auto grouped = [](double count) {
    std::string digits = std::to_string(static_cast<std::size_t>(count));
    if (digits.size() > 3) digits.insert(digits.size() - 3, ",");
    return digits;
  };
  return "| " + id + " | " + grouped(counts.objects) + " | " + grouped(counts.vertices) + " | " +
         grouped(counts.triangles) + " | " + grouped(counts.cells) + " |";
}

TEST_P(PaperScene, HasTheCountsOfTheReadme) {
  const std::string readme = text::read_file_bytes(kPaperFixtures / "README.md", "README");
  for (const std::string suffix : {"", "-full"}) {
    const Scene scene = load(suffix);
    EXPECT_THAT(readme, ::testing::HasSubstr(readme_row(scene.id, counts_of(scene))));
  }
}

INSTANTIATE_TEST_SUITE_P(Table2, PaperScene, ::testing::ValuesIn(paper_counts()),
                         [](const auto& test) { return test.param.scene; });

}  // namespace
}  // namespace contactcheck::scene
