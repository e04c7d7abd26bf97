// What a gate lets through: rules over scenes and detectors, written by people.
// fixtures/policies/README.md describes the file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace contactcheck::gate {

// What a rule of a policy can look at.

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

// Which scenes or detectors a rule is about.

/// Shell patterns (fnmatch: `*`, `?`, `[...]`) for whole names; one that begins with '!' takes
/// names out again. `*` also matches ':', '=' and ','.
struct Patterns {
  std::vector<std::string> wanted;    ///< at least one
  std::vector<std::string> unwanted;  ///< without their '!'

  bool hold(const std::string& name) const;
};

bool matches(const std::string& pattern, const std::string& name);

/// Which numbers a rule allows.
enum class Bound {
  kAtMost,
  kAtLeast,
  kBetween,    ///< of speed-ups: a window, to be left on neither side
  kUnchanged,  ///< what the baseline has
  kEquals      ///< a word: "ok" of a status, "truth" of a contact hash
};

struct Rule {
  std::string name;  ///< different from the other rules'
  std::string why;   ///< for the reader of a red gate; may be empty
  Patterns scenes, detectors;
  const Measure* measure = nullptr;  ///< of find_measure
  Bound bound = Bound::kAtMost;
  double limit = 0.0;     ///< of kAtMost and kAtLeast; the lower one of kBetween
  double upper = 0.0;     ///< of kBetween, above `limit`
  std::string level;      ///< empty: the finest that the detector claims and that was judged
  bool rounded = false;   ///< judged by the input that a detector in single precision was fed
  std::string stage;      ///< of stage_missed; empty: all together
  std::string question;   ///< of timing rules
  std::string reference;  ///< of timing rules: a detector
  std::string part = "playback";
  /// A detector that exceeds the limit by less than this per frame is let through: a ratio between
  /// two times of a few microseconds says nothing that matters.
  double floor_us = 2.0;
  /// A measurement whose 95 % interval contains the limit is too noisy to judge when the upper end
  /// of the interval is beyond the lower one by more than this share.
  double noise_width = 0.1;
  bool noisy_fails = false;     ///< "too noisy to judge" makes the gate red
  bool unjudged_fails = false;  ///< so does "cannot judge"
  bool error_fails = true;      ///< so does a row whose detector ended in an error
  bool refused_fails = true;    ///< or refused its input: the rule claims that it takes it
};

struct Policy {
  std::string id, title;
  std::vector<Rule> rules;  ///< at least one
  /// More rules than this that cannot judge some of their rows make the gate red; none: any number
  /// may.
  std::optional<std::size_t> cannot_judge_at_most;
  /// Rules on times are judged and shown, and neither they nor rules that cannot judge make the
  /// gate red: for a first run, on a machine whose load nobody controls. Not a key of the file.
  bool advisory_times = false;
};

/// Does it need the results of an earlier run?
bool needs_baseline(const Rule& rule);

/// "at most 0", "at least 1x and at most 8x", "that of the baseline", "ok"; with the unit.
std::string allowed_text(const Rule& rule);

/// @throws InputError with file, place and value
Policy read_policy(const std::filesystem::path& file);

}  // namespace contactcheck::gate
