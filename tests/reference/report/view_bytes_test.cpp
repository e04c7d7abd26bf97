#include "reference/report/formats/view_bytes.h"

#include <gmock/gmock.h>

#include "core/broad/sphere_tree.h"
#include "core/deform/mapping.h"
#include "core/deform/recording.h"
#include "core/detect/ffd_state.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/view_reader.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/shapes.h"

namespace contactcheck::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::ViewReader;
using testing::HasSubstr;

constexpr const char* kContacts =
    R"({"schema": "contactcheck-contacts/1", "scene": "boxes", "limit": 500,
        "truth": [{"frame": 1, "count": 1, "pairs": [0, 3, 1, 5]}],
        "detectors": [{"detector": "d", "level": "triangle", "frames": [
          {"frame": 1, "missed": {"count": 1, "pairs": [0, 3, 1, 5]},
           "spurious": {"count": 0, "pairs": []}}]}]})";

// Two instances of a box in a lattice, and a bare triangle far out; the second frame is bent.
Recording boxes() {
  Recording out;
  out.scene = "boxes";
  out.time_step = 0.25;
  const Body box = test::make_body("left", test::unit_box_mesh(2), {3, 3, 3});
  const auto bare = make_bare_shape(test::triangle_mesh({9, 0, 0}, {9, 1, 0}, {9, 0, 1}));
  out.bodies = {box, {"right", box.shape}, {"plate", bare}};
  for (int f = 0; f < 2; ++f) {
    std::vector<Vec3> left = test::rest_nodes_at(*box.shape, {0, 0, 0});
    for (Vec3& p : left) p.x() += 0.3 * f * p.y() * p.z();
    out.frames.push_back(
        {left, test::rest_nodes_at(*box.shape, {0.9 + 0.01 * f, 0.1, 0.2}), bare->mesh.vertices});
  }
  return out;
}

Json results_naming(const std::string& recording, const std::string& contacts) {
  Json scene = {{"id", "boxes"}};
  if (!contacts.empty()) scene["contacts"] = contacts;
  const Json run = {{"scene", "boxes"}, {"detector", "d"}, {"recording", recording}};
  return {{"scenes", Json::array({scene})}, {"runs", Json::array({run})}};
}

class ViewBytes : public testing::Test {
 protected:
  ViewBytes() {
    write_recording(scratch_.folder() / "boxes.ccr", recording_);
    scratch_.write("boxes.json", kContacts);
  }
  ViewReader view(const std::string& recording = "boxes.ccr",
                  const std::string& contacts = "boxes.json") const {
    return ViewReader(
        view_bytes(results::from_json(results_naming(recording, contacts)), scratch_.folder()));
  }
  std::string left_out(const std::string& recording, const std::string& contacts) const {
    const ViewReader reader = view(recording, contacts);
    EXPECT_EQ(reader.header().at("scenes").size(), 0u);
    EXPECT_EQ(reader.header().at("left_out").at(0).at("scene"), "boxes");
    return reader.header().at("left_out").at(0).at("why");
  }

  const test::Scratch scratch_;
  const Recording recording_ = boxes();
};

Vec3 point(const std::vector<double>& flat, std::size_t number) {
  return {flat.at(3 * number), flat.at(3 * number + 1), flat.at(3 * number + 2)};
}

Vec3 origin_of(const Json& scene) {
  const Json& at = scene.at("placements").at(0).at("origin");
  return {at.at(0).get<double>(), at.at(1).get<double>(), at.at(2).get<double>()};
}

double scale_of(const Json& scene) { return scene.at("placements").at(0).at("scale"); }

// The corners of a cell, read from the container, in metres.
Corners corners_in(const std::vector<double>& cell_nodes, const std::vector<double>& nodes,
                   std::size_t first_node, std::size_t cell, const Json& scene) {
  Corners out;
  for (std::size_t c = 0; c < 8; ++c)
    out[c] = origin_of(scene) +
             scale_of(scene) *
                 point(nodes, first_node + static_cast<std::size_t>(cell_nodes.at(8 * cell + c)));
  return out;
}

