// How much of their slacks the errors of bounds take up that are moved from one body's frame to
// another's, in searches for large errors by exact arithmetic. On the instruction set that needs no
// choice: the operations of lanes are the same on all, and what others fuse rounds less.
#pragma once

namespace contactcheck::test {

/// Between which frames: one, two in a frame, or two over a step.
enum class FramePair { kOne, kTwo, kMoving };
/// Which comparison of not_separated() separates: along the normal of the slab that is moved, or of
/// the lane.
enum class Along { kMoved, kLane };

/// By how much the translation of boxes falls short of the exact offset of two frames, at either
/// end of a step, over the larger of that offset and 2^-126. Above 0: it does not hold. Where
/// rounding to floats outward is all that it adds, it is hardly below.
double largest_shortfall_of_translations();

/// Over the slack of translated slabs; of one frame: over that of LazyState.
double largest_error_of_slab_tests(FramePair frames, Along along);

}  // namespace contactcheck::test
