// Which instruction sets Highway compiles for; to be included before any of its headers.
#pragma once

/// Arm's vectors of unknown length cannot stand in a struct or an array, and the loops here hold
/// whole boxes in registers that way: such machines run NEON. (The macros HWY_SVE... are defined on
/// every platform; elsewhere this has no effect.)
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
