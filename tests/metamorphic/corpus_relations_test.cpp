// Every relation over every hard case, for every detector that promises to be exact and for the
// oracle: one test per relation and detector, which names the cases that fail.

#include <gtest/gtest.h>

#include "tests/conformance/detectors.h"
#include "tests/metamorphic/corpus_subjects.h"
#include "tests/metamorphic/exact_ones.h"

namespace contactcheck {
namespace {

using test::Outcome;
using test::Relation;
using test::RelationCase;

// Of the corpus. A relation that leaves out more, or finds less to compare, proves little.
constexpr std::size_t kFewestFrames = 400, kFewestElements = 10'000;

// A relation's variants serve all detectors; tests come relation by relation, so one is kept.
std::vector<RelationCase>& cases_of(const Relation& relation) {
  static const Relation* of = nullptr;
  static std::vector<RelationCase> cases;
  if (of != &relation) {
    of = &relation;
    cases.clear();
    for (const auto& subject : test::corpus_subjects()) cases.emplace_back(relation, subject);
  }
  return cases;
}

Outcome outcome_over_corpus(const std::string& name, const Relation& relation) {
  Outcome sum;
  for (RelationCase& c : cases_of(relation)) sum.add(test::outcome_of(name, relation, c));
  return sum;
}

class CorpusRelation : public ::testing::Test {
 public:
  CorpusRelation(const Relation& relation, std::string detector)
      : relation_(relation), detector_(std::move(detector)) {}

  void TestBody() override {
    const Outcome found = outcome_over_corpus(detector_, relation_);
    EXPECT_EQ(found.differing, 0u) << detector_ << found.differences;
    EXPECT_EQ(found.found_hash, found.expected_hash);
    EXPECT_GE(found.frames, kFewestFrames) << found.skipped << " cases would lose a bit";
    EXPECT_GE(found.elements, kFewestElements);
    RecordProperty("skipped", std::to_string(found.skipped));
    RecordProperty("elements", std::to_string(found.elements));
  }

 private:
  const Relation& relation_;
  std::string detector_;
};

void register_tests() {
  for (const Relation& relation : test::relations_of_cases())
    for (const std::string& name : test::exact_ones(relation))
      ::testing::RegisterTest(
          ("Relation_" + relation.name).c_str(), test::test_name(name).c_str(), nullptr, nullptr,
          __FILE__, __LINE__,
          [&relation, name]() -> CorpusRelation* { return new CorpusRelation(relation, name); });
}

}  // namespace
}  // namespace contactcheck

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  contactcheck::register_tests();
  return contactcheck::test::run_registered_tests();
}
