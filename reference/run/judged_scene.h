// A scene with all its frames evaluated and judged by the oracle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/oracle/oracle.h"
#include "reference/oracle/surface_geometry.h"
#include "reference/run/frame_positions.h"
#include "reference/run/pair_check.h"
#include "reference/run/shared_progress.h"
#include "reference/scene/scene.h"

namespace contactcheck {

struct JudgedScene {
  const Scene* scene = nullptr;
  FramePositions positions;
  std::vector<Truth> truth;  ///< per frame
  /// Per frame: length of each true triangle pair; empty where the scene does not grade lengths.
  std::vector<std::vector<double>> contour;
  std::vector<bool> contact_frames;  ///< some surfaces touch
  std::optional<PairTally> pairs;    ///< of random pairs: what rational arithmetic says
  std::string refused;  ///< not empty: which body and frame hold a NaN or infinite node

  /// Valid until another frame is asked for.
  Frame frame(std::size_t index) const;
};

/// Of a worker's work, for the progress bar; random pairs are long enough for it to move.
constexpr double kShareOfTruth = 0.1;

/// Maps and judges all frames. Non-finite nodes end it: `refused` says where.
JudgedScene judge_scene(const Scene& scene, ProgressWriter& progress);

/// What the scene asks the oracle for.
WantedTruth wanted_truth(const Scene& scene);

/// A frame of given nodes and vertices, which must outlive it.
Frame make_frame(std::size_t index, double time, const std::vector<std::vector<Vec3>>& nodes,
                 const std::vector<std::vector<Vec3>>& vertices);

}  // namespace contactcheck
