// Where a detector is known not to do what it claims, and the comparison that keeps this list true
// in both directions.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace contactcheck::test {

/// What was seen to be wrong in one case ("triangle missed"), and how often over all its frames;
/// only what was seen, never 0.
using Findings = std::map<std::string, std::uint64_t>;

/// For findings whose number is not to be relied on: any but 0.
inline constexpr std::uint64_t kSome = 0;

/// A case, or a check of lifecycle_test.cpp, and the finding's number over all frames.
struct Occurrence {
  std::string case_name;
  std::uint64_t count = kSome;
};

/// Where a deviation was seen and who describes it: a library and its version (of
/// library_versions(); "contactcheck" for our own detectors), an issue, paper or page.
struct Origin {
  std::string library, version, source;
};

/// Every one of the detectors, in every one of the cases.
struct KnownDeviation {
  std::vector<std::string> detectors;
  std::string what;
  std::vector<Occurrence> cases;
  Origin origin;
  std::string sentence;  ///< why
};

/// Of detectors.
using DetectorNames = std::vector<std::string>;
inline DetectorNames operator+(DetectorNames a, const DetectorNames& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A sentence for detectors whose pieces are boxes.
inline const char* const kBoxesMeet = "boxes that hold surface meet where the surfaces do not";

/// Of the detectors of core, whose approximations are the paper's.
std::vector<KnownDeviation> known_deviations_of_core();
std::vector<KnownDeviation> known_deviations_of_bullet();
std::vector<KnownDeviation> known_deviations_of_fcl();
std::vector<KnownDeviation> known_deviations_of_libccd();
/// All of these.
const std::vector<KnownDeviation>& known_deviations();

/// One sentence for each finding that the list does not name, and for each entry of the list that
/// the findings do not show; empty when all is as expected.
std::vector<std::string> surprises(const std::vector<KnownDeviation>& known,
                                   const std::string& detector, const std::string& case_name,
                                   const Findings& findings);

}  // namespace contactcheck::test
