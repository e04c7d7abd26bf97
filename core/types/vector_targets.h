// Which instruction sets Highway compiles for; to be included before any of its headers.
#pragma once

/// Arm's vectors of unknown length cannot stand in a struct or an array, and the loops here hold
/// whole boxes in registers that way: such machines run NEON. (HWY_SVE and its kind have values on
/// every platform; elsewhere this says nothing.)
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
