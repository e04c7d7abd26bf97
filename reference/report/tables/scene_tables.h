// Every number of one scene, for every kind of report.
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

// Time and error against separation, of scenes that are distance sweeps.

/// A row per detector and a column per separation: the median time of a frame over the orientations
/// that were timed (where there are such), and missed and spurious contacts over all of them. None
/// for scenes that are no sweep.
std::vector<TitledTable> separation_tables(const results::Scene& scene, const RunList& runs);

}  // namespace contactcheck::report
