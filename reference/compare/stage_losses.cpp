#include "reference/compare/stage_losses.h"

#include <algorithm>

#include "core/types/check.h"
#include "reference/compare/label_cover.h"

namespace contactcheck {

bool StageLosses::covers(const StageTrace& trace, const StageRecord& stage,
                         const ElementPair& pair) const {
  switch (stage.kind) {
    case StageRecord::Kind::kBodies:
      return std::find(stage.bodies.begin(), stage.bodies.end(),
                       BodyPair{pair.body_a, pair.body_b}) != stage.bodies.end();
    case StageRecord::Kind::kLabelCells:
      return covered_by_cells(bodies_, stage.elements, pair, [](std::size_t) {});
    case StageRecord::Kind::kOwnerCells: {
      const ElementPair owners{pair.body_a, pair.body_b, trace.owner[pair.body_a][pair.a],
                               trace.owner[pair.body_b][pair.b]};
      return std::binary_search(stage.elements.begin(), stage.elements.end(), owners);
    }
    case StageRecord::Kind::kTriangles:
      return std::binary_search(stage.elements.begin(), stage.elements.end(), pair);
  }
  return false;
}

void StageLosses::add_frame(const StageTrace& trace,
                            const std::vector<ElementPair>& true_triangles) {
  if (stages_.empty()) {
    for (const StageRecord& s : trace.stages) {
      results::Stage& stage = stages_.emplace_back();
      stage.name = s.name;
      stage.unit = s.unit;
      stage.visited_unit = s.visited_unit;
      if (!s.visited_unit.empty()) stage.visited = 0;
    }
  }
  CONTACTCHECK_INVARIANT(stages_.size() == trace.stages.size(), "stages do not change over frames");
  std::vector<ElementPair> alive = true_triangles;
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    const StageRecord& stage = trace.stages[i];
    stages_[i].in += stage.in;
    stages_[i].out += stage.out;
    if (stages_[i].visited) *stages_[i].visited += stage.visited;
    const auto lost = std::remove_if(alive.begin(), alive.end(), [&](const ElementPair& pair) {
      return !covers(trace, stage, pair);
    });
    stages_[i].missed += static_cast<std::uint64_t>(alive.end() - lost);
    alive.erase(lost, alive.end());
  }
}

}  // namespace contactcheck
