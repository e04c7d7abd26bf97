// What a gate allows: rules over scenes and detectors, written by people.
// fixtures/policies/README.md describes the file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace contactcheck::gate {

// The measures that a rule can be about.

enum class MeasureKind {
  kLevel,      ///< runs[].levels.LEVEL
  kGeometry,   ///< runs[].geometry
  kImpacts,    ///< runs[].impacts
  kStages,     ///< runs[].stages[].missed
  kMemory,     ///< runs[].memory_bytes
  kDefects,    ///< known_defects: unlisted and not shown ones of this row
  kOracle,     ///< scenes[].pairs.rational.oracle_wrong
  kHash,       ///< runs[].contact_hash
  kStatus,     ///< runs[].status
  kLevels,     ///< runs[].semantics.levels
  kQuestions,  ///< runs[].semantics.questions
  kSpeedup,    ///< runs[].speedup: time of a reference / time of the detector
  kSlowdown    ///< the baseline's speed-up / this run's
};

struct Measure {
  const char* name;  ///< in a policy
  MeasureKind kind;
  const char* unit;        ///< behind a number; "" for counts and shares
  double least, greatest;  ///< sensible limits; others are refused
};

/// Null for an unknown name.
const Measure* find_measure(const std::string& name);
std::vector<std::string> measure_names();

/// Ratios of times, the only measures that can be too noisy to judge.
bool is_timing(const Measure& measure);
/// True for a number that is equal in every run of the same build on the same input.
bool is_accuracy_number(const Measure& measure);

// The scenes or detectors that a rule is about.

/// Shell patterns (fnmatch: `*`, `?`, `[...]`) for whole names; a pattern that begins with '!'
/// excludes names. `*` also matches ':', '=' and ','.
struct Patterns {
  std::vector<std::string> wanted;    ///< at least one
  std::vector<std::string> unwanted;  ///< without their '!'

  bool hold(const std::string& name) const;
};

bool matches(const std::string& pattern, const std::string& name);

/// The values that a rule allows.
enum class Bound {
  kAtMost,
  kAtLeast,
  kBetween,    ///< of speed-ups: a range with both ends
  kUnchanged,  ///< equal to the baseline
  kIncludes,   ///< names that must be among those of the row: levels, questions
  kEquals      ///< a word: status "ok", contact hash "truth"
};

struct Rule {
  std::string name;  ///< different from the other rules'
  std::string why;   ///< shown to the reader of a failed gate; may be empty
  Patterns scenes, detectors;
  const Measure* measure = nullptr;  ///< points into a static table (find_measure)
  Bound bound = Bound::kAtMost;
  std::vector<std::string> included;  ///< of kIncludes: at least one, in the order of the policy
  double limit = 0.0;                 ///< of kAtMost and kAtLeast; the lower one of kBetween
  double upper = 0.0;                 ///< of kBetween, above `limit`
  std::string level;                  ///< empty: the finest that is claimed and was judged
  bool rounded = false;   ///< judged for the input that a single-precision detector was fed
  std::string stage;      ///< of stage_missed; empty: all together
  std::string question;   ///< of timing rules
  std::string reference;  ///< of timing rules: a detector
  std::string part = "playback";
  /// An excess of less than this per frame passes: a ratio between two times of a few microseconds
  /// is not significant.
  double floor_us = 2.0;
  /// A measurement whose 95 % interval contains the limit is too noisy to judge if the interval's
  /// upper end exceeds the lower one by more than this share.
  double noise_width = 0.1;
  bool noisy_fails = false;     ///< "too noisy to judge" fails the gate
  bool unjudged_fails = false;  ///< so does "cannot judge"
  bool error_fails = true;      ///< so does a row whose detector ended in an error
  bool refused_fails = true;    ///< or refused its input, which the rule requires it to take
};

struct Policy {
  std::string id, title;
  std::vector<Rule> rules;  ///< at least one
  /// If more rules than this cannot judge some of their rows, the gate fails; none: any number may.
  std::optional<std::size_t> cannot_judge_at_most;
  /// Rules on times are judged and shown but do not fail the gate, nor do rules that cannot be
  /// judged: for a first run, or a machine with an uncontrolled load. Not a key of the file.
  bool advisory_times = false;
};

/// True if the rule needs the results of an earlier run.
bool needs_baseline(const Rule& rule);

/// "at most 0", "at least 1x and at most 8x", "that of the baseline", "ok", "body, triangle among
/// them"; with the unit.
std::string allowed_text(const Rule& rule);

/// @throws InputError with file, place and value
Policy read_policy(const std::filesystem::path& file);

}  // namespace contactcheck::gate
