// One fault per relation, each in a detector that answers with the truth otherwise: what the
// relation is there to catch.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "core/detect/detector.h"

namespace contactcheck::test {

struct RelationFault {
  std::string relation;  ///< name of the relation that must catch it
  std::string what;      ///< in words
  std::function<std::unique_ptr<Detector>()> make;
};

inline void PrintTo(const RelationFault& fault, std::ostream* out) { *out << fault.what; }

const std::vector<RelationFault>& relation_faults();

}  // namespace contactcheck::test
