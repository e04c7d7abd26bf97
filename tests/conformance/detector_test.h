// What all tests share that are run for every detector.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/conformance/detectors.h"
#include "tests/conformance/observation.h"

namespace contactcheck::test {

/// Why a detector is not in this program; "" when it is.
inline std::string absence(const std::string& detector) {
  return catalogue().find(catalogue().parse(detector).id)->absent_because;
}

inline Maker maker_of(const std::string& detector) {
  return [detector] { return make_detector(detector); };
}

inline void expect_as_known(const std::string& detector, const std::string& case_name,
                            const Observation& seen) {
  for (const std::string& s : surprises(known_deviations(), detector, case_name, seen.findings))
    ADD_FAILURE() << s << "\n" << seen.details;
}

}  // namespace contactcheck::test
