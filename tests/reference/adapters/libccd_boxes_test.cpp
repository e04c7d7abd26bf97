// libccd on the mapped FFD-AABBs of cells.
#include <gmock/gmock.h>

#include <algorithm>

#include "core/deform/ffd_aabb.h"
#include "core/types/check.h"
#include "reference/adapters/libccd_call.h"
#include "tests/reference/adapters/libccd_scenes.h"

namespace contactcheck::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

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
std::vector<ElementPair> all_pairs(const LatticeScene& scene, CcdCaller caller) {
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
  CcdSettings settings;
  for (const std::string id : kLibccd) {
    settings.algorithm = id == "libccd-gjk" ? CcdAlgorithm::kGjk : CcdAlgorithm::kMpr;
    const std::vector<ElementPair> expected = all_pairs(scene, CcdCaller(settings));
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
