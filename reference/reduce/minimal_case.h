// A reduced case as text: a family of hard cases with one value, which `contactcheck run` takes,
// and a test that the detector's maintainers paste into their suite.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/reduce/candidate.h"
#include "reference/reduce/verdict.h"

namespace contactcheck::reduce {

struct MinimalCase {
  std::string id;        ///< of the family
  std::string scene;     ///< where it is from
  std::string place;     ///< the frame or value there
  std::string drawn;     ///< the scene's parameters if it was drawn; or empty
  std::string detector;  ///< canonical name
  std::string library;   ///< with its version, for a library's detector; or empty
  Finding finding;
  CaseCandidate candidate;
  std::vector<Level> levels;  ///< at which it is judged
};

/// The shorter of two texts that read back as the same double: decimal ("0.1"), or hexadecimal
/// ("0x1.8p-30") for what takes more than 9 characters as a decimal.
std::string number_text(double value);

/// The file, in the format of fixtures/hard/families. Reading it gives the candidate's bodies and
/// positions bit for bit.
std::string family_text(const MinimalCase& minimal);

/// An id made of `words`, as is_id wants it.
std::string id_from(const std::string& words);

/// What is exactly true of the case and what the detector answered, one sentence each.
struct CaseAnswers {
  std::string exact, detector;
  /// The two bodies that a wrong answer is about; none of an error.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> bodies = {};
  /// Their triangles, if it is about a pair of triangles.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> triangles = {};
};
CaseAnswers answers_of(const MinimalCase& minimal, const ProbeVerdict& verdict);

enum class TestLanguage {
  kCpp,         ///< C++17, a GoogleTest that needs `<array>` alone
  kC,           ///< C99
  kJavaScript,  ///< nested arrays of numbers, for node:test
  kPython,      ///< nested lists of floats and integers, for pytest
};

/// A test: the vertices and triangles of all meshes bit for bit, what was answered, and the
/// assertion, of a function `your_detector` that the reader writes.
std::string printed_test(const MinimalCase& minimal, const CaseAnswers& answers,
                         TestLanguage language);

}  // namespace contactcheck::reduce
