// Errors with a size: missed length, distances, depths and normals.
#pragma once

#include <optional>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/semantics.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/surface_geometry.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// A depth below this share of the scene's size has no direction that could be judged.
inline constexpr double kNormalFloor = 1e-9;

/// Ascending edges of bins, the same for every result, in metres: 0, 1e-12, 2e-12, 5e-12, 1e-11,
/// ... up to the largest double.
const std::vector<double>& length_edges();
/// The same for angles, in degrees: 0, 5, 10, ..., 180.
const std::vector<double>& angle_edges();

/// The non-empty bins of `values`, ascending. A value on an edge belongs to the bin above it, one
/// beyond the last edge to the last bin. @pre no value is negative
std::vector<results::HistogramBin> histogram(const std::vector<double>& values,
                                             const std::vector<double>& edges);

/// Max, mean and 95th percentile (nearest rank). Sorts `errors`.
results::ErrorSpread spread_of(std::vector<double>& errors);

/// Compares a detector's answers with true lengths, distances and depths, and sums up the errors.
///
/// - A missed triangle pair weighs its intersection's length. A detector of cells misses the pairs
///   that no reported pair of cells covers.
/// - A spurious triangle pair weighs its distance.
/// - Depth `convex-pair`: of the contacts of one pair of pieces the deepest counts, against the
///   shortest translation that separates the two. Disjoint pieces have no depth.
/// - Depth `vertex-surface`: of the contacts of one vertex the shallowest counts, against the
///   distance to the surface, for vertices that are truly inside.
/// - A normal's error is its angle to the nearest of all shortest separating directions, where the
///   true depth is at least kNormalFloor times the size.
class GradedErrors {
 public:
  /// `size`: of the scene, metres. `bodies` must outlive this object.
  GradedErrors(const std::vector<Body>& bodies, const Semantics& semantics, double size)
      : bodies_(bodies), semantics_(semantics), size_(size) {}

  /// `contour`: the intersection length of each true triangle pair, metres. `geometry` is at this
  /// frame. Returns the share of the frame's contour that is covered; nothing for a frame without
  /// contour or a detector that reports no elements.
  /// @pre all sets are canonical
  std::optional<double> add_frame(const oracle::Truth& truth, const std::vector<double>& contour,
                                  const ContactSet& reported, oracle::SurfaceGeometry& geometry);
  /// The sums over all frames; episodes and their sums are not set.
  results::Geometry summary();

 private:
  void add_depth(const oracle::Penetration& truth, double depth, const Vec3& normal);

  const std::vector<Body>& bodies_;
  Semantics semantics_;
  double size_;
  double contour_ = 0.0, missed_ = 0.0;
  std::vector<double> spurious_distances_, depth_errors_, normal_errors_;
};

}  // namespace contactcheck::judge
