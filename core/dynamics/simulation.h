// Simulates bodies that fall and collide. Each step is in the paper's order: deformation (MSS),
// ground, then the response to what a detector reports.
// Source: Jeon, Hong, Choi, Jeong 2013, the simulation loop of its Tables 1 and 3.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "core/dynamics/contact_point.h"
#include "core/dynamics/deformable.h"
#include "core/dynamics/ground.h"
#include "core/dynamics/held_contacts.h"
#include "core/dynamics/material.h"
#include "core/dynamics/response.h"

namespace contactcheck {

struct SimulationSettings {
  double time_step = 1.0 / 60;           ///< seconds
  std::uint32_t substeps = 0;            ///< per time step; 0: as few as are stable for all bodies
  Vec3 gravity = Vec3(0.0, -9.81, 0.0);  ///< m/s^2
  std::optional<Ground> ground;
  ResponseSettings response;
  std::uint32_t threads = 1;  ///< bodies are deformed in parallel; results do not depend on it
};

/// A node's position or velocity became NaN, or reached 1e9 m or m/s.
class Diverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Everything that the next step depends on.
struct SimulationState {
  std::vector<NodeState> bodies;
  HeldContacts held;
  std::size_t steps = 0;
};

struct Energy {
  double kinetic = 0.0, elastic = 0.0, potential = 0.0;  ///< joules; potential 0 at the origin
  double total() const { return kinetic + elastic + potential; }
};

class Simulation {
 public:
  /// Bodies without a material cannot be moved. The caller keeps `bodies` alive longer than this.
  /// @throws InputError when a body is too stiff for the wanted substeps, or for 10,000 of them
  /// @throws Diverged when the start has diverged already
  Simulation(const std::vector<Body>& bodies, std::vector<std::optional<Material>> materials,
             const SimulationSettings& settings, std::vector<NodeState> start);

  /// Makes one time step without a new answer of a detector: deformation, gravity, ground, and the
  /// held contacts of the last answer ("Updating MSS").
  /// @throws Diverged, one sentence with body, node and step
  void advance();
  /// Applies the response to contacts of the present state, and holds them for advance().
  void respond(std::vector<ContactPoint> points);

  const SimulationState& state() const { return state_; }
  /// Goes back (or on) to a state of a simulation of the same bodies.
  void restore(const SimulationState& state) { state_ = state; }

  Energy energy() const;
  Vec3 momentum() const;  ///< kg m/s, of all movable bodies
  /// Substeps per time step, for all bodies: as many as the body with the shortest stable step
  /// needs, unless the settings want more.
  std::uint32_t substeps() const { return substeps_; }

 private:
  void choose_substeps(std::size_t body);
  void advance_body(std::size_t body, double dt, ResponseBody& mover);
  void answer_ground(std::size_t body, ResponseBody& mover);
  ResponseBody response_body(std::size_t body);
  std::vector<ResponseBody> response_bodies();
  void check_state() const;

  const std::vector<Body>& bodies_;
  std::vector<std::optional<Material>> materials_;
  SimulationSettings settings_;
  std::vector<std::unique_ptr<const Deformable>> deformables_;  // null: cannot be moved
  std::uint32_t substeps_ = 1;
  SimulationState state_;
};

}  // namespace contactcheck
