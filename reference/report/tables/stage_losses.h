// In which stage true pairs of triangles are lost, summed over runs.
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

/// What the stages of one name lost.
struct StageLoss {
  std::string stage;
  std::uint64_t missed = 0;  ///< more than 0
  double share = 0.0;        ///< of the true pairs; 0 where there are none
};

/// One detector's stages over several runs.
struct DetectorLosses {
  std::string detector;
  std::uint64_t truth = 0;  ///< true pairs
  /// In the order in which they are met; those that agree in name and units are added up.
  std::vector<results::Stage> stages = {};

  /// Of those that lost something, in the order of the stages.
  std::vector<StageLoss> losses() const;
};

/// The true pairs that the stages of a run are held against. None where it was not judged by cells
/// or triangles: stages cover pairs of triangles, and what answers for pairs of bodies alone may
/// stop at the first one.
std::optional<std::uint64_t> true_triangle_pairs(const results::Run& run);

/// Of the runs that have stages and such pairs; a detector each, in the order of the runs.
std::vector<DetectorLosses> stage_losses(const std::vector<const results::Run*>& runs);
/// Of all detectors in these scenes, in the order of the index.
std::vector<DetectorLosses> stage_losses(const results::Index& index, const SceneChoice& scenes);

/// Columns for stages, and a row for each.
TitledTable empty_stages_table(const std::string& title);
void add_stages(const std::string& detector, const std::vector<results::Stage>& stages,
                TitledTable& table);

/// Names of the stages that lost something in some detector, in the order of all stages.
std::vector<std::string> losing_stages(const std::vector<DetectorLosses>& all);
/// "ffd-aabb loses 4: 2 in hash and 2 in node-plane.", of the first `most` that lose something.
std::vector<std::string> loss_sentences(const std::vector<DetectorLosses>& all, std::size_t most);
/// Who lost nothing; "" where everybody did, and why there is nothing to draw where nobody did.
std::string no_loss_sentence(const std::vector<DetectorLosses>& all);
/// What went in and out of every stage of every detector.
TitledTable stage_losses_table(const std::vector<DetectorLosses>& all);

}  // namespace contactcheck::report
