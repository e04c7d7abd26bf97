// What the relations show of the reference libraries: not whether an answer is right, but whether
// it stays. Where it does not is listed (library_deviations.cpp), in both directions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "core/types/check.h"
#include "tests/conformance/detectors.h"
#include "tests/hard/corpus.h"
#include "tests/metamorphic/corpus_subjects.h"
#include "tests/metamorphic/exact_ones.h"
#include "tests/metamorphic/library_deviations.h"

namespace contactcheck {
namespace {

using test::Outcome;
using test::Relation;
using test::RelationCase;

const std::vector<std::string> kLibraries = {"fcl-aabb",
                                             "fcl-obbrss",
                                             "fcl-collide",
                                             "bullet-vf",
                                             "bullet-cl",
                                             "bullet-gimpact",
                                             "libccd-gjk",
                                             "libccd-mpr",
                                             "libccd-gjk:pieces=boxes",
                                             "libccd-mpr:pieces=boxes"};

// Other sizes and places are other numbers to those who round, or have margins in metres.
const std::vector<std::string> kRelations = {
    "SwappedBodies", "FlippedWinding", "ShuffledTriangles", "ShuffledVertices",
    "TurnedCorners", "ScaledByTwo",    "TurnedToOtherAxes", "Mirrored",
    "FreshDetector", "RepeatedQuery",  "AfterOtherFrame",   "WithContacts"};

// The balls alone take GImpact minutes. With contacts asked for, FCL builds the planes of triangles
// without area, also of those whose area underflows, and says one thing or the other from run to
// run and from build to build. Of bodies that touch themselves FCL alone answers for one class,
// with triangles that lie in one plane within rounding.
bool left_out(const std::string& family) {
  return family.starts_with("hard-balls") || family.starts_with("hard-self-") ||
         family.starts_with("hard-point") || family == "hard-scale-crossing" ||
         family.find("segment") != std::string::npos;
}

std::vector<RelationCase> cases_of(const Relation& relation) {
  std::vector<RelationCase> cases;
  for (const std::string& family : test::family_ids())
    if (!left_out(family)) cases.emplace_back(relation, test::subject_of_family(family));
  return cases;
}

// Some libraries take no coordinates beyond a size: such families prove nothing about them, and are
// counted, lest more of them are refused unseen.
Outcome outcome_of(const std::string& library, std::vector<RelationCase>& cases,
                   std::uint64_t& refused) {
  Outcome sum;
  for (RelationCase& c : cases) try {
      sum.add(c.against_own([&] { return test::make_detector(library); }));
    } catch (const RefusedInput&) {
      ++refused;
    }
  return sum;
}

// FCL is templates, and where it promises nothing, what it answers depends on who compiled them,
// and on memory that nobody wrote, which sanitizers fill and which holds other values where nothing
// was optimised. The list is of what users have: g++, a release.
#if defined(__clang__) || defined(__SANITIZE_ADDRESS__) || !defined(NDEBUG)
constexpr bool kListIsOfThisBuild = false;
#else
constexpr bool kListIsOfThisBuild = true;
#endif

class LibraryRelations : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, LibraryRelations, ::testing::ValuesIn(kRelations),
                         [](const auto& p) { return p.param; });

TEST_P(LibraryRelations, HoldButForKnownDeviations) {
  const auto& all = test::relations_of_cases();
  const auto relation =
      std::ranges::find_if(all, [](const Relation& r) { return r.name == GetParam(); });
  ASSERT_NE(relation, all.end());
  std::vector<RelationCase> cases = cases_of(*relation);
  for (const std::string& library : kLibraries) {
    std::uint64_t refused = 0;
    const Outcome found = outcome_of(library, cases, refused);
    EXPECT_GT(found.elements, 100u) << library;
    if (!kListIsOfThisBuild) continue;
    test::Findings findings;
    if (refused > 0) findings["refused"] = refused;
    if (found.differing > 0) findings["answer differs"] = found.differing;
    for (const std::string& s :
         surprises(test::library_deviations(), library, GetParam(), findings))
      ADD_FAILURE() << s << found.differences;
  }
}

// An entry that names nothing could never fail.
TEST(LibraryDeviations, NameLibrariesAndRelationsThatThereAre) {
  for (const test::KnownDeviation& d : test::library_deviations()) {
    for (const std::string& library : d.detectors)
      EXPECT_EQ(std::ranges::count(kLibraries, library), 1) << library;
    for (const test::Occurrence& o : d.cases)
      EXPECT_EQ(std::ranges::count(kRelations, o.case_name), 1) << o.case_name;
  }
}

}  // namespace
}  // namespace contactcheck
