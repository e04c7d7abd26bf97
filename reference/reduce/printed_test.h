// A reduced case as a test to paste into the suite of whoever maintains the detector.
#pragma once

#include <string>

#include "reference/reduce/minimal_case.h"

namespace contactcheck::reduce {

/// What is exactly true of the case and what the detector answered, one sentence each.
struct CaseAnswers {
  std::string exact, detector;
};
CaseAnswers answers_of(const MinimalCase& minimal, const ProbeVerdict& verdict);

/// A GoogleTest in plain C++17 that needs `<array>` alone: the vertices and triangles of both
/// meshes bit for bit, with what is to be expected, and what was answered, in comments.
std::string printed_test(const MinimalCase& minimal, const CaseAnswers& answers);

}  // namespace contactcheck::reduce
