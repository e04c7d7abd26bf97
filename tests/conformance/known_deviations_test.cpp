// The list of known deviations, and the comparison that holds detectors against it.
#include "tests/conformance/known_deviations.h"

#include <gmock/gmock.h>

#include <set>
#include <tuple>

#include "reference/adapters/register.h"
#include "tests/conformance/cases.h"
#include "tests/conformance/detectors.h"
#include "tests/conformance/lifecycle.h"

namespace contactcheck {
namespace {

using test::known_deviations;
using test::KnownDeviation;
using test::surprises;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<KnownDeviation> kList = {{{"slow", "fast"},
                                            "body missed",
                                            {{"edges", 2}, {"faces", test::kSome}},
                                            {"a library", "1.2", "issue 34"},
                                            "it tests vertices alone"}};

TEST(Surprises, AreNoneWhereAllIsAsListed) {
  EXPECT_THAT(surprises(kList, "fast", "edges", {{"body missed", 2}}), IsEmpty());
  EXPECT_THAT(surprises(kList, "slow", "faces", {{"body missed", 7}}), IsEmpty());
  EXPECT_THAT(surprises(kList, "other", "edges", {}), IsEmpty());
  EXPECT_THAT(surprises(kList, "fast", "tips", {}), IsEmpty());
}

TEST(Surprises, AreFindingsThatAreNotListed) {
  EXPECT_THAT(surprises(kList, "other", "edges", {{"body missed", 2}}),
              ElementsAre("other, case edges, shows \"body missed\" 2 times; it is expected to "
                          "show none"));
  EXPECT_THAT(surprises(kList, "fast", "tips", {{"body missed", 2}}),
              ElementsAre(HasSubstr("fast, case tips, shows")));
  EXPECT_THAT(surprises(kList, "fast", "edges", {{"body missed", 2}, {"cell spurious", 1}}),
              ElementsAre(HasSubstr("shows \"cell spurious\" 1 times; it is expected")));
}

TEST(Surprises, AreListedDeviationsThatAreGone) {
  EXPECT_THAT(surprises(kList, "fast", "edges", {}),
              ElementsAre("fast, case edges, no longer shows \"body missed\": remove the known "
                          "deviation (a library 1.2, issue 34: it tests vertices alone)"));
  EXPECT_THAT(surprises(kList, "slow", "faces", {{"body spurious", 1}}),
              ElementsAre(HasSubstr("no longer shows \"body missed\""),
                          HasSubstr("shows \"body spurious\" 1 times")));
}

TEST(Surprises, AreOtherNumbersThanListed) {
  EXPECT_THAT(
      surprises(kList, "fast", "edges", {{"body missed", 3}}),
      ElementsAre(AllOf(HasSubstr("shows \"body missed\" 3 times where the known deviation says 2"),
                        HasSubstr("issue 34"))));
}

std::set<std::string> names_of_cases() {
  std::set<std::string> names;
  for (const test::Moment of : {test::Moment::kFrame, test::Moment::kStep})
    for (const test::LifecycleCheck& check : test::lifecycle_checks(of)) names.insert(check.name);
  for (const auto* cases : {&test::all_cases(), &test::step_cases()})
    for (const test::Case& c : *cases) names.insert(c.name);
  return names;
}

// An entry that names nothing could never fail.
TEST(KnownDeviations, NameDetectorsAndCasesThatThereAre) {
  const std::vector<std::string> detectors = test::detector_names();
  const std::set<std::string> cases = names_of_cases();
  for (const KnownDeviation& d : known_deviations()) {
    EXPECT_FALSE(d.detectors.empty() || d.cases.empty()) << d.sentence;
    for (const std::string& detector : d.detectors)
      EXPECT_THAT(detectors, ::testing::Contains(detector)) << d.what;
    for (const test::Occurrence& o : d.cases)
      EXPECT_EQ(cases.count(o.case_name), 1u) << o.case_name;
  }
}

TEST(KnownDeviations, AreListedOnce) {
  std::set<std::tuple<std::string, std::string, std::string>> seen;
  for (const KnownDeviation& d : known_deviations())
    for (const std::string& detector : d.detectors)
      for (const test::Occurrence& o : d.cases)
        EXPECT_TRUE(seen.insert({detector, o.case_name, d.what}).second)
            << detector << ", " << o.case_name << ", " << d.what;
}

TEST(KnownDeviations, SayWhereTheyComeFromAndWhy) {
  for (const KnownDeviation& d : known_deviations()) {
    EXPECT_FALSE(d.origin.source.empty()) << d.what;
    EXPECT_GT(d.sentence.size(), 20u) << d.what;
  }
}

// Another version may have other defects: look at the list again.
TEST(KnownDeviations, AreThoseOfTheInstalledLibraries) {
  const std::map<std::string, std::string> installed = adapters::library_versions();
  for (const KnownDeviation& d : known_deviations()) {
    if (d.origin.library == "contactcheck") continue;
    ASSERT_EQ(installed.count(d.origin.library), 1u) << d.origin.library;
    EXPECT_EQ(installed.at(d.origin.library), d.origin.version) << d.origin.library;
  }
}

}  // namespace
}  // namespace contactcheck
