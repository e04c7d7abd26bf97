// Bodies that fall, hit and answer: one step after the other, each in the paper's order: deform
// (MSS), ground, then whatever a detector reports is answered (response).
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
  std::uint32_t substeps = 0;            ///< of a time step; 0: per body as few as are stable
  Vec3 gravity = Vec3(0.0, -9.81, 0.0);  ///< m/s^2
  std::optional<Ground> ground;
  ResponseSettings response;
  std::uint32_t threads = 1;  ///< bodies are deformed side by side; results do not depend on it
};

/// A node left the finite numbers, or went faster than anything here can be meant to.
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
  double kinetic = 0.0, elastic = 0.0, potential = 0.0;  ///< Joule; potential above the origin
  double total() const { return kinetic + elastic + potential; }
};

class Simulation {
 public:
  /// Bodies without a material stay where they are and cannot be moved. The bodies outlive this.
  /// @throws InputError when a body is too stiff for the wanted substeps, or for 10,000 of them
  /// @throws Diverged when the start is not finite
  Simulation(const std::vector<Body>& bodies, std::vector<std::optional<Material>> materials,
             const SimulationSettings& settings, std::vector<NodeState> start);

  /// One time step without a new answer of a detector: deformation, gravity, ground, and the
  /// contacts of the last answer held ("Updating MSS").
  /// @throws Diverged, one sentence with body, node and step
  void advance();
  /// Answers contacts of the present state.
  void respond(std::vector<ContactPoint> points);

  const SimulationState& state() const { return state_; }
  /// Goes back (or on) to a state of a simulation of the same bodies.
  void restore(const SimulationState& state) { state_ = state; }

  Energy energy() const;
  Vec3 momentum() const;  ///< kg m/s, of all movable bodies
  /// Of a time step, for all bodies: as many as the one of the shortest stable step needs, unless
  /// the settings want more.
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
