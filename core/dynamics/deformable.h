// The interface of all models that move the lattice nodes of a body between contacts.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/deform/body.h"
#include "core/dynamics/material.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// The lattice nodes of one body.
struct NodeState {
  std::vector<Vec3> positions;   ///< metres
  std::vector<Vec3> velocities;  ///< metres per second
};

/// One body's lattice, at rest in the positions of Lattice::rest_nodes(). Uses additions, products,
/// quotients and square roots alone, in a fixed order: the same bits on every machine. It has no
/// mutable state: several threads may use one object.
class Deformable {
 public:
  Deformable() = default;
  Deformable(const Deformable&) = delete;
  Deformable& operator=(const Deformable&) = delete;
  virtual ~Deformable() = default;

  /// kg per lattice node; every one above 0, their sum the body's mass.
  virtual std::span<const double> masses() const = 0;
  /// Advances by dt seconds under the same acceleration (m/s^2) for all nodes, without contact.
  /// @pre dt <= stable_step()
  virtual void step(double dt, const Vec3& acceleration, NodeState& state) const = 0;
  /// Seconds: no longer step keeps the energy bounded; infinity where every step does. A proven
  /// bound for small strain, with a margin for large ones.
  virtual double stable_step() const = 0;
  /// Joule; 0 at rest and in every rigidly moved copy of it.
  virtual double elastic_energy(std::span<const Vec3> positions) const = 0;
};

/// The mass of a body spread over its lattice nodes: every kept cell gives an eighth of its share
/// (by volume at rest) to each corner.
std::vector<double> node_masses(const Lattice& lattice, double mass);

/// @pre the shape has a lattice
std::unique_ptr<const Deformable> make_deformable(const BodyShape& shape, const Material& material);

}  // namespace contactcheck
