// Holds core against independent answers, on small scenes built in code, and names the case of
// every fault: scene, frame, detector, level and what is wrong. Exit code 0: none; 1: some.
//
// run_mutant.py builds it with a file of core that was made wrong on purpose. A header changes for
// the judge and the oracle, too: truth that rests on core's headers alone would be wrong with them.
#include <cstdio>
#include <string>

#include "tests/faults/mutant_checks.h"

namespace {

// A mutant that is wrong everywhere would fill the screen.
constexpr std::size_t kShown = 12;
// It takes some ten seconds where nothing else runs.
constexpr unsigned kSecondsAtMost = 100;

int report(const contactcheck::test::MutantFindings& findings) {
  const auto& faults = findings.faults();
  for (std::size_t i = 0; i < faults.size() && i < kShown; ++i)
    std::printf("FAULT %s\n", faults[i].c_str());
  std::printf("%zu faults, %zu true elements compared\n", faults.size(), findings.compared());
  return faults.empty() ? 0 : 1;
}

}  // namespace

int main() {
  using namespace contactcheck::test;
  MutantFindings::name_crashes(kSecondsAtMost);
  MutantFindings findings;
  // Where one part finds a fault the others are not asked: a mutant is caught, and there are many.
  for (const auto check :
       {check_steps, check_small_parts, check_labels, check_triangle_pairs, check_impacts}) {
    check(findings);
    if (!findings.faults().empty()) return report(findings);
  }
  findings.enter({"all", 0, "make_shape", "scenes"});
  for (const MutantScene& scene : mutant_scenes()) {
    check_mapping(scene, findings);
    check_detectors(scene, findings);
    check_bounds(scene, findings);
    check_ground(scene, findings);
    if (scene.name.starts_with("approach")) check_paper_reading(scene, findings);
    if (!findings.faults().empty()) break;
  }
  return report(findings);
}
