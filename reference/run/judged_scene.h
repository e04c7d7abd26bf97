// A scene with all its frames evaluated and judged by the oracle.
#pragma once

#include <string>
#include <vector>

#include "reference/oracle/oracle.h"
#include "reference/oracle/surface_geometry.h"
#include "reference/run/shared_progress.h"
#include "reference/scene/scene.h"

namespace contactcheck {

struct JudgedScene {
  const Scene* scene = nullptr;
  std::vector<std::vector<std::vector<Vec3>>> nodes;     ///< [frame][body]
  std::vector<std::vector<std::vector<Vec3>>> vertices;  ///< [frame][body], canonical mapping
  std::vector<Truth> truth;                              ///< per frame
  std::vector<std::vector<double>> contour;  ///< per frame: length of each true triangle pair
  std::vector<bool> contact_frames;          ///< some surfaces touch
  std::string refused;  ///< not empty: which body and frame hold a NaN or infinite node

  Frame frame(std::size_t index) const;
};

/// Maps and judges all frames. `truth_wanted` false leaves the truth empty (timing processes).
/// Non-finite nodes end it: `refused` says where.
JudgedScene judge_scene(const Scene& scene, bool truth_wanted, ProgressWriter& progress);

/// What the scene asks the oracle for.
WantedTruth wanted_truth(const Scene& scene);

/// A frame of given nodes and vertices, which must outlive it.
Frame make_frame(std::size_t index, double time, const std::vector<std::vector<Vec3>>& nodes,
                 const std::vector<std::vector<Vec3>>& vertices);

/// The canonical mapping of every body.
std::vector<std::vector<Vec3>> map_bodies(const Scene& scene,
                                          const std::vector<std::vector<Vec3>>& nodes);

}  // namespace contactcheck
