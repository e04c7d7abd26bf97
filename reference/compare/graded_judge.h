// Errors with a size: lengths of contour, distances, depths and normals.
#pragma once

#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/semantics.h"
#include "reference/compare/histogram.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/surface_geometry.h"
#include "reference/results/results.h"

namespace contactcheck {

/// Below this share of the scene's size a depth has no direction to be judged.
inline constexpr double kNormalFloor = 1e-9;

/// Max, mean and 95th percentile (nearest rank). Sorts `errors`.
results::ErrorSpread spread_of(std::vector<double>& errors);

/// Holds what a detector reports against lengths, distances and depths, frame by frame.
///
/// - A missed triangle pair weighs its intersection's length; for a detector of cells the pairs
///   that no reported pair of cells covers are missed.
/// - A spurious triangle pair weighs its distance.
/// - Depth `convex-pair`: of the contacts of one pair of pieces the deepest counts, against the
///   shortest translation that parts the two; pieces that share no point have no depth.
/// - Depth `vertex-surface`: of the contacts of one vertex the shallowest counts, against the
///   distance to the surface, for vertices that are truly inside.
/// - A normal's error is its angle to the nearest of all true ways out, where the true depth is at
///   least kNormalFloor times the size.
class GradedJudge {
 public:
  /// `size`: of the scene, metres.
  GradedJudge(const std::vector<Body>& bodies, const Semantics& semantics, double size);

  /// `contour`: the intersection length of each true triangle pair. `geometry` is at this frame.
  /// @pre all sets are canonical
  void add_frame(const Truth& truth, const std::vector<double>& contour, const ContactSet& reported,
                 SurfaceGeometry& geometry);

  /// The share of the last frame's contour that is covered.
  std::optional<double> last_covered_fraction() const { return last_covered_; }
  /// Without episodes and what is said of them.
  results::Geometry errors();

 private:
  bool covers(const ContactSet& reported, const ElementPair& pair) const;
  void add_contour(const Truth& truth, const std::vector<double>& contour,
                   const ContactSet& reported);
  void add_spurious(const Truth& truth, const ContactSet& reported,
                    const SurfaceGeometry& geometry);
  void add_pieces(const ContactSet& reported, SurfaceGeometry& geometry);
  void add_vertices(const Truth& truth, const ContactSet& reported,
                    const SurfaceGeometry& geometry);
  void add_way_out(const WayOut& truth, double depth, const Vec3& normal);

  const std::vector<Body>& bodies_;
  Semantics semantics_;
  double size_;
  double contour_ = 0.0, missed_ = 0.0;
  std::optional<double> last_covered_, spurious_distance_;
  Histogram spurious_distances_ = Histogram::of_lengths();
  std::vector<double> depth_errors_, normal_errors_;
};

}  // namespace contactcheck
