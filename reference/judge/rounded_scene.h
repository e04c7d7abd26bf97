// The truth for the values that a detector in single precision was fed: float(scale * x), or
// float(x - origin) about the local origin of the frame.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "reference/judge/judged_scene.h"
#include "reference/oracle/surface_geometry.h"

namespace contactcheck::judge {

/// How the input of a single-precision detector is rounded.
struct Rounding {
  double scale = 1.0;         ///< fed_value(), without a local origin
  bool local_origin = false;  ///< local_value() about local_origin() of each frame
  auto operator<=>(const Rounding&) const = default;
};

/// A scene in the values of one rounding. Truths are computed on demand and cached.
class RoundedScene {
 public:
  RoundedScene(const JudgedScene& judged, const Rounding& rounding);

  /// False if a coordinate overflows single precision.
  bool representable() const { return representable_; }
  /// The rounded vertices, in units of 1 / scale metres, about the local origin if there is one;
  /// valid until the next call.
  /// @pre representable()
  const Frame& frame(std::size_t index);
  /// @pre representable()
  const oracle::Truth& truth(std::size_t index, oracle::Oracle& oracle);

 private:
  Vec3 origin_of(std::size_t index) const;

  const JudgedScene& judged_;
  Rounding rounding_;
  bool representable_ = true;
  std::vector<std::vector<Vec3>> vertices_;
  Frame frame_;
  std::vector<std::optional<oracle::Truth>> truths_;
};

/// Two times: the bodies of a pair are separated at the first and touch at the second.
struct ContactMoment {
  double before = 0.0, after = 0.0;  ///< seconds
};

/// Caches for judging all detectors of a scene.
struct JudgingTools {
  explicit JudgingTools(const JudgedScene& judged);
  /// The scene in rounded values; nullptr if they overflow single precision.
  RoundedScene* rounded(const Rounding& rounding);

  const JudgedScene& judged;
  oracle::Oracle oracle;
  oracle::SurfaceGeometry geometry;
  /// By pair and first frame of true contact; a cache of measure_hover_gaps() (hover.h).
  std::map<std::pair<BodyPair, std::size_t>, ContactMoment> true_contacts;

 private:
  std::map<Rounding, RoundedScene> rounded_;
};

}  // namespace contactcheck::judge