TEST_F(ViewBytes, SaysWhatThePairsOfEachLevelCount) {
  std::string detectors;
  for (const Level level : kLevels)
    detectors += std::string(detectors.empty() ? "" : ", ") + R"({"detector": "d", "level": ")" +
                 name_of(level) + R"(", "frames": []})";
  scratch_.write("levels.json", R"({"schema": "contactcheck-contacts/1", "scene": "boxes",
      "limit": 500, "truth": [], "detectors": [)" +
                                    detectors + "]}");
  const std::map<std::string, std::string> others = {
      {"body", R"({"missed":["body","body"],"spurious":["body","body"]})"},
      {"containment", R"({"missed":["body","body"],"spurious":["body","body"]})"},
      {"self-body", R"({"missed":["body","body"],"spurious":["body","body"]})"},
      {"cell", R"({"missed":["triangle","triangle"],"spurious":["cell","cell"]})"},
      {"self-cell", R"({"missed":["triangle","triangle"],"spurious":["cell","cell"]})"},
      {"box", R"({"missed":["cell","cell"],"spurious":["cell","cell"]})"},
      {"vertex", R"({"missed":["vertex","nothing"],"spurious":["vertex","nothing"]})"},
      {"near", R"({"missed":["vertex","triangle"],"spurious":["vertex","triangle"]})"},
      {"self-near", R"({"missed":["vertex","triangle"],"spurious":["vertex","triangle"]})"},
      {"impact-vf", R"({"missed":["vertex","triangle"],"spurious":["vertex","triangle"]})"},
      {"impact-ee", R"({"missed":["edge","edge"],"spurious":["edge","edge"]})"},
      {"impact", R"({"missed":["body","body"],"spurious":["body","body"]})"},
      {"impact-self-vf", R"({"missed":["vertex","triangle"],"spurious":["vertex","triangle"]})"},
      {"impact-self-ee", R"({"missed":["edge","edge"],"spurious":["edge","edge"]})"}};
  const ViewReader reader = view("boxes.ccr", "levels.json");
  for (const Json& detector : reader.scene(0).at("detectors")) {
    const auto found = others.find(detector.at("level"));
    EXPECT_EQ(detector.at("elements").dump(),
              found == others.end()
                  ? R"({"missed":["triangle","triangle"],"spurious":["triangle","triangle"]})"
                  : found->second)
        << detector.at("level");
  }
}

