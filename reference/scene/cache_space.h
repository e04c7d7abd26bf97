// The coordinate system of a point cache, found by comparing its first sample with the mesh.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck::scene {

/// Permutes and mirrors axes, then translates: new[i] = sign[i] old[axis[i]] + offset[i].
struct SpaceChange {
  std::array<int, 3> axis = {0, 1, 2};
  std::array<double, 3> sign = {1.0, 1.0, 1.0};
  Vec3 offset = Vec3::Zero();  ///< in the unit of the points

  bool turns() const { return axis != std::array{0, 1, 2} || sign != std::array{1.0, 1.0, 1.0}; }
  bool moves() const { return offset != Vec3::Zero(); }
  bool is_identity() const { return !turns() && !moves(); }
  /// Coordinates that no part of the change affects keep their bits.
  void apply(std::vector<Vec3>& points) const;
  /// "axes x z -y, moved by (1, 0, 0)"
  std::string described() const;
};

/// The change that maps `points` to `mesh`, within 1e-6 of the mesh's largest side in each
/// coordinate: the identity, else one of the 48 permutations and mirrorings, else one with an
/// offset. Rotations are tried before reflections, those about x first. Nothing if no change fits,
/// or several rotations do (points on a line). @pre as many points as vertices, all finite
std::optional<SpaceChange> space_change(const std::vector<Vec3>& points,
                                        const std::vector<Vec3>& mesh);

}  // namespace contactcheck::scene
