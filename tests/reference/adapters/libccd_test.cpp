#include <gmock/gmock.h>

#include <algorithm>
#include <thread>

#include "core/deform/ffd_aabb.h"
#include "core/types/check.h"
#include "reference/adapters/libccd_call.h"
#include "tests/reference/adapters/adapter_world.h"

namespace contactcheck::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Lt;
using ::testing::SizeIs;

constexpr const char* kLibccd[] = {"libccd-gjk", "libccd-mpr"};

std::string boxes(const std::string& id, const std::string& more = "") {
  return id + ":pieces=boxes" + more;
}

World two_spheres(double size = 1.0) {
  return World({sphere_mesh(size * Vec3(0, 0, 0), size, 3),
                sphere_mesh(size * Vec3(1.1, 0.3, 0.2), 0.9 * size, 3)});
}

World two_cubes(const Vec3& second) {
  return World({unit_box_mesh(1), box_mesh(second, second + Vec3::Ones(), 1)});
}

/// Bodies with lattices and where they are.
struct LatticeScene {
  std::vector<Body> bodies;
  FrameData data;
};

LatticeScene scene_of(const std::vector<Body>& bodies, const std::vector<Vec3>& offsets) {
  std::vector<std::vector<Vec3>> nodes;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    nodes.push_back(rest_nodes_at(*bodies[b].shape, offsets[b]));
  return {bodies, make_frame(bodies, std::move(nodes))};
}

LatticeScene lattice_cubes(const Vec3& second) {
  // This padding makes local coordinates quarters: the mapped corners are exact.
  const Body cube = make_body("cube", unit_box_mesh(1), {1, 1, 1}, 0.5);
  return scene_of({cube, cube}, {Vec3::Zero(), second});
}

/// Two of three are sheared, so that boxes differ from their bounds.
LatticeScene lattice_spheres() {
  const Body ball = make_body("ball", sphere_mesh(Vec3(0, 0, 0), 1, 3), {4, 4, 4});
  LatticeScene scene = scene_of({ball, ball, ball},
                                {Vec3(0, 0, 0), Vec3(1.47, 0.31, 0.23), Vec3(0.11, 1.73, -0.17)});
  for (const std::size_t body : {1, 2})
    for (Vec3& n : scene.data.nodes[body]) n.x() += 0.5 * n.y() - 0.3 * n.z();
  scene.data = make_frame(scene.bodies, std::move(scene.data.nodes));
  return scene;
}

std::unique_ptr<Detector> prepared(const std::string& name, const LatticeScene& scene) {
  std::unique_ptr<Detector> detector = make_detector(name);
  detector->prepare(scene.bodies);
  detector->update(scene.data.frame());
  return detector;
}

ContactSet ask_boxes(const std::string& name, const LatticeScene& scene, Question question) {
  return ask(*prepared(name, scene), question);
}

TEST(Libccd, TrianglesClaimSurfacesInDoubleWithoutExactness) {
  for (const std::string id : kLibccd) {
    const auto detector = make_detector(id);
    const Semantics& semantics = detector->semantics();
    EXPECT_THAT(semantics.levels, ElementsAre(Level::kBody, Level::kTriangle));
    EXPECT_THAT(semantics.questions, ElementsAre(Question::kTriangles, Question::kBody));
    EXPECT_EQ(semantics.closed, id == "libccd-gjk");
    EXPECT_FALSE(semantics.exact);
    EXPECT_FALSE(semantics.solid);
    EXPECT_EQ(semantics.precision, Precision::kDouble);
    EXPECT_EQ(semantics.depth, DepthKind::kNone);
    EXPECT_TRUE(detector->needs_vertices());
  }
}

