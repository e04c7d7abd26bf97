// The findings of a run in words: the top of the page.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::report {

/// A topic, and a sentence about it.
struct HeadlineFinding {
  std::string topic, sentence;
};

struct Headline {
  /// "3 of 5 detectors have no missed and no spurious contacts in 2 scenes"
  std::string title;
  std::vector<HeadlineFinding> findings;
  /// The detectors that were right and fastest in some scene, most scenes first.
  std::vector<std::string> fastest;
  /// "ffd-lazy in all 2 scenes: 15.1 to 75.1x fcl-aabb, of all pairs of triangles, 0.283 ms per
  /// frame": the first of these, in the question that was compared; with the interval of its ratio
  /// (format_ratio) if that is of one scene. Empty unless two were right and timed.
  std::string cheapest;
};

/// A detector has no missed and no spurious contacts if it was right at every level that it claims,
/// in every scene that was judged, and never ended in an error. Contact reported beyond the
/// declared margin, and errors of depths and normals, are separate findings.
Headline headline_of(const results::Results& results);

}  // namespace contactcheck::report
