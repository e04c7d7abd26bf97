// Every detector that the suite is run for.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "tests/conformance/cases.h"

namespace contactcheck::test {

/// The detectors of core and of all adapters.
const DetectorCatalog& catalogue();

/// Every registered id with its default options, and the variants with other options.
std::vector<std::string> detector_names();
/// Those that answer questions about frames, or about steps; of one that is absent nobody knows,
/// and it is taken for one of frames.
std::vector<std::string> detector_names(Moment of);

/// True for questions about such moments.
bool is_of(Question question, Moment moment);
bool answers_any(const Semantics& semantics, Moment moment);

/// A detector's name in letters, digits and underscores, as GoogleTest wants it.
std::string test_name(const std::string& detector);

/// Not prepared yet.
/// @pre the detector is not absent
std::unique_ptr<Detector> make_detector(const std::string& name);

}  // namespace contactcheck::test
