// The judged answer of a detector to one frame of two bodies, and the part of it that a smaller
// case must still show.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reference/judge/judge.h"
#include "reference/results/results.h"

namespace contactcheck::reduce {

struct ProbeVerdict {
  results::Status status = results::Status::kOk;
  std::string message;  ///< of a status other than ok
  /// How an error ended the call, equal for equal errors: "threw", "signal 11 (...)".
  std::string how;
  results::Levels levels;
  std::map<Level, std::string> not_judged;
  double missed_length = 0.0;  ///< metres of contour, as far as it is judged
  /// The first missed and the first spurious contact of each level claimed.
  std::vector<judge::Disagreement> disagreements;
};

std::string to_text(const ProbeVerdict& verdict);
/// @throws std::runtime_error for a text that to_text did not make
ProbeVerdict verdict_from_text(const std::string& text);

/// One thing that is wrong with an answer.
struct Finding {
  std::string level;     ///< empty for an error
  std::string kind;      ///< missed, spurious or error
  std::string how = {};  ///< of an error, as in ProbeVerdict
  /// Missed triangles that share more than a point: a touching pair in their place would be
  /// another defect.
  bool crossing = false;
  /// Its triangles are in general position (in_general_position): so must those be that show it
  /// in a smaller case. A verdict alone does not show it; find_defect sets it from the frame.
  bool general = false;
};

/// "missed at level triangle", "error: signal 11 (Segmentation fault)"
std::string described(const Finding& finding);

/// What is wrong in `verdict` at that level and of that kind (where these are not empty), the
/// finest level first; none where the detector agrees with the truth.
std::optional<Finding> finding_of(const ProbeVerdict& verdict, const std::string& level,
                                  const std::string& kind);

/// True when `verdict` has the same defect.
bool shows(const ProbeVerdict& verdict, const Finding& finding);

/// The disagreement that shows it. @pre shows(verdict, finding), no error
const judge::Disagreement& disagreement_of(const ProbeVerdict& verdict, const Finding& finding);

}  // namespace contactcheck::reduce