TEST(Libccd, DefaultsAreThoseThatWereMeasuredBest) {
  DetectorCatalog catalog;
  adapters::register_reference_detectors(catalog);
  EXPECT_EQ(
      catalog.parse("libccd-gjk:pieces=triangles,iterations=100,scale=0,epa_tolerance=1e-12").name,
      "libccd-gjk");
  EXPECT_EQ(catalog.parse("libccd-mpr:iterations=100,scale=0,tolerance=1e-9").name, "libccd-mpr");
  EXPECT_THROW(catalog.parse("libccd-gjk:tolerance=1e-9"), InputError);
  EXPECT_THROW(catalog.parse("libccd-mpr:iterations=0"), InputError);
  EXPECT_THROW(catalog.parse("libccd-mpr:pieces=cells"), InputError);
}

TEST(Libccd, VersionSaysWhatTheFilesSayAndWhatTheyAre) {
  EXPECT_EQ(adapters::library_versions().at("libccd"), "2.1 (its own files say 2.0)");
}

TEST(Libccd, CrossingSpheresGiveTheTruePairs) {
  const World world = two_spheres();
  ASSERT_THAT(true_pairs(world), SizeIs(Gt(80u)));
  for (const std::string id : kLibccd) {
    const ContactSet contacts = ask(id, world, Question::kTriangles);
    EXPECT_EQ(compare(world, contacts.triangles), "") << id;
    EXPECT_THAT(ask(id, world, Question::kBody).bodies, ElementsAre(BodyPair{0, 1})) << id;
  }
}

// libccd 2.1, prior work C9: the same spheres, 1 cm wide.
TEST(Libccd, GjkLosesPairsOfSmallSpheresAtScale1AndNoneScaled) {
  const World world = two_spheres(0.01);
  const std::vector<ElementPair> truth = true_pairs(world);
  const auto missed = [&](const std::string& name) {
    return without(truth, ask(name, world, Question::kTriangles).triangles).size();
  };
  EXPECT_THAT(missed("libccd-gjk:scale=1"), Gt(truth.size() / 2));
  for (const char* right : {"libccd-gjk", "libccd-gjk:scale=1024", "libccd-mpr"})
    EXPECT_EQ(missed(right), 0u) << right;
}

TEST(Libccd, FindsTheSamePairsAtEverySize) {
  const std::vector<ElementPair> truth = true_pairs(two_spheres());
  for (const double size : {0x1p-1000, 0x1p-500, 0x1p-30, 0x1p-9, 0x1p9, 0x1p30, 0x1p500, 0x1p1000})
    for (const std::string id : kLibccd)
      EXPECT_EQ(ask(id, two_spheres(size), Question::kTriangles).triangles, truth) << id << size;
}

TEST(Libccd, TolerancesAreThoseOfTheOptions) {
  const World world = two_spheres();
  const auto found = [&](const std::string& name) {
    return ask(name, world, Question::kTriangles).triangles.size();
  };
  EXPECT_LT(found("libccd-mpr:scale=1,tolerance=1"), found("libccd-mpr"));
  const LatticeScene scene = lattice_spheres();
  const auto sum_of_depths = [&](const std::string& name) {
    double sum = 0.0;
    for (const PieceContact& c : ask_boxes(name, scene, Question::kContacts).piece_contacts)
      sum += c.depth;
    return sum;
  };
  EXPECT_LT(sum_of_depths(boxes("libccd-gjk", ",epa_tolerance=1")),
            sum_of_depths(boxes("libccd-gjk")));
}

TEST(Libccd, BodiesApartAndContainedAreNoContactOfTriangles) {
  for (const std::string id : kLibccd) {
    for (const double radius : {0.5, 0.1}) {
      const Vec3 center = radius == 0.5 ? Vec3(1.2, 1.2, 0) : Vec3(0.2, 0.1, 0.1);
      const World world({sphere_mesh(Vec3(0, 0, 0), 1, 3), sphere_mesh(center, radius, 2)});
      EXPECT_THAT(ask(id, world, Question::kTriangles).triangles, IsEmpty());
      EXPECT_THAT(ask(id, world, Question::kBody).bodies, IsEmpty());
    }
  }
}

