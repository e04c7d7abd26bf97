#include "reference/tune/space.h"

#include <gmock/gmock.h>

#include <set>

#include "core/types/check.h"

namespace contactcheck::tune {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

DetectorCatalog core_catalog() {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  return catalog;
}

std::vector<std::string> names(const std::vector<TuneCandidate>& candidates) {
  std::vector<std::string> out;
  for (const TuneCandidate& c : candidates) out.push_back(c.detector);
  return out;
}

TEST(Space, VariesChoicesAndNumbers) {
  SpaceRequest request;
  request.detectors = {"ffd-aabb:precision=double"};
  const auto candidates = make_space(core_catalog(), request);
  EXPECT_THAT(names(candidates),
              UnorderedElementsAre("ffd-aabb", "ffd-aabb:cell=0.5", "ffd-aabb:cell=2",
                                   "ffd-aabb:bounds=safe", "ffd-aabb:bounds=safe,cell=0.5",
                                   "ffd-aabb:bounds=safe,cell=2"));
  for (const TuneCandidate& c : candidates) EXPECT_EQ(c.usual, c.detector == "ffd-aabb");
}

TEST(Space, LeavesWhatTheNameSetsAndWhatIsTheMachines) {
  SpaceRequest request;
  request.detectors = {"ffd-aabb:cell=3", "ffd-lazy"};
  for (const std::string& name : names(make_space(core_catalog(), request))) {
    EXPECT_THAT(name, Not(HasSubstr("isa=")));
    EXPECT_THAT(name, Not(HasSubstr("threads=")));
    if (name.starts_with("ffd-aabb")) {
      EXPECT_THAT(name, HasSubstr("cell=3"));
    }
  }
}

TEST(Space, TriesSinglePrecision) {
  SpaceRequest request;
  request.detectors = {"ffd-aabb:cell=1,bounds=paper"};
  EXPECT_THAT(names(make_space(core_catalog(), request)),
              IsSupersetOf({"ffd-aabb", "ffd-aabb:precision=single"}));
}

TEST(Space, LeavesWhatTheNameSetsToItsDefault) {
  SpaceRequest request;
  request.detectors = {"ffd-aabb:cell=1,bounds=paper,precision=double"};
  EXPECT_THAT(names(make_space(core_catalog(), request)), UnorderedElementsAre("ffd-aabb"));
}

TEST(Space, TakesEveryDetectorThatAnswers) {
  SpaceRequest request;
  request.question = Question::kCells;
  std::set<std::string> ids;
  for (const TuneCandidate& c : make_space(core_catalog(), request))
    ids.insert(c.choices.front().value);
  EXPECT_THAT(ids, UnorderedElementsAre("ffd-grid", "ffd-aabb", "ffd-aabb-sphere",
                                        "ffd-aabb-sphere2", "ffd-aabb-sphereN"));
}

TEST(Space, MultipliesByLattices) {
  SpaceRequest request;
  request.detectors = {"ffd-aabb:precision=double"};
  request.lattices = {1.0, 0.5};
  const auto candidates = make_space(core_catalog(), request);
  EXPECT_EQ(candidates.size(), 12u);
  EXPECT_THAT(candidates[1].choices, Contains(Choice{"lattice", "0.5"}));
  EXPECT_FALSE(candidates[1].usual);
}

TEST(Space, VariesRadiiOfSpheresByAQuarter) {
  SpaceRequest request;
  request.detectors = {"ffd-aabb-sphere:bounds=paper,cell=1,precision=double"};
  EXPECT_THAT(names(make_space(core_catalog(), request)),
              UnorderedElementsAre("ffd-aabb-sphere", "ffd-aabb-sphere:radius=0.8",
                                   "ffd-aabb-sphere:radius=1.25"));
}

TEST(Space, MultipliesByDeformersWhoseStepsCost) {
  SpaceRequest request;
  request.detectors = {"ffd-aabb:bounds=paper,cell=1,precision=double"};
  request.deformers = {{"mass-spring", 0.5}, {"shape-matching", 2.0}};
  const auto candidates = make_space(core_catalog(), request);
  ASSERT_EQ(candidates.size(), 2u);
  EXPECT_TRUE(candidates[0].usual);
  EXPECT_EQ(candidates[0].deformer, "mass-spring");
  EXPECT_FALSE(candidates[1].usual);
  EXPECT_EQ(candidates[1].step.ms, 2.0);
  EXPECT_THAT(candidates[1].choices, Contains(Choice{"deformer", "shape-matching"}));
}

TEST(Space, RefusesWhatDoesNotAnswer) {
  SpaceRequest request;
  request.question = Question::kTriangles;
  request.detectors = {"ffd-aabb"};
  try {
    make_space(core_catalog(), request);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "detector \"ffd-aabb\" does not answer the question \"triangles\"");
  }
  request.detectors = {"no-such"};
  EXPECT_THROW(make_space(core_catalog(), request), InputError);
}

}  // namespace
}  // namespace contactcheck::tune
