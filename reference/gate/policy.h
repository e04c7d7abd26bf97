// What a gate lets through: rules over scenes and detectors, written by people.
// fixtures/policies/README.md describes the file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/gate/measure.h"
#include "reference/gate/pattern.h"

namespace contactcheck {

/// Which numbers a rule allows.
enum class Bound {
  kAtMost,
  kAtLeast,
  kUnchanged,  ///< what the baseline has
  kEquals      ///< a word: "ok" of a status, "truth" of a contact hash
};

struct Rule {
  std::string name;  ///< different from the other rules'
  std::string why;   ///< for the reader of a red gate; may be empty
  Patterns scenes, detectors;
  const Measure* measure = nullptr;  ///< of find_measure
  Bound bound = Bound::kAtMost;
  double limit = 0.0;     ///< of kAtMost and kAtLeast
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
};

struct Policy {
  std::string id, title;
  std::vector<Rule> rules;  ///< at least one
  /// More rules than this that cannot judge some of their rows make the gate red; none: any number
  /// may.
  std::optional<std::size_t> cannot_judge_at_most;
};

/// Does it need the results of an earlier run?
bool needs_baseline(const Rule& rule);

/// "at most 0", "at least 0.99", "unchanged", "ok"; with the unit.
std::string allowed_text(const Rule& rule);

/// @throws InputError with file, place and value
Policy read_policy(const std::filesystem::path& file);

}  // namespace contactcheck
