// A run of the program with faulty detectors, from the command line to results.json.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/reference/cli/program.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {

struct WholeRun {
  Outcome outcome;
  std::map<std::string, nlohmann::json> rows;  ///< by detector
  std::shared_ptr<const Scratch> scratch;

  const nlohmann::json& row(const std::string& detector) const { return rows.at(detector); }
  std::string message(const std::string& detector) const;
  std::vector<std::string> notes(const std::string& detector) const;
  /// Names of what the run has left in its folder, sorted.
  std::vector<std::string> files() const;
  /// What the validator of results.json says; "" when all is well.
  std::string schema_errors() const;
};

/// Two detectors of other makers, a library's and core's.
std::vector<std::string> honest_detectors();

/// Runs these detectors on the tiny scene. A run without complete results fails the test.
WholeRun run_whole(const std::vector<std::string>& detectors,
                   const std::vector<std::string>& flags = {"--no-timing"});

}  // namespace contactcheck::test
