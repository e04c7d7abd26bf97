// The truth for the values that a detector in single precision was fed: float(scale * x).
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "reference/run/judged_scene.h"

namespace contactcheck {

/// One scene in the values of one scale; truths are computed when first asked for and kept.
class RoundedScene {
 public:
  RoundedScene(const JudgedScene& judged, double scale);

  /// False when a coordinate is beyond single precision at this scale: there is no such scene.
  bool representable() const { return representable_; }
  /// The rounded vertices, in units of 1 / scale metres; valid until the next call.
  /// @pre representable()
  const Frame& frame(std::size_t index);
  /// @pre representable()
  const Truth& truth(std::size_t index, Oracle& oracle);

 private:
  const JudgedScene& judged_;
  double scale_;
  bool representable_ = true;
  std::vector<std::vector<Vec3>> vertices_;
  Frame frame_;
  std::vector<std::optional<Truth>> truths_;
};

/// Two times between which a pair of bodies first touches.
struct ContactMoment {
  double before = 0.0, after = 0.0;  ///< seconds
};

/// What judging the detectors of a scene takes, made once.
struct JudgingTools {
  explicit JudgingTools(const JudgedScene& judged);
  /// The scene in the values of a scale; nullptr where they do not fit into single precision.
  RoundedScene* rounded(double scale);

  const JudgedScene& judged;
  Oracle oracle;
  SurfaceGeometry geometry;
  /// By pair and first frame of true contact; filled by measure_hover_gaps().
  std::map<std::pair<BodyPair, std::size_t>, ContactMoment> true_contacts;

 private:
  std::map<double, RoundedScene> rounded_;
};

}  // namespace contactcheck