// libccd 2.1, prior work C8: one library, two answers. Mended when this fails.
TEST(Libccd, TouchingIsContactForGjkAndOftenNoneForMpr) {
  const World world = two_cubes(Vec3(1, 0.25, 0.25));
  ASSERT_THAT(true_pairs(world), SizeIs(Gt(3u)));
  EXPECT_THAT(ask("libccd-gjk", world, Question::kBody).bodies, SizeIs(1));
  // Of cubes face on face MPR says no, and yes when one is moved along the face.
  for (const Vec3& second : {Vec3(1, 0, 0), Vec3(1, 0.25, 0.25)}) {
    const LatticeScene scene = lattice_cubes(second);
    EXPECT_THAT(ask_boxes(boxes("libccd-gjk"), scene, Question::kCells).cells, SizeIs(1));
    EXPECT_THAT(ask_boxes(boxes("libccd-mpr"), scene, Question::kCells).cells,
                SizeIs(second.y() == 0 ? 0 : 1));
  }
  // Of two coplanar triangles MPR says no whatever they share.
  const World plane({triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)),
                     triangle_mesh(Vec3(0.1, 0.1, 0), Vec3(1, 0.2, 0), Vec3(0.2, 1, 0))});
  EXPECT_THAT(ask("libccd-gjk", plane, Question::kTriangles).triangles, SizeIs(1));
  EXPECT_THAT(ask("libccd-mpr", plane, Question::kTriangles).triangles, IsEmpty());
}

/// Names and numbers of both stages; the last one reports.
void check_stages(const StageTrace& trace, const std::string& broad, const std::string& unit,
                  std::size_t reported) {
  ASSERT_THAT(trace.stages, SizeIs(2));
  const StageRecord &first = trace.stages[0], &second = trace.stages[1];
  EXPECT_EQ(first.name, broad);
  EXPECT_EQ(first.unit, unit);
  EXPECT_THAT(first.visited, AllOf(Gt(0u), Lt(first.in)));
  EXPECT_THAT(first.out, AllOf(Lt(first.in), Gt(reported)));
  EXPECT_EQ(second.in, first.out);
  EXPECT_EQ(second.out, reported);
  EXPECT_EQ(second.visited_unit, "support calls");
  // At least one point is looked at per candidate; libccd needs a few.
  EXPECT_THAT(second.visited, AllOf(Gt(second.in), Lt(20 * second.in)));
}

TEST(Libccd, StagesCountCandidatesAndSupportCalls) {
  const World world = two_spheres();
  const LatticeScene scene = lattice_spheres();
  for (const std::string id : kLibccd) {
    const std::size_t triangles = ask(id, world, Question::kTriangles).triangles.size();
    const auto of_triangles = prepared(id, world), of_boxes = prepared(boxes(id), scene);
    check_stages(of_triangles->trace(), "aabb-tree", "triangle pairs", triangles);
    const std::size_t cells = ask_boxes(boxes(id), scene, Question::kCells).cells.size();
    check_stages(of_boxes->trace(), "boxes", "box pairs", cells);
    // What was counted before is no part of it.
    for (Detector* detector : {of_triangles.get(), of_boxes.get()})
      EXPECT_EQ(detector->trace().stages[1].visited, detector->trace().stages[1].visited);
  }
}

TEST(Libccd, OneIterationEndsAndIsNoted) {
  const World world = two_spheres();
  const LatticeScene scene = lattice_spheres();
  const std::string few = "iterations=1";
  // MPR's first portal settles most pairs.
  for (const std::string id : kLibccd) {
    const auto triangles = prepared(id + ":" + few, world);
    EXPECT_THAT(triangles->notes(), IsEmpty());
    const std::size_t found = ask(*triangles, Question::kTriangles).triangles.size();
    EXPECT_LT(found, true_pairs(world).size());
    EXPECT_THAT(triangles->notes(), ElementsAre(HasSubstr("count as no contact"))) << id;
    const auto cells = prepared(boxes(id, "," + few), scene);
    ask(*cells, Question::kCells);
    EXPECT_THAT(cells->notes(), ElementsAre(HasSubstr("count as no contact"))) << id;
  }
}

