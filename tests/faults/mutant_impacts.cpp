// Moving elements: core against the oracle's other algorithm, and both against known answers.
#include <cmath>
#include <string>

#include "core/narrow/impact.h"
#include "reference/oracle/elementary_impact.h"
#include "tests/faults/mutant_checks.h"
#include "tests/support/impact_cases.h"
#include "tests/support/impact_queries.h"

namespace contactcheck::test {
namespace {

void check_query(const ImpactQuery& query, MutantFindings& out) {
  const Impact truth = oracle::elementary_impact(query);
  for (const Impact& answer : {find_impact(query), find_impact_exact(query)}) {
    out.expect(!truth.contact || answer.contact, "missed=1 spurious=0");
    out.expect(truth.contact || !answer.contact, "missed=0 spurious=1");
    if (truth.contact != answer.contact) continue;
    const std::string fault = contradiction(answer, truth);
    out.expect(fault.empty(), fault);
  }
}

}  // namespace

void check_impacts(MutantFindings& out) {
  std::size_t number = 0;
  for (const auto& cases : {repeated_contacts(), impact_cases()})
    for (const ImpactCase& known : cases) {
      out.enter({known.name, number++, "find_impact", "impact"});
      for (const Impact& answer : {find_impact(known.query), find_impact_exact(known.query)}) {
        const std::string fault = wrong_answer(answer, known.contacts, known.error);
        out.expect(fault.empty(), fault);
      }
    }
  for (int family = 0; family < kImpactFamilies; ++family) {
    std::mt19937_64 random(50 + static_cast<std::uint64_t>(family));
    const auto drawn = static_cast<ImpactFamily>(family);
    // Rounding decides few of these, so that one in a hundred or in a thousand shows a fault.
    const bool rare = drawn == ImpactFamily::kNearlyPlanar || drawn == ImpactFamily::kCloseFlips;
    const std::size_t count = drawn == ImpactFamily::kWholeRange ? 5 : rare ? 3000 : 150;
    for (std::size_t i = 0; i < count; ++i) {
      out.enter({"impact-family-" + std::to_string(family), i, "find_impact", "impact"});
      check_query(draw_impact_query(random, drawn), out);
    }
  }
  for (int bits = 10; bits < 50; ++bits) {
    out.enter({"close-roots", static_cast<std::size_t>(bits), "find_impact", "impact"});
    for (int i = 1; i < 30; ++i) check_query(close_roots(i / 43.0, std::ldexp(1.0, -bits)), out);
  }
}

}  // namespace contactcheck::test
