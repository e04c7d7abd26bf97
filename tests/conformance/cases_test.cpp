// Whether each case is what its name says, by the oracle.
#include <gtest/gtest.h>

#include <set>

#include "reference/oracle/oracle.h"
#include "tests/conformance/cases.h"

namespace contactcheck {
namespace {

using test::Case;
using test::CaseTruth;

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

TEST(Cases, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Case& c : test::all_cases()) EXPECT_TRUE(names.insert(c.name).second) << c.name;
}

}  // namespace
}  // namespace contactcheck
