// The corpus itself: as large as promised, and its truth as kept and as rational arithmetic has it.

#include "tests/hard/corpus.h"

#include <gtest/gtest.h>

#include <map>

#include "core/types/shared_corners.h"
#include "reference/judge/judge.h"
#include "reference/oracle/rational_clipping.h"
#include "reference/oracle/rational_geometry.h"

namespace contactcheck {
namespace {

using test::expected_families;
using test::family_ids;
using test::hard_family;
using test::HardFamily;

constexpr std::size_t kFewestCases = 300;

TEST(HardCorpus, HasAtLeastThreeHundredCases) {
  std::size_t cases = 0;
  for (const std::string& id : family_ids()) {
    ASSERT_TRUE(hard_family(id).scene.family()) << id;
    cases += hard_family(id).scene.family()->values.size();
  }
  EXPECT_GE(cases, kFewestCases);
}

TEST(HardCorpus, OracleGivesTheAnswersThatAreKept) {
  for (const std::string& id : family_ids()) {
    std::vector<suite::ExpectedCase> found;
    for (const suite::CaseTruth& truth : hard_family(id).truth)
      found.push_back(suite::summary_of(truth));
    ASSERT_EQ(expected_families().count(id), 1u) << id << ": contactcheck truth --write";
    const std::vector<suite::ExpectedCase>& expected = expected_families().at(id);
    ASSERT_EQ(found.size(), expected.size()) << id;
    for (std::size_t c = 0; c < found.size(); ++c)
      EXPECT_EQ(found[c], expected[c]) << id << " at " << found[c].value;
  }
  EXPECT_EQ(expected_families().size(), family_ids().size());
}

oracle::rational::TriangleCorners corners(const HardFamily& family, std::size_t value,
                                          std::size_t body, std::size_t triangle) {
  const Triangle& t = family.scene.bodies[body].shape->mesh.triangles[triangle];
  const std::vector<Vec3>& v = family.vertices[value][body];
  return {v[t[0]], v[t[1]], v[t[2]]};
}

// Of families of two triangles, all cases; of meshes it would take minutes.
TEST(HardCorpus, RationalArithmeticGivesTheTruthOfPairs) {
  std::size_t cases = 0, meeting = 0;
  for (const std::string& id : family_ids()) {
    const HardFamily& family = hard_family(id);
    std::size_t triangles = 0;
    for (const Body& body : family.scene.bodies) triangles += body.shape->mesh.triangles.size();
    if (triangles > 2 || family.scene.bodies.size() != 2) continue;
    for (std::size_t v = 0; v < family.truth.size(); ++v, ++cases) {
      const bool meet =
          oracle::rational::triangles_intersect(corners(family, v, 0, 0), corners(family, v, 1, 0));
      EXPECT_EQ(family.truth[v].triangles.size(), meet ? 1u : 0u)
          << id << " at " << family.truth[v].value;
      meeting += meet;
    }
  }
  EXPECT_GT(cases, 250u);
  EXPECT_GT(meeting, 80u);
  EXPECT_GT(cases - meeting, 80u);
}

// Of families about one body, by the definition: every two triangles that share up to two vertices,
// and what they have in common beyond the segment between these.
TEST(HardCorpus, RationalArithmeticGivesTheTruthOfBodiesThatTouchThemselves) {
  constexpr std::size_t kFew = 60;  // triangles
  std::size_t tested = 0;
  std::map<Level, std::size_t> meeting;
  for (const std::string& id : family_ids()) {
    const HardFamily& family = hard_family(id);
    const BodyShape& shape = *family.scene.bodies[0].shape;
    const std::size_t triangles = shape.mesh.triangles.size();
    if (family.scene.bodies.size() != 1 || triangles > kFew) continue;
    for (std::size_t v = 0; v < family.truth.size(); ++v) {
      std::vector<SelfPair> found;
      for (std::uint32_t a = 0; a < triangles; ++a)
        for (std::uint32_t b = a + 1; b < triangles; ++b) {
          const std::optional<Level> level = judge::self_level(shape, a, b);
          if (!level || !family.scene.judges(*level)) continue;
          ++tested;
          const auto p = corners(family, v, 0, a), q = corners(family, v, 0, b);
          const SharedCorners shared = shared_corners(shape.linked()[a], shape.linked()[b]);
          const bool meet = shared.count == 0
                                ? oracle::rational::triangles_intersect_by_clipping(p, q)
                                : oracle::rational::share_more_than(
                                      p[shared.p[0]], p[shared.p[shared.count - 1]], p, q);
          if (!meet) continue;
          found.push_back({0, a, b});
          ++meeting[*level];
        }
      EXPECT_EQ(found, family.truth[v].self) << id << " at " << family.truth[v].value;
    }
  }
  EXPECT_GT(tested, 5000u);
  for (const Level level : kSelfClasses) EXPECT_GT(meeting[level], 30u) << name_of(level);
}

// A vertex stands where the family put it, to the bit, where its lattice is one of nodes.
TEST(HardCorpus, HasGapsOfOneUnitInTheLastPlace) {
  const HardFamily& family = hard_family("hard-parallel-gap-at-1");
  EXPECT_EQ(family.truth[0].value, "0");
  EXPECT_EQ(family.truth[0].triangles.size(), 1u);
  EXPECT_EQ(family.truth[1].value, "0x1p-52");
  EXPECT_EQ(family.truth[1].triangles.size(), 0u);
  EXPECT_EQ(family.vertices[1][1][0].z(), 1.0 + 0x1p-52);
}

}  // namespace
}  // namespace contactcheck
