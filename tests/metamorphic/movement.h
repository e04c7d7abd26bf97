// The same scene at another size, place or attitude. Exact ones keep the sign of every determinant,
// and with it every answer; rounded ones make a new scene, which the oracle judges anew.
#pragma once

#include "tests/metamorphic/subject.h"

namespace contactcheck::test {

/// What is moved along with the deformed positions.
enum class Rest { kStays, kMoves };

/// Every coordinate times 2^exponent, where that loses no bit.
Variant scaled(std::shared_ptr<const Subject> subject, int exponent, Rest rest);
/// Frame by frame by the largest power of two that keeps all positions finite.
Variant scaled_to_the_largest(std::shared_ptr<const Subject> subject);
/// Frame by frame by the smallest power of two that loses no bit.
Variant scaled_to_the_smallest(std::shared_ptr<const Subject> subject);

/// Axes in another order and some of them turned round: one of the 23 such rotations other than
/// none, or one of the 24 reflections, by the frame's label.
Variant turned_to_other_axes(std::shared_ptr<const Subject> subject, bool mirrored);

/// How a body is made that can be given any vertices.
enum class Carrier {
  kNodes,  ///< vertices are lattice nodes: for detectors that need lattices; small meshes
  kBare    ///< without a lattice
};

/// Vertices are first rounded to multiples of a power of two, so that the sum with the shift, which
/// is about 2^exponent times the farthest coordinate, is exact. `plain` has the rounded ones.
Variant translated(std::shared_ptr<const Subject> subject, int exponent, Carrier carrier);

/// By a rotation without angles and a shift as long as the farthest coordinate; all is rounded.
/// `plain` is the moved scene itself.
Variant moved_with_rounding(std::shared_ptr<const Subject> subject);

}  // namespace contactcheck::test
