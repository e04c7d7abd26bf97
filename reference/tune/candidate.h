// What can be chosen for a scene: a detector with its options, in a lattice of some resolution,
// with a deformer.
#pragma once

#include <string>
#include <vector>

namespace contactcheck::tune {

/// A value on one axis: "detector" is "ffd-aabb", "cell" is "2", "lattice" is "0.5".
struct Choice {
  std::string axis, value;

  bool operator==(const Choice&) const = default;
};

/// The cost of a frame, or of a step of a simulation.
struct Cost {
  double ms = 0.0;
  double low_ms = 0.0, high_ms = 0.0;  ///< its interval (paired_cost.h)
};

/// (`Candidate` is what reference/reduce tries.)
struct TuneCandidate {
  std::string detector;  ///< canonical name, options included
  double lattice = 1.0;  ///< times the scene's own number of kept cells
  std::string deformer;  ///< of a simulated scene; empty: the scene's own, which is not varied
  Cost step;             ///< of the simulation with this deformer, without its collision test
  /// The first is the detector's id, on the axis "detector"; then options, lattice and deformer.
  std::vector<Choice> choices;
  bool usual = false;  ///< every option at its default, the scene's own lattice and deformer
};

}  // namespace contactcheck::tune
