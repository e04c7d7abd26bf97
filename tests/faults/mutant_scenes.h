// The scenes of the judge of the mutants, built in code.
#pragma once

#include <string>
#include <vector>

#include "tests/core/detect/scenes.h"

namespace contactcheck::test {

struct MutantScene {
  std::string name;
  Scene scene;
  bool lattices = true;  ///< false: bodies without, which some detectors refuse
};

/// Frames hold vertices as plainly_mapped() gives them, whatever core's mapping does.
std::vector<MutantScene> mutant_scenes();

}  // namespace contactcheck::test