TEST(Libccd, NotesAreThoseOfTheLastFrame) {
  World world = two_spheres();
  const auto detector = prepared("libccd-gjk:iterations=1", world);
  ask(*detector, Question::kTriangles);
  EXPECT_THAT(detector->notes(), SizeIs(1));
  for (Vec3& v : world.vertices[1]) v += Vec3(9, 0, 0);
  detector->update(world.frame());
  ask(*detector, Question::kTriangles);
  EXPECT_THAT(detector->notes(), IsEmpty());
}

TEST(Libccd, SwappedBodiesGiveTheSamePairsTurnedRound) {
  const World world = two_spheres();
  const World swapped({sphere_mesh(Vec3(1.1, 0.3, 0.2), 0.9, 3), sphere_mesh(Vec3(0, 0, 0), 1, 3)});
  for (const std::string id : kLibccd) {
    std::vector<ElementPair> turned;
    for (const ElementPair& p : ask(id, swapped, Question::kTriangles).triangles)
      turned.push_back({0, 1, p.b, p.a});
    canonicalize(turned);
    EXPECT_EQ(turned, ask(id, world, Question::kTriangles).triangles) << id;
  }
}

TEST(Libccd, EarlierFramesLeaveNoTrace) {
  const LatticeScene scene = lattice_spheres();
  const LatticeScene moved =
      scene_of(scene.bodies, {Vec3(0, 0, 0), Vec3(0.4, 0.1, 0), Vec3(60, 0, 5)});
  World world = two_spheres();
  const World start = world;
  for (Vec3& v : world.vertices[1]) v = 10.0 * v;
  for (const std::string id : kLibccd) {
    const auto triangles = prepared(id, world);
    ask(*triangles, Question::kTriangles);
    triangles->update(start.frame());
    EXPECT_EQ(ask(*triangles, Question::kTriangles).triangles,
              ask(id, start, Question::kTriangles).triangles);
    const auto cells = prepared(boxes(id), moved);
    ask(*cells, Question::kContacts);
    cells->update(scene.data.frame());
    const ContactSet again = ask(*cells, Question::kContacts);
    const ContactSet fresh = ask_boxes(boxes(id), scene, Question::kContacts);
    EXPECT_EQ(again.cells, fresh.cells);
    ASSERT_EQ(again.piece_contacts.size(), fresh.piece_contacts.size());
    for (std::size_t i = 0; i < again.piece_contacts.size(); ++i)
      EXPECT_EQ(again.piece_contacts[i].depth, fresh.piece_contacts[i].depth);
  }
}

TEST(Libccd, NoBodiesAndOneBodyHaveNoContact) {
  const Body cube = make_body("cube", unit_box_mesh(1), {1, 1, 1});
  for (const std::string id : kLibccd) {
    for (const std::string& name : {id, boxes(id)}) {
      EXPECT_THAT(ask_boxes(name, scene_of({}, {}), Question::kBody).bodies, IsEmpty());
      EXPECT_THAT(ask_boxes(name, scene_of({cube}, {Vec3::Zero()}), Question::kBody).bodies,
                  IsEmpty());
    }
  }
}

// What a call counts and where it stops belongs to that call.
TEST(Libccd, TwoThreadsWithLimitsOfTheirOwn) {
  const World world = two_spheres();
  const LatticeScene scene = lattice_spheres();
  for (const std::string id : kLibccd) {
    const std::string few = id + ":iterations=1";
    const ContactSet alone = ask(few, world, Question::kTriangles);
    const ContactSet cells_alone = ask_boxes(boxes(id), scene, Question::kContacts);
    ContactSet together, cells_together;
    std::thread other([&] {
      for (int i = 0; i < 5; ++i) cells_together = ask_boxes(boxes(id), scene, Question::kContacts);
    });
    for (int i = 0; i < 5; ++i) together = ask(few, world, Question::kTriangles);
    other.join();
    EXPECT_EQ(together.triangles, alone.triangles);
    EXPECT_EQ(cells_together.cells, cells_alone.cells);
    EXPECT_EQ(cells_together.piece_contacts.size(), cells_alone.piece_contacts.size());
  }
}

