// What scenes drawn from a seed say about each detector: how often it is wrong, how fast it is, and
// which parameter of the scenes decides that.
#pragma once

#include <string>
#include <vector>

#include "reference/report/markdown_table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// With fewer ratios no correlation is given.
inline constexpr std::size_t kFewestForCorrelation = 10;

/// All of it empty where no scene was drawn. Tables of what is not there have no rows.
struct DrawnReport {
  std::string text;  ///< how many scenes of which seed, with contact, drawn again, not judged
  /// By detector and level; in scenes with contact and without.
  std::vector<TitledTable> accuracy;
  TitledTable wrong;  ///< which scenes each detector is wrong in
  /// By detector and reference: median, 10th percentile and worst of the ratios; in scenes with
  /// contact and without.
  std::vector<TitledTable> speedups;
  /// A sentence a timed detector: where it is faster than the references, and what decides.
  std::vector<std::string> decides;
  TitledTable correlations;  ///< of these ratios with the parameters of the scenes
};

DrawnReport drawn_report(const results::Results& results);

/// The section of the Markdown report; empty where no scene was drawn.
std::string drawn_markdown(const results::Results& results);

}  // namespace contactcheck::report