TEST_F(ViewBytes, HoldTheSceneOnce) {
  const ViewReader reader = view();
  const Json& scene = reader.scene(0);
  EXPECT_EQ(scene.at("id"), "boxes");
  EXPECT_EQ(scene.at("frames"), 2);
  EXPECT_EQ(scene.at("time_step"), 0.25);
  EXPECT_EQ(scene.at("shapes").size(), 2u);
  EXPECT_EQ(scene.at("bodies"), Json::parse(R"([{"name": "left", "shape": 0},
      {"name": "right", "shape": 0}, {"name": "plate", "shape": 1}])"));
  EXPECT_EQ(scene.at("shapes").at(0).at("vertices"), 26);
  EXPECT_EQ(scene.at("shapes").at(0).at("triangles").at("count"), 3 * 48);
  EXPECT_EQ(scene.at("shapes").at(0).at("triangles").at("type"), "u16");
  EXPECT_FALSE(scene.at("shapes").at(1).contains("lattice"));
  EXPECT_EQ(reader.array(scene, scene.at("shapes").at(1).at("triangles")),
            (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(scene.at("truth"), Json::parse(kContacts).at("truth"));
  Json detectors = Json::parse(kContacts).at("detectors");
  detectors[0]["elements"] = {{"missed", {"triangle", "triangle"}},
                              {"spurious", {"triangle", "triangle"}}};
  EXPECT_EQ(scene.at("detectors"), detectors);
}

TEST_F(ViewBytes, MapToTheDeformedVerticesInSinglePrecision) {
  const ViewReader reader = view();
  const Json& scene = reader.scene(0);
  const Json& lattice = scene.at("shapes").at(0).at("lattice");
  const std::vector<double> home = reader.array(scene, lattice.at("home"));
  const std::vector<double> local = reader.array(scene, lattice.at("local"));
  const std::vector<double> cell_nodes = reader.array(scene, lattice.at("cell_nodes"));
  const std::vector<double> nodes = reader.array(scene, scene.at("nodes"));
  const BodyShape& shape = *recording_.bodies[0].shape;
  const std::size_t per_frame = 2 * shape.node_count() + 3;
  ASSERT_EQ(nodes.size(), 3 * 2 * per_frame);
  for (std::size_t body : {0, 1}) {
    std::vector<Vec3> truth(shape.mesh.vertices.size());
    map_body(shape, recording_.frames[1][body], truth);
    for (std::size_t v = 0; v < truth.size(); ++v) {
      const Corners corners = corners_in(cell_nodes, nodes, per_frame + body * shape.node_count(),
                                         static_cast<std::size_t>(home.at(v)), scene);
      EXPECT_LT((map_point(corners, point(local, v)) - truth[v]).norm(), 1e-6) << body << " " << v;
    }
  }
  EXPECT_LT(
      (origin_of(scene) + scale_of(scene) * point(nodes, 2 * per_frame - 3) - Vec3(9, 0, 0)).norm(),
      1e-6);
}

TEST_F(ViewBytes, HoldTheBoxesAndSpheresOfThePaper) {
  const ViewReader reader = view();
  const Json& scene = reader.scene(0);
  const Json& lattice = scene.at("shapes").at(0).at("lattice");
  FfdConfig config;
  config.sphere_levels = 2;
  const FfdModel model = make_ffd_model(*recording_.bodies[0].shape, config);
  const std::vector<double> boxes = reader.array(scene, lattice.at("boxes"));
  ASSERT_EQ(boxes.size(), 6 * model.pieces.size());
  ASSERT_EQ(model.pieces.size(), recording_.bodies[0].shape->lattice->cells.size());
  for (std::size_t p = 0; p < model.pieces.size(); ++p) {
    EXPECT_LT((point(boxes, 2 * p) - model.pieces[p].local.lo).norm(), 1e-6);
    EXPECT_LT((point(boxes, 2 * p + 1) - model.pieces[p].local.hi).norm(), 1e-6);
  }
  const Json& spheres = lattice.at("spheres");
  EXPECT_EQ(spheres.at("radius1"), model.rest_radius[0][0]);
  EXPECT_EQ(spheres.at("radii2").get<std::vector<double>>(), model.rest_radius[1]);
  const std::vector<double> centers = reader.array(scene, spheres.at("centers2"));
  ASSERT_EQ(centers.size(), 16u);
  for (std::size_t s = 0; s < centers.size(); ++s)
    EXPECT_EQ(centers[s], model.spheres.levels[1][s].center_node);
}

TEST_F(ViewBytes, OfASceneWithoutNamedContactsHaveNoPairs) {
  const ViewReader reader = view("boxes.ccr", "");
  EXPECT_EQ(reader.scene(0).at("truth"), Json::array());
  EXPECT_EQ(reader.scene(0).at("detectors"), Json::array());
}

TEST_F(ViewBytes, NameTheScenesWhoseFilesAreMissingOrBad) {
  EXPECT_EQ(left_out("none.ccr", "boxes.json"), "\"none.ccr\" does not exist.");
  EXPECT_EQ(left_out(".", "boxes.json"), "\".\" is a folder, not a regular file.");
  EXPECT_EQ(left_out("boxes.ccr", "none.json"), "\"none.json\" does not exist.");
  EXPECT_THAT(left_out("boxes.json", "boxes.json"), HasSubstr("recording \"boxes.json\": "));
  EXPECT_THAT(left_out("boxes.ccr", "boxes.ccr"),
              HasSubstr("contacts \"boxes.ccr\": it is no JSON (at byte 1)"));
  Recording other = recording_;
  other.scene = "other";
  write_recording(scratch_.folder() / "other.ccr", other);
  EXPECT_EQ(left_out("other.ccr", "boxes.json"),
            "recording \"other.ccr\": it is of the scene \"other\".");
}

TEST_F(ViewBytes, KeepTheSmallestScenesBelowTheLimit) {
  Recording large = recording_;
  large.scene = "large";
  while (large.frames.size() < 200) {
    large.frames.push_back(large.frames.back());
    for (Vec3& p : large.frames.back()[0]) p *= 1.001;  // not to be compressed away
  }
  write_recording(scratch_.folder() / "large.ccr", large);
  Json results = results_naming("boxes.ccr", "boxes.json");
  results["scenes"].insert(results["scenes"].begin(), Json{{"id", "large"}});
  results["runs"].push_back({{"scene", "large"}, {"recording", "large.ccr"}});
  EXPECT_EQ(ViewReader(view_bytes(results::from_json(results), scratch_.folder()))
                .header()
                .at("scenes")
                .size(),
            2u);
  const std::string bytes = view_bytes(results::from_json(results), scratch_.folder(), 10'000);
  const ViewReader reader(bytes);
  ASSERT_EQ(reader.header().at("scenes").size(), 1u);
  EXPECT_EQ(reader.scene(0).at("id"), "boxes");
  EXPECT_EQ(reader.header().at("left_out").at(0).at("scene"), "large");
  EXPECT_EQ(reader.header().at("left_out").at(0).at("why"),
            "it does not fit into the 10 kB that the report has for 3D scenes; the smallest ones "
            "come first.");
}

// A box of 60,000 triangles that moves without a lattice above one in a lattice.
TEST_F(ViewBytes, OfALargeSceneHoldWhatIsNearItsContacts) {
  const TriangleMesh mesh = test::unit_box_mesh(71);
  Recording large;
  large.scene = "boxes";
  large.time_step = 0.25;
  const auto bare = make_bare_shape(mesh);
  const Body box = test::make_body("box", mesh, {3, 3, 3});
  large.bodies = {{"bare", bare}, box};
  for (int f = 0; f < 2; ++f) {
    std::vector<Vec3> moved = mesh.vertices;
    for (Vec3& p : moved) p.z() += 1.5 + 0.1 * f + 1e-3 * p.x() * p.y();
    large.frames.push_back({moved, test::rest_nodes_at(*box.shape, {0, 0, 0})});
  }
  write_recording(scratch_.folder() / "boxes.ccr", large);
  scratch_.write("boxes.json", R"({"schema": "contactcheck-contacts/1", "scene": "boxes",
      "limit": 500, "truth": [{"frame": 1, "count": 1, "pairs": [0, 3000, 1, 5]}],
      "detectors": [{"detector": "d", "level": "near", "frames": [
        {"frame": 0, "missed": {"count": 1, "pairs": [0, 4321, 1, 9000]},
         "spurious": {"count": 0, "pairs": []}}]}]})");
  const results::Results results = results::from_json(results_naming("boxes.ccr", "boxes.json"));
  EXPECT_FALSE(ViewReader(view_bytes(results, scratch_.folder(), 10'000'000))
                   .scene(0)
                   .at("shapes")
                   .at(0)
                   .contains("kept"))
      << "all fits";
  const std::string bytes = view_bytes(results, scratch_.folder(), 400'000);
  const ViewReader reader(bytes);
  const Json& scene = reader.scene(0);
  const std::vector<double> nodes = reader.array(scene, scene.at("nodes"));
  std::size_t triangles_kept = 0;
  for (const std::size_t s : {0, 1}) {
    const Json& shape = scene.at("shapes").at(s);
    const std::vector<double> triangles = reader.array(scene, shape.at("triangles")),
                              kept = reader.array(scene, shape.at("kept").at("triangles")),
                              vertices = reader.array(scene, shape.at("kept").at("vertices"));
    ASSERT_EQ(triangles.size(), 3 * kept.size());
    EXPECT_EQ(shape.at("vertices"), vertices.size());
    triangles_kept += kept.size();
    for (std::size_t t = 0; t < kept.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(vertices.at(static_cast<std::size_t>(triangles[3 * t + k])),
                  mesh.triangles[static_cast<std::size_t>(kept[t])][k]);
    const auto has = [](const std::vector<double>& all, double id) {
      return std::binary_search(all.begin(), all.end(), id);
    };
    EXPECT_TRUE(has(kept, s == 0 ? 3000 : 5));
    EXPECT_TRUE(s == 0 ? has(vertices, 4321) : has(kept, 9000));
  }
  EXPECT_EQ(scene.at("detectors").at(0).at("elements").dump(),
            R"({"missed":["vertex","triangle"],"spurious":["vertex","triangle"]})");
  EXPECT_GT(triangles_kept, 20'000u);
  EXPECT_LT(triangles_kept, mesh.triangles.size());
  // The bare body's nodes are its kept vertices.
  const Json& bare_shape = scene.at("shapes").at(0);
  const std::vector<double> vertices = reader.array(scene, bare_shape.at("kept").at("vertices"));
  EXPECT_EQ(bare_shape.at("nodes"), vertices.size());
  EXPECT_EQ(nodes.size(), 3 * 2 * (vertices.size() + box.shape->node_count()));
  EXPECT_LT((origin_of(scene) + scale_of(scene) * point(nodes, 1) -
             large.frames[0][0][static_cast<std::size_t>(vertices[1])])
                .norm(),
            1e-6);
}

TEST_F(ViewBytes, LeaveOutUnreadWhatIsFarTooLarge) {
  scratch_.write("boxes.ccr", std::string(50'050, 'x'));
  const ViewReader reader(view_bytes(results::from_json(results_naming("boxes.ccr", "boxes.json")),
                                     scratch_.folder(), 1000));
  EXPECT_THAT(reader.header().at("left_out").at(0).at("why"),
              HasSubstr("it does not fit into the 1 kB that the report has for 3D scenes"));
}

TEST_F(ViewBytes, WithoutRecordingsAreNone) {
  EXPECT_EQ(view_bytes(results::from_json(results_naming("", "")), scratch_.folder()), "");
  EXPECT_EQ(view_bytes({}, scratch_.folder()), "");
}

}  // namespace
}  // namespace contactcheck::report