// --- On the mapped FFD-AABBs of cells ---

TEST(LibccdBoxes, ClaimCellsAndDepthAndNeedNoVertices) {
  for (const std::string id : kLibccd) {
    const auto detector = make_detector(boxes(id));
    const Semantics& semantics = detector->semantics();
    EXPECT_THAT(semantics.levels, ElementsAre(Level::kBody, Level::kCell, Level::kBox));
    EXPECT_THAT(semantics.questions,
                ElementsAre(Question::kCells, Question::kContacts, Question::kBody));
    EXPECT_EQ(semantics.closed, id == "libccd-gjk");
    EXPECT_FALSE(semantics.exact);
    EXPECT_EQ(semantics.depth, DepthKind::kConvexPair);
    EXPECT_THAT(semantics.means, HasSubstr("FFD-AABB"));
    EXPECT_FALSE(detector->needs_vertices());
  }
}

TEST(LibccdBoxes, ContactsHaveTheDepthAndTheWayOutOfTheSecondBody) {
  for (const std::string id : kLibccd) {
    for (const double sign : {1.0, -1.0}) {
      const LatticeScene scene = lattice_cubes(sign * Vec3(0.9, 0.13, 0.07));
      const ContactSet contacts = ask_boxes(boxes(id), scene, Question::kContacts);
      EXPECT_THAT(contacts.cells, ElementsAre(ElementPair{0, 1, 0, 0}));
      EXPECT_THAT(contacts.bodies, ElementsAre(BodyPair{0, 1}));
      ASSERT_THAT(contacts.piece_contacts, SizeIs(1));
      EXPECT_EQ(contacts.piece_contacts[0].pieces, (ElementPair{0, 1, 0, 0}));
      EXPECT_NEAR(contacts.piece_contacts[0].depth, 0.1, 1e-9);
      EXPECT_NEAR((contacts.piece_contacts[0].normal - sign * Vec3::UnitX()).norm(), 0.0, 1e-6);
    }
  }
}

// libccd 2.1, prior work C4 and C7: a touch has no direction.
TEST(LibccdBoxes, ContactWithoutADirectionIsAContactWithoutADepth) {
  const auto gjk = prepared(boxes("libccd-gjk"), lattice_cubes(Vec3(1, 0.25, 0.25)));
  EXPECT_THAT(ask(*gjk, Question::kCells).cells, SizeIs(1));
  EXPECT_THAT(gjk->notes(), IsEmpty());
  const ContactSet contacts = ask(*gjk, Question::kContacts);
  EXPECT_THAT(contacts.cells, SizeIs(1));
  EXPECT_THAT(contacts.piece_contacts, IsEmpty());
  EXPECT_THAT(gjk->notes(), ElementsAre(HasSubstr("no finite depth or no direction")));
}

TEST(LibccdBoxes, AllQuestionsAgree) {
  const LatticeScene scene = lattice_spheres();
  for (const std::string id : kLibccd) {
    const auto detector = prepared(boxes(id), scene);
    const ContactSet cells = ask(*detector, Question::kCells);
    EXPECT_THAT(cells.cells, SizeIs(Gt(20u)));
    EXPECT_THAT(cells.bodies, SizeIs(Gt(1u)));
    EXPECT_EQ(ask(*detector, Question::kBody).bodies, cells.bodies);
    ContactSet raw;
    detector->query(Question::kBody, raw);
    EXPECT_THAT(raw.bodies, SizeIs(cells.bodies.size()));  // each once
    EXPECT_THAT(raw.cells, IsEmpty());
    const ContactSet contacts = ask(*detector, Question::kContacts);
    EXPECT_EQ(contacts.cells, cells.cells);
    EXPECT_THAT(contacts.piece_contacts, SizeIs(Gt(cells.cells.size() / 2)));
    for (const PieceContact& c : contacts.piece_contacts) {
      EXPECT_GE(c.depth, 0.0);
      EXPECT_NEAR(c.normal.norm(), 1.0, 1e-9);
      EXPECT_TRUE(std::binary_search(cells.cells.begin(), cells.cells.end(), c.pieces));
    }
  }
}

