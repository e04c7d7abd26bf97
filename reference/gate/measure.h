// What a rule of a policy can look at.
#pragma once

#include <string>
#include <vector>

namespace contactcheck {

enum class MeasureKind {
  kLevel,     ///< runs[].levels.LEVEL
  kGeometry,  ///< runs[].geometry
  kStages,    ///< runs[].stages[].missed
  kMemory,    ///< runs[].memory_bytes
  kDefects,   ///< known_defects: what is unlisted and what did not show, of this row
  kOracle,    ///< scenes[].pairs.rational.oracle_wrong
  kHash,      ///< runs[].contact_hash
  kStatus,    ///< runs[].status
  kSpeedup,   ///< runs[].speedup: time of a reference / time of the detector
  kSlowdown   ///< the baseline's speed-up / this run's
};

struct Measure {
  const char* name;  ///< in a policy
  MeasureKind kind;
  const char* unit;        ///< behind a number; "" for counts and shares
  double least, greatest;  ///< a limit outside cannot be meant
};

/// Null when there is none of that name.
const Measure* find_measure(const std::string& name);
std::vector<std::string> measure_names();

/// Ratios of times, the only ones that can be too noisy to judge.
bool is_timing(const Measure& measure);
/// Is a number that is the same in every run of the same build on the same input?
bool is_accuracy_number(const Measure& measure);

}  // namespace contactcheck
