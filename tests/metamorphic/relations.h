// The relations, each a way of putting a question differently and what the answer then must be.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/metamorphic/calls.h"
#include "tests/metamorphic/subject.h"

namespace contactcheck::test {

struct Relation {
  std::string name;  ///< in letters and digits, as GoogleTest wants it
  std::function<Variant(std::shared_ptr<const Subject>)> variant;
  Calls calls = ask_in_order;
  /// A margin can be scaled along, and what is nearer than it told in reasonable time.
  bool margins = true;
  /// The plain frames are those of the variant: the oracle's answer to them is all there is.
  bool judged_anew = false;
};

/// For cases of few triangles: every way by itself, bodies on lattice nodes where vertices are to
/// be exact.
const std::vector<Relation>& relations_of_cases();
/// For meshes of thousands of triangles: ids changed in all ways at once, bodies without lattices
/// where vertices are to be exact.
const std::vector<Relation>& relations_of_scenes();

}  // namespace contactcheck::test
