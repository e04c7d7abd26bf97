// Runs two builds, of this program or of a plug-in, in turns.
#pragma once

#include <functional>
#include <vector>

#include "reference/ab/ab_judge.h"
#include "reference/cli/ab_sides.h"
#include "reference/cli/commands.h"

namespace contactcheck {

/// Base head, head base, base head, ...: what slows the machine down for a while hits both. Every
/// run is a fresh process with results of its own in OUT/base or OUT/head, where the last ones
/// stay. `sides`: base and head. `on_round` is called with the number of each round, from 0.
/// @throws InputError when a program cannot be started, is refused its input or leaves no results
/// that can be read; Interrupted
std::vector<AbRound> run_rounds(const std::vector<AbSide>& sides, const AbArguments& arguments,
                                const std::function<void(std::size_t)>& on_round);

}  // namespace contactcheck
