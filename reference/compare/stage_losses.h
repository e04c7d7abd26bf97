// Which stage of a detector lost which true pairs.
#pragma once

#include <vector>

#include "core/deform/body.h"
#include "core/detect/detector.h"
#include "reference/results/results.h"

namespace contactcheck {

class StageLosses {
 public:
  explicit StageLosses(const std::vector<Body>& bodies) : bodies_(bodies) {}

  /// Adds one frame: a stage's `missed` are the true pairs that everything before it covered and
  /// its own output does not.
  void add_frame(const StageTrace& trace, const std::vector<ElementPair>& true_triangles);

  const std::vector<results::Stage>& stages() const { return stages_; }

 private:
  bool covers(const StageTrace& trace, const StageRecord& stage, const ElementPair& pair) const;

  const std::vector<Body>& bodies_;
  std::vector<results::Stage> stages_;
};

}  // namespace contactcheck
