// Scripted motions of lattice nodes: Barr's global deformations, node keyframes and a rigid pose,
// as functions of time. Motions use libm's sines unless they ask for portable ones: trajectories
// are recorded, and everything after the recorded nodes is bit-reproducible.
// Source: Barr, Global and Local Deformations of Solid Primitives, SIGGRAPH 1984.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "core/deform/lattice.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// A piecewise linear (or smoothstep-eased) curve over time; constant outside its keys.
struct Curve {
  struct Key {
    double time = 0.0;  ///< seconds, strictly increasing
    double value = 0.0;
  };
  std::vector<Key> keys;  ///< empty: constantly 0
  bool smooth = false;

  double at(double time) const;
};

/// Rotates each cross-section about `axis`, in proportion to its height above the rest centre.
struct Twist {
  int axis = 2;
  Curve angle;  ///< degrees over the whole body height
};

/// Bends the body along `axis` towards `toward`: its centre line becomes an arc.
struct Bend {
  int axis = 2;    ///< the direction that is bent
  int toward = 0;  ///< the direction it is bent to
  Curve angle;     ///< degrees over the whole body height
};

/// Scales each cross-section by 1 + amount * (relative height in [-1, 1]).
struct Taper {
  int axis = 2;
  Curve amount;  ///< dimensionless
};

/// Scales along an axis by (1 + amount) and across by 1 / sqrt(1 + amount).
struct Stretch {
  int axis = 2;
  Curve amount;  ///< dimensionless, above -1
};

/// Displaces single grid nodes; linear between keys.
struct NodeKeys {
  struct Key {
    double time = 0.0;
    std::vector<std::pair<GridIndex, Vec3>> offsets;  ///< metres; nodes not named: zero
  };
  std::vector<Key> keys;
};

using Deformer = std::variant<Twist, Bend, Taper, Stretch, NodeKeys>;

/// Rigid path: rotation (axis-angle, degrees about a fixed axis) about the body's rest centre, then
/// translation, both after the deformers.
struct RigidPath {
  struct Spin {
    Vec3 axis = Vec3::UnitZ();
    Curve angle;  ///< degrees
  };
  std::array<Curve, 3> position;  ///< metres; where the body's rest centre goes
  std::vector<Spin> spins;        ///< applied in order
};

/// Displacements of the deformers are summed, each computed from the rest position; the rigid path
/// comes last.
struct Motion {
  std::vector<Deformer> deformers;
  RigidPath path;
  bool portable_sines = false;  ///< portable_sine.h: nodes have the same bits on every machine
};

struct BodyShape;
/// The shape's lattice nodes (without a lattice: vertices) at `time`, s. NodeKeys need a lattice.
std::vector<Vec3> nodes_at(const BodyShape& shape, const Motion& motion, double time);

}  // namespace contactcheck
