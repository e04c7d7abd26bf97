// Checks written by hand, for what shows them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reference/gate/verdict.h"

namespace contactcheck::test {

/// In scene "touch": missed 3, at most 0 allowed, frame 7.
inline Check broken_check(const std::string& rule, const std::string& detector) {
  Check check;
  check.rule = rule;
  check.scene = "touch";
  check.detector = detector;
  check.verdict = Verdict::kFail;
  check.red = true;
  check.measured = "missed 3";
  check.allowed = "at most 0";
  check.frame = "frame 7";
  check.rerun = "contactcheck run touch --detector " + detector;
  return check;
}

inline Check passed_check(const std::string& rule, const std::string& detector) {
  Check check = broken_check(rule, detector);
  check.verdict = Verdict::kPass;
  check.red = false;
  check.measured = "missed 0";
  return check;
}

/// In scene "touch", of detector "exact": neither passed nor failed.
inline Check open_check(const std::string& rule, Verdict verdict, const std::string& reason) {
  Check check;
  check.rule = rule;
  check.scene = "touch";
  check.detector = "exact";
  check.verdict = verdict;
  check.reason = reason;
  return check;
}

inline GateResult result_of(std::vector<Check> checks) {
  return {"ci", "A fast run", "contactcheck run", 2, std::move(checks)};
}

}  // namespace contactcheck::test
