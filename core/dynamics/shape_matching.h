// Shape matching on overlapping regions of the lattice.
// Sources: Mueller, Heidelberger, Teschner, Gross, Meshless Deformations Based on Shape Matching,
// 2005; Rivers & James, FastLSM: Fast Lattice Shape Matching for Robust Real-Time Deformation,
// 2007 (regions, a node's mass shared among its own, damping by regions).
//
// Every region fits its rest shape, rigidly moved, to its nodes (least squares, weighted by mass);
// a node's goal is the mean over its regions. The node is drawn to its goal like a critically
// damped oscillator of the time constant tau = relaxation_time, x'' = -e/tau^2 - 2 w/tau, where e
// is its offset from the goal and w its velocity against the mean rigid motion of its regions.
//
// One step is drift, kick, drift. The kick, with the share s = dt / (dt + tau), takes
// s^2 e / dt + s (2 - s) w from the velocity: the oscillator's implicit Euler step for a goal that
// stands still. As e and w are, mode by mode, a share p in [0, 1] of the displacement and the
// velocity, the step is stable (see verlet.h) when (s^2 + 2 s (2 - s)) p <= 4; the left side never
// exceeds 3, so every dt is stable. The 2005 paper moves nodes to their goals by a share per step,
// so that its stiffness depends on dt and nothing is damped; this form has neither property.
//
// The kick is a gradient of the energy below and an internal damping: it keeps linear and angular
// momentum. A rigid rotation at the rate W stretches the body by (W tau)^2, as it would any
// elastic one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/deformable.h"
#include "core/dynamics/fixed_order.h"

namespace contactcheck {

class ShapeMatching final : public Deformable {
 public:
  /// One region per kept cell: the nodes of all cells that it reaches over at most `region` kept
  /// neighbours (cells that share a node). Two limbs that are near but not joined nearby do not
  /// stick together. region 0: one region with all nodes.
  /// @pre mass and relaxation time above 0
  ShapeMatching(const Lattice& lattice, const Material& material);

  std::span<const double> masses() const override { return masses_; }
  void step(double dt, const Vec3& acceleration, NodeState& state) const override;
  double stable_step() const override { return std::numeric_limits<double>::infinity(); }
  /// Half the squared distance of every node to its goal in each of its regions, by its mass there,
  /// over the relaxation time squared: the energy whose gradient draws the nodes.
  double elastic_energy(std::span<const Vec3> positions) const override;

  std::size_t region_count() const { return first_member_.size() - 1; }

 private:
  struct Member {
    std::uint32_t node = 0;
    double mass = 0.0;  // the node's mass, divided by the number of its regions
    Vec3 rest;          // from the region's centre of mass
  };
  // A region's rigid motion nearest to its members.
  struct Fit {
    Vec3 center, velocity, spin;
    Mat3 rotation;
    Vec3 goal(const Member& m) const { return center + ordered_product(rotation, m.rest); }
  };
  struct Pull {
    Vec3 offset, excess;  // sums over the node's regions: to the goal, to the rigid motion
  };

  std::span<const Member> members(std::size_t region) const;
  void add_region(const std::vector<std::uint32_t>& nodes, const std::vector<Vec3>& rest);
  Fit place(std::size_t region, std::span<const Vec3> positions) const;
  void add_motion(std::size_t region, const NodeState& state, Fit& fit) const;
  void add_pulls(const NodeState& state, std::span<Pull> pulls) const;

  double relaxation_time_;
  std::vector<double> masses_;
  std::vector<double> region_shares_;      // per node: 1 / number of its regions
  std::vector<Member> members_;            // of all regions, one after the other
  std::vector<std::size_t> first_member_;  // per region, and the end
  std::vector<double> region_masses_;
};

}  // namespace contactcheck
