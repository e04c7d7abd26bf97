// A simulation with a detector in the loop: the paper's whole step in parts that can be timed
// separately.
// Source: Jeon, Hong, Choi, Jeong 2013, Tables 1 and 3 ("Updating MSS", "Updating CELL", collision
// test, response).
#pragma once

#include <string>
#include <vector>

#include "core/detect/detector.h"
#include "core/dynamics/simulation.h"
#include "reference/scene/scene.h"

namespace contactcheck::scene {

/// Why a detector cannot drive a simulation (it reports neither cells nor triangles in contact), or
/// "".
std::string why_no_driver(const Semantics& semantics);

/// The initial nodes of all bodies, with their velocities.
/// @pre the scene is simulated
std::vector<NodeState> start_of(const Scene& scene);

class DrivenSimulation {
 public:
  /// Prepares the detector. Scene and detector must outlive this object.
  /// @pre the scene is simulated
  /// @throws InputError when the detector cannot drive, or a body is too stiff
  DrivenSimulation(const Scene& scene, Detector& detector);

  /// The four parts of a step, in this order.
  void deform();  ///< MSS: springs, gravity, ground. @throws Diverged
  void
  update_cells();  ///< CELL: maps every vertex, as a viewer needs them, and updates the detector
  void test();     ///< queries the detector
  void respond();  ///< impulses and corrections at the reported contacts
  void step();     ///< all four

  /// The detector's input in the last step: the state after deform() and before respond().
  const std::vector<std::vector<Vec3>>& nodes() const { return nodes_; }
  /// The detector's answer, canonical.
  const ContactSet& contacts() const { return contacts_; }

  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }

 private:
  const Scene& scene_;
  Detector& detector_;
  Question question_;
  Simulation simulation_;
  ContactPoints points_;
  std::vector<std::vector<Vec3>> nodes_, vertices_;
  Frame frame_;
  ContactSet contacts_;
};

}  // namespace contactcheck::scene
