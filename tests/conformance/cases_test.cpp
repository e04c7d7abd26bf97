// Whether each case is what its name says, by the oracle.
#include <gtest/gtest.h>

#include <optional>
#include <set>

#include "reference/oracle/oracle.h"
#include "tests/conformance/cases.h"
#include "tests/conformance/observation.h"

namespace contactcheck {
namespace {

using test::Case;
using test::CaseTruth;
using test::StepCaseTruth;

CaseTruth truth_of(oracle::Oracle& oracle, const Frame& frame) {
  oracle::WantedTruth wanted;
  wanted.containment = wanted.vertices = true;
  const oracle::Truth truth = oracle.judge(frame, wanted);
  return {truth.surface.bodies.size(), truth.surface.triangles.size(), truth.containment.size(),
          truth.surface.vertices.size()};
}

std::string text(const CaseTruth& t) {
  return "{" + std::to_string(t.bodies) + ", " + std::to_string(t.triangles) + ", " +
         std::to_string(t.containment) + ", " + std::to_string(t.vertices) + "}";
}

TEST(Cases, AreWhatTheySay) {
  for (const Case& c : test::all_cases()) {
    oracle::Oracle oracle(c.bodies);
    EXPECT_EQ(c.truth.size(), c.frames.size()) << c.name;
    for (std::size_t f = 0; f < c.frames.size(); ++f) {
      const CaseTruth truth = truth_of(oracle, c.frames[f].frame(f));
      const CaseTruth said = f < c.truth.size() ? c.truth[f] : CaseTruth{};
      EXPECT_EQ(text(said), text(truth)) << c.name << ", frame " << f;
    }
  }
}

std::string text(const StepCaseTruth& t) {
  return "{" + std::to_string(t.bodies) + ", " + std::to_string(t.triangles) + ", " +
         std::to_string(t.vertices) + ", " + std::to_string(t.edges) + ", " +
         std::to_string(t.self_vertices) + ", " + std::to_string(t.self_edges) + "}";
}

/// None where no bodies meet.
std::optional<double> first_time(const oracle::StepTruth& truth) {
  std::optional<double> out;
  for (const oracle::FirstImpact& first : truth.first)
    if (!out || first.earliest < *out) out = first.earliest;
  return out;
}

StepCaseTruth counts_of(const oracle::StepTruth& truth) {
  const ContactSet& set = truth.contacts;
  return {set.impacts.size(),      set.impact_triangles.size(),     set.impact_vertices.size(),
          set.impact_edges.size(), set.self_impact_vertices.size(), set.self_impact_edges.size()};
}

// Times are said to nine digits where they are no binary fractions.
TEST(StepCases, AreWhatTheySay) {
  constexpr double kDigits = 1e-9, kNever = -1.0;
  for (const Case& c : test::step_cases()) {
    const std::vector<oracle::StepTruth> truth = test::step_truth_of(c);
    EXPECT_EQ(c.steps.size(), truth.size()) << c.name;
    for (std::size_t s = 0; s < truth.size(); ++s) {
      const StepCaseTruth said = s < c.steps.size() ? c.steps[s] : StepCaseTruth{};
      EXPECT_EQ(text(said), text(counts_of(truth[s]))) << c.name << ", step " << s;
      EXPECT_NEAR(said.first.value_or(kNever), first_time(truth[s]).value_or(kNever), kDigits)
          << c.name << ", step " << s;
    }
  }
}

TEST(Cases, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Case& c : test::all_cases()) EXPECT_TRUE(names.insert(c.name).second) << c.name;
  for (const Case& c : test::step_cases()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_TRUE(c.name.starts_with("step-")) << c.name;
  }
}

}  // namespace
}  // namespace contactcheck
