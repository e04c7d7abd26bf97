// The stages in which true pairs of triangles are missed, summed over runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/report/tables/scene_choice.h"
#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// The pairs missed by all stages of one name.
struct StageLoss {
  std::string stage;
  std::uint64_t missed = 0;  ///< above 0
  double share = 0.0;        ///< of the true pairs; 0 where there are none
};

/// One detector's stages over several runs.
struct DetectorLosses {
  std::string detector;
  std::uint64_t truth = 0;  ///< true pairs
  /// In pipeline order; stages with equal name and units are summed.
  std::vector<results::Stage> stages = {};

  /// The stages that missed pairs, in pipeline order.
  std::vector<StageLoss> losses() const;
};

/// The true pairs that the stages of a run are compared with. None if it was not judged by cells or
/// triangles: stages cover pairs of triangles, and a detector that answers only for pairs of bodies
/// may stop at the first.
std::optional<std::uint64_t> true_triangle_pairs(const results::Run& run);

/// One entry per detector of the runs that have stages and such pairs, in the order of the runs.
std::vector<DetectorLosses> stage_losses(const std::vector<const results::Run*>& runs);
/// The same for all detectors in these scenes, in the order of the index.
std::vector<DetectorLosses> stage_losses(const results::Index& index, const SceneChoice& scenes);

/// A table with columns for stages; add_stages() adds a row for each.
TitledTable empty_stages_table(const std::string& title);
void add_stages(const std::string& detector, const std::vector<results::Stage>& stages,
                TitledTable& table);

/// Names of the stages that missed pairs in some detector, in the order of all stages.
std::vector<std::string> losing_stages(const std::vector<DetectorLosses>& all);
/// "ffd-aabb loses 4: 2 in hash and 2 in node-plane.", for the first `most` detectors with misses.
std::vector<std::string> loss_sentences(const std::vector<DetectorLosses>& all, std::size_t most);
/// The detectors without misses; "" if all have some. If none has any, why there is nothing to
/// draw.
std::string no_loss_sentence(const std::vector<DetectorLosses>& all);
/// The input and output of every stage of every detector.
TitledTable stage_losses_table(const std::vector<DetectorLosses>& all);

}  // namespace contactcheck::report
