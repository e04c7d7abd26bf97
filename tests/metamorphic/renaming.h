// The same surfaces under other ids: nothing that a detector is asked about may depend on them.
#pragma once

#include "tests/metamorphic/subject.h"

namespace contactcheck::test {

struct Renaming {
  bool reverse_bodies = false;
  bool flip_winding = false;  ///< of every triangle
  bool shuffle_triangles = false;
  bool shuffle_vertices = false;
  bool turn_corners = false;  ///< each triangle begins with another of its corners, by its number
};

/// Shapes are made anew on the same grid lines, and bodies that share one go on sharing it.
/// Deformed vertices keep their bits.
Variant renamed(std::shared_ptr<const Subject> subject, const Renaming& how);

}  // namespace contactcheck::test
