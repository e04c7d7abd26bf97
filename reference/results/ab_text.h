#pragma once

#include <string>
#include <vector>

#include "reference/results/ab_judge.h"

namespace contactcheck::results {

/// What was run, for the reader.
struct AbSetting {
  std::string base, head;  ///< the two programs
  std::size_t rounds = 0;
  AbLimits limits;
  bool accuracy_may_change = false;

  /// Also where nothing could be compared: that is no pass.
  bool fails(const AbJudgement& judgement) const {
    return judgement.times.empty() || judgement.slower() ||
           (judgement.answers_differ() && !accuracy_may_change);
  }
};

/// One screen: what fails first, then what cannot be judged, then the rest in a line each or a
/// count.
std::string ab_text(const AbJudgement& judgement, const AbSetting& setting);

/// The same as Markdown, with all times in a table, for a job summary.
std::string ab_markdown(const AbJudgement& judgement, const AbSetting& setting);

/// One sentence per reason to fail; empty when there is none.
std::vector<std::string> ab_failures(const AbJudgement& judgement, const AbSetting& setting);

}  // namespace contactcheck::results
