// Checks written by hand, for what shows them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reference/gate/verdict.h"

namespace contactcheck::test {

/// In scene "touch": missed 3, at most 0 allowed, frame 7.
inline gate::Check broken_check(const std::string& rule, const std::string& detector) {
  gate::Check check;
  check.rule = rule;
  check.scene = "touch";
  check.detector = detector;
  check.verdict = gate::Verdict::kFail;
  check.red = true;
  check.measured = "missed 3";
  check.allowed = "at most 0";
  check.frame = "frame 7";
  check.rerun = "contactcheck run touch --detector " + detector;
  return check;
}

inline gate::Check passed_check(const std::string& rule, const std::string& detector) {
  gate::Check check = broken_check(rule, detector);
  check.verdict = gate::Verdict::kPass;
  check.red = false;
  check.measured = "missed 0";
  return check;
}

/// In scene "touch", of detector "exact": neither passed nor failed.
inline gate::Check open_check(const std::string& rule, gate::Verdict verdict,
                              const std::string& reason) {
  gate::Check check;
  check.rule = rule;
  check.scene = "touch";
  check.detector = "exact";
  check.verdict = verdict;
  check.reason = reason;
  return check;
}

inline gate::GateResult result_of(std::vector<gate::Check> checks) {
  return {"ci", "A fast run", "contactcheck run", 2, std::move(checks)};
}

}  // namespace contactcheck::test
