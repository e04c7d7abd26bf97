// A scene with the ground truth of every frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/judge/judge.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/step_truth.h"
#include "reference/process/shared_progress.h"
#include "reference/scene/frame_positions.h"
#include "reference/scene/random_pairs.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// The answers of rational arithmetic to a scene's random pairs, and where the oracle differs.
struct PairTally {
  struct Kind {
    std::uint64_t pairs = 0, touching = 0;
  };
  std::array<Kind, scene::kPairKinds> kinds;  ///< touching by rational arithmetic
  /// Pairs on which the oracle differs. Reported pairs of triangles in two slots count too, since
  /// they cannot touch.
  std::uint64_t oracle_wrong = 0;
  /// The first pair that the oracle missed and its first spurious one, at level `triangle`; the
  /// caller sets scene and detector.
  std::vector<Disagreement> disagreements;

  std::uint64_t checked() const;
  std::uint64_t touching() const;
};

/// Judges a frame's random pairs a second time, in rational arithmetic. `vertices`: by body, of
/// both bodies; `truth`: the oracle's. `threads` share the pairs (0: one thread per CPU); their
/// number does not change the tally.
void check_pairs(const scene::RandomPairs& pairs, std::size_t frame,
                 const std::vector<std::vector<Vec3>>& vertices, const oracle::Truth& truth,
                 PairTally& tally, unsigned threads = 0);

/// Filled by judge_scene() (accuracy.h).
struct JudgedScene {
  const scene::Scene* scene = nullptr;
  scene::FramePositions positions;
  std::vector<oracle::Truth> truth;  ///< per frame
  std::vector<std::string> open;     ///< per body, as note_open_bodies() fills it
  /// Per frame the length of each true triangle pair, metres; empty if the scene grades no lengths.
  std::vector<std::vector<double>> contour;
  std::vector<bool> contact_frames;  ///< true for frames in which surfaces touch
  /// By step, one fewer than frames; empty if the scene does not judge contact within steps.
  std::vector<oracle::StepTruth> steps;
  double reach = 0.0;              ///< the largest |coordinate| of a vertex in any frame, metres
  std::optional<PairTally> pairs;  ///< for a scene of random pairs
  std::string refused;  ///< not empty: the frame with a non-finite node, which ends the judging

  /// The frame's spans are valid until two others have been requested.
  Frame frame(std::size_t index) const;
  /// From this frame to the next; valid until another frame is requested.
  Step step(std::size_t index) const;
  /// By step: whether anything meets in it.
  std::vector<bool> contact_steps() const;
};

/// What the scene needs from the oracle. Level `body` needs containment as well: it judges
/// detectors that treat bodies as solids by it.
oracle::WantedTruth wanted_truth(const scene::Scene& scene);
oracle::WantedSteps wanted_steps(const scene::Scene& scene);

/// The mean length of a triangle's side at rest, metres; 0 of a body that is a point.
double mean_edge(const BodyShape& shape);

/// A frame that refers to nodes and vertices, both [body][i]; they must outlive it.
Frame make_frame(std::size_t index, double time, const std::vector<std::vector<Vec3>>& nodes,
                 const std::vector<std::vector<Vec3>>& vertices);

/// The smallest distance between the surfaces of any two bodies in each frame, metres: the upper
/// end of the oracle's certified interval; 0 exactly in contact frames, which are not measured.
/// Empty for fewer than two bodies, families, random pairs and drawn scenes.
/// @pre the scene was not refused
std::vector<double> separations(const JudgedScene& judged, process::ProgressWriter& progress);

}  // namespace contactcheck::judge
