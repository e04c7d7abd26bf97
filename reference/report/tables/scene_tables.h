// All numbers of one scene, for every kind of report.
#pragma once

#include <string>
#include <vector>

#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

using RunList = std::vector<const results::Run*>;

struct SceneReport {
  std::string sentence;  ///< "60 frames, 41 with contact, size 1.20 m."
  std::string truth;     ///< "True contacts, summed over frames: body 41, ..."
  /// No rows if the scene has none of these.
  TitledTable bodies, fits, pairs, result;
  /// Tables with rows among: time and errors against separation, levels, graded errors, stages,
  /// times, work, speed-ups.
  std::vector<TitledTable> details;
  std::vector<std::string> notes;  ///< "detector: ...", facts about its run
  /// The first disagreement of each kind.
  std::vector<const results::Disagreement*> disagreements;
};

/// Refers to the results of `index`. @pre `scene` is one of theirs
SceneReport scene_report(const results::Index& index, const results::Scene& scene);

// Time and errors against separation, for scenes that are distance sweeps.

/// One row per detector and one column per separation: the median time of a frame over the timed
/// orientations (if any), and missed and spurious contacts over all orientations. Empty for scenes
/// that are not a sweep.
std::vector<TitledTable> separation_tables(const results::Scene& scene, const RunList& runs);

}  // namespace contactcheck::report