/// libccd asked about every two cells of different bodies.
std::vector<ElementPair> all_pairs(const LatticeScene& scene, adapters::CcdCaller caller) {
  std::vector<std::vector<Corners>> corners;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodyShape& shape = *scene.bodies[b].shape;
    const std::vector<Aabb> local = ffd_aabbs(shape.mesh, *shape.lattice, shape.embedding);
    corners.emplace_back();
    for (std::uint32_t cell = 0; cell < local.size(); ++cell)
      corners.back().push_back(mapped_box(*shape.lattice, cell, local[cell], scene.data.nodes[b]));
  }
  std::vector<ElementPair> out;
  for (std::uint32_t a = 0; a < corners.size(); ++a)
    for (std::uint32_t b = a + 1; b < corners.size(); ++b)
      for (std::uint32_t i = 0; i < corners[a].size(); ++i)
        for (std::uint32_t j = 0; j < corners[b].size(); ++j)
          if (caller.intersect(corners[a][i], corners[b][j])) out.push_back({a, b, i, j});
  return out;
}

TEST(LibccdBoxes, ReportsWhatLibccdSaysAboutEveryTwoCells) {
  const LatticeScene scene = lattice_spheres();
  adapters::CcdSettings settings;
  for (const std::string id : kLibccd) {
    settings.algorithm =
        id == "libccd-gjk" ? adapters::CcdAlgorithm::kGjk : adapters::CcdAlgorithm::kMpr;
    const std::vector<ElementPair> expected = all_pairs(scene, adapters::CcdCaller(settings));
    EXPECT_EQ(ask_boxes(boxes(id), scene, Question::kCells).cells, expected) << id;
  }
}

TEST(LibccdBoxes, NotesAreThoseOfTheLastFrame) {
  const LatticeScene touching = lattice_cubes(Vec3(1, 0.25, 0.25));
  const auto detector = prepared(boxes("libccd-gjk"), touching);
  ask(*detector, Question::kContacts);
  EXPECT_THAT(detector->notes(), SizeIs(1));
  const LatticeScene apart = scene_of(touching.bodies, {Vec3::Zero(), Vec3(9, 0, 0)});
  detector->update(apart.data.frame());
  ask(*detector, Question::kContacts);
  EXPECT_THAT(detector->notes(), IsEmpty());
}

TEST(LibccdBoxes, PrepareAgainForgetsTheFirstScene) {
  const LatticeScene first = lattice_spheres(), second = lattice_cubes(Vec3(0.9, 0.13, 0.07));
  const auto detector = prepared(boxes("libccd-gjk"), first);
  detector->prepare(second.bodies);
  detector->update(second.data.frame());
  EXPECT_THAT(ask(*detector, Question::kCells).cells, ElementsAre(ElementPair{0, 1, 0, 0}));
}

TEST(LibccdBoxes, RefuseABodyWithoutALatticeByName) {
  const World world = two_spheres();
  for (const std::string id : kLibccd) {
    try {
      make_detector(boxes(id))->prepare(world.bodies);
      ADD_FAILURE() << "not refused";
    } catch (const RefusedInput& refused) {
      EXPECT_THAT(refused.what(), AllOf(HasSubstr("body 0"), HasSubstr("lattice")));
    }
  }
}

}  // namespace
}  // namespace contactcheck::test
