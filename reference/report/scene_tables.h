// Every number of one scene, for every kind of report.
#pragma once

#include <string>
#include <vector>

#include "reference/report/markdown_table.h"
#include "reference/results/results.h"

namespace contactcheck {

using RunList = std::vector<const results::Run*>;

struct SceneReport {
  std::string sentence;  ///< "60 frames, 41 with contact, size 1.20 m."
  std::string truth;     ///< "True contacts, summed over frames: body 41, ..."
  /// Without rows where the scene has no such.
  TitledTable bodies, fits, pairs, result;
  /// Time and errors against separation, levels, graded errors, stages, times, work, speed-ups:
  /// those that have rows.
  std::vector<TitledTable> details;
  std::vector<std::string> notes;  ///< "detector: what a reader must know about its run"
  /// The first of each kind.
  std::vector<const results::Disagreement*> disagreements;
};

/// Refers to the results of `index`. @pre `scene` is one of theirs
SceneReport scene_report(const results::Index& index, const results::Scene& scene);

}  // namespace contactcheck
