#include <algorithm>

#include "tests/conformance/known_deviations.h"

namespace contactcheck::test {
namespace {

/// The place of the detector and case in an entry; nullptr when it is about others.
const Occurrence* occurrence(const KnownDeviation& d, const std::string& detector,
                             const std::string& case_name) {
  if (std::find(d.detectors.begin(), d.detectors.end(), detector) == d.detectors.end())
    return nullptr;
  const auto it = std::find_if(d.cases.begin(), d.cases.end(),
                               [&](const Occurrence& o) { return o.case_name == case_name; });
  return it == d.cases.end() ? nullptr : &*it;
}

// "" when the entry still describes the detector.
std::string outdated(const KnownDeviation& d, std::uint64_t expected, std::uint64_t seen,
                     const std::string& subject) {
  const std::string origin =
      d.origin.library + " " + d.origin.version + ", " + d.origin.source + ": " + d.sentence;
  if (seen == 0)
    return subject + " no longer shows \"" + d.what + "\": remove the known deviation (" + origin +
           ")";
  if (expected == kSome || expected == seen) return "";
  return subject + " shows \"" + d.what + "\" " + std::to_string(seen) +
         " times where the known deviation says " + std::to_string(expected) + " (" + origin + ")";
}

}  // namespace

const std::vector<KnownDeviation>& known_deviations() {
  static const std::vector<KnownDeviation> table = [] {
    std::vector<KnownDeviation> all;
    for (const auto& part : {known_deviations_of_core(), known_deviations_of_bullet(),
                             known_deviations_of_fcl(), known_deviations_of_libccd()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return table;
}

std::vector<std::string> surprises(const std::vector<KnownDeviation>& known,
                                   const std::string& detector, const std::string& case_name,
                                   const Findings& findings) {
  const std::string subject = detector + ", case " + case_name + ",";
  std::vector<std::string> out;
  Findings unexplained = findings;
  for (const KnownDeviation& d : known) {
    const Occurrence* here = occurrence(d, detector, case_name);
    if (here == nullptr) continue;
    const auto seen = findings.find(d.what);
    const std::string sentence =
        outdated(d, here->count, seen == findings.end() ? 0 : seen->second, subject);
    if (!sentence.empty()) out.push_back(sentence);
    unexplained.erase(d.what);
  }
  for (const auto& [what, count] : unexplained)
    out.push_back(subject + " shows \"" + what + "\" " + std::to_string(count) +
                  " times; it is expected to show none");
  return out;
}

}  // namespace contactcheck::test
