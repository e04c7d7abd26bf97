// All that meets within a step, by brute force: every pair of elements in rational arithmetic.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/types/contact_set.h"
#include "reference/oracle/step_truth.h"
#include "tests/odd/rational_impact.h"
#include "tests/support/step_scenes.h"

namespace contactcheck::test {

/// The truth of a step in both directions of time, by the definitions of the levels. Pairs of
/// elements whose boxes over the step do not meet are left out, and nothing else is.
class StepBruteForce {
 public:
  explicit StepBruteForce(const StepScene& scene);

  /// The lists of steps, canonical and without times.
  const ContactSet& contacts() const { return forwards_; }
  /// Those of the step backwards: other pairs of triangles touch where it begins.
  const ContactSet& contacts_backwards() const { return backwards_; }
  /// Pairs of triangles of two bodies that touch at the start, canonical.
  const std::vector<ElementPair>& at_start() const { return at_start_; }
  const std::vector<ElementPair>& at_end() const { return at_end_; }
  /// Pairs of elements that were decided: boxes of the others do not meet.
  std::size_t decided() const { return decided_; }

  /// What is wrong with first times and their certificates, of this step or of the same step
  /// backwards; empty if nothing is.
  std::string fault_of_first(const std::vector<oracle::FirstImpact>& first, bool backwards) const;
  /// What is wrong with reported times, as above; a time may differ by kImpactTimeWidth.
  std::string fault_of_times(const std::vector<BodyImpact>& impacts, bool backwards) const;

 private:
  struct Elements;
  void judge_pair(std::uint32_t a, std::uint32_t b);
  void judge_own(std::uint32_t body);
  const std::vector<ExactTime>* times_of(const BodyPair& bodies) const;
  bool starts_in_contact(const BodyPair& bodies, bool backwards) const;
  bool first_within(const BodyPair& bodies, const mpq_class& low, const mpq_class& high,
                    bool backwards) const;

  const StepScene& scene_;
  ContactSet forwards_, backwards_;
  std::vector<ElementPair> at_start_, at_end_;
  std::map<BodyPair, std::vector<ExactTime>> times_;  // of contact of two bodies
  std::size_t decided_ = 0;
};

/// Which list of steps differs; empty: none does, but for times of impacts.
std::string different_list(const ContactSet& a, const ContactSet& b);

/// Pasteable: the vertices at both ends, and the triangles.
std::string text(const StepScene& scene);

}  // namespace contactcheck::test
