// Every relation catches the fault that is there for it, which a mere second look does not.

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "tests/metamorphic/check.h"
#include "tests/metamorphic/corpus_subjects.h"
#include "tests/metamorphic/relation_faults.h"

namespace contactcheck {
namespace {

using test::Outcome;
using test::Relation;
using test::RelationCase;
using test::RelationFault;
using test::relations_of_cases;

const Relation& relation_named(const std::string& name) {
  return *std::find_if(relations_of_cases().begin(), relations_of_cases().end(),
                       [&](const Relation& r) { return r.name == name; });
}

// Triangles in the planes of the axes for those that lose all others.
std::vector<std::string> families_for(const Relation& relation) {
  if (relation.judged_anew) return {"hard-boxes-gap"};
  return {"hard-boxes-gap", "hard-boxes-rotated", "hard-boxes-coincident", "hard-tip-on-face"};
}

Outcome found_by(const Relation& relation, const RelationFault& fault) {
  Outcome sum;
  for (const std::string& family : families_for(relation)) {
    RelationCase here(relation, test::subject_of_family(family));
    sum.add(relation.judged_anew ? here.against_truth(fault.make) : here.against_own(fault.make));
  }
  return sum;
}

class RelationFaults : public ::testing::TestWithParam<RelationFault> {};

INSTANTIATE_TEST_SUITE_P(All, RelationFaults, ::testing::ValuesIn(test::relation_faults()),
                         [](const auto& p) { return p.param.relation; });

TEST_P(RelationFaults, AreCaughtByTheRelation) {
  const Relation& relation = relation_named(GetParam().relation);
  EXPECT_GT(found_by(relation, GetParam()).differing, 0u) << GetParam().what;
  const Relation no_relation = {
      .name = "Unchanged", .variant = test::unchanged, .judged_anew = relation.judged_anew};
  const Outcome second_look = found_by(no_relation, GetParam());
  EXPECT_EQ(second_look.differing, 0u) << second_look.differences;
  EXPECT_GT(second_look.elements, 500u);
}

TEST(RelationFaults, AreThereForEveryRelation) {
  std::vector<std::string> relations, faults;
  for (const Relation& r : relations_of_cases()) relations.push_back(r.name);
  for (const RelationFault& f : test::relation_faults()) faults.push_back(f.relation);
  EXPECT_THAT(faults, ::testing::UnorderedElementsAreArray(relations));
}

}  // namespace
}  // namespace contactcheck
