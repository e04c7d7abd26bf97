// A scene with the ground truth of every frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/judge/judge.h"
#include "reference/oracle/oracle.h"
#include "reference/process/shared_progress.h"
#include "reference/scene/frame_positions.h"
#include "reference/scene/random_pairs.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// What rational arithmetic says of a scene's random pairs, and where the oracle differs from it.
struct PairTally {
  struct Kind {
    std::uint64_t pairs = 0, touching = 0;
  };
  std::array<Kind, scene::kPairKinds> kinds;  ///< touching by rational arithmetic
  /// Pairs on which the oracle differs, including reported pairs of triangles in two slots, which
  /// cannot touch.
  std::uint64_t oracle_wrong = 0;
  /// The first pair that the oracle missed and its first spurious one, level `triangle`; scene and
  /// detector left empty.
  std::vector<Disagreement> disagreements;

  std::uint64_t checked() const;
  std::uint64_t touching() const;
};

/// Judges a frame's random pairs a second time, in rational arithmetic. `vertices`: of both bodies;
/// `truth`: the oracle's. `threads` share the pairs; 0: one per CPU. The tally is the same for any
/// number of them.
void check_pairs(const scene::RandomPairs& pairs, std::size_t frame,
                 const std::vector<std::vector<Vec3>>& vertices, const oracle::Truth& truth,
                 PairTally& tally, unsigned threads = 0);

/// Filled by judge_scene() (accuracy.h).
struct JudgedScene {
  const scene::Scene* scene = nullptr;
  scene::FramePositions positions;
  std::vector<oracle::Truth> truth;  ///< per frame
  std::vector<std::string> open;     ///< per body, as note_open_bodies() says
  /// Per frame: length of each true triangle pair; empty where the scene does not grade lengths.
  std::vector<std::vector<double>> contour;
  std::vector<bool> contact_frames;  ///< some surfaces touch
  double reach = 0.0;              ///< the largest coordinate of a vertex in any frame, either sign
  std::optional<PairTally> pairs;  ///< of a scene of random pairs
  std::string refused;  ///< not empty: which frame cannot be judged, and why: a node that is NaN

  /// Valid until another frame is asked for.
  Frame frame(std::size_t index) const;
};

/// What the scene asks the oracle for. Containment also where only level `body` is judged:
/// detectors that take bodies for solids are judged by it there.
oracle::WantedTruth wanted_truth(const scene::Scene& scene);

/// A frame of given nodes and vertices, which must outlive it.
Frame make_frame(std::size_t index, double time, const std::vector<std::vector<Vec3>>& nodes,
                 const std::vector<std::vector<Vec3>>& vertices);

/// The smallest distance between the surfaces of any two bodies in each frame, metres: the upper
/// end of the oracle's certified interval; 0 exactly in contact frames, which cost nothing here.
/// Empty with fewer than two bodies, and of families and random pairs, whose gaps are their own.
/// @pre the scene was not refused
std::vector<double> separations(const JudgedScene& judged, process::ProgressWriter& progress);

}  // namespace contactcheck::judge
