// What each detector finds, scene by scene, at each level.
#pragma once

#include <optional>
#include <vector>

#include "core/types/semantics.h"
#include "reference/report/tables/heat_table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// The levels that some detector claims and was judged at, coarse before fine.
std::vector<Level> judged_levels(const results::Results& results);

/// A row per detector that claims the level somewhere or did not end well somewhere; a column per
/// scene that is no family and is shown (scene_choice.h) and, where there are several, the sum over
/// all.
struct LevelTables {
  HeatTable recall, spurious;
};

/// `level`: none is each detector's finest in each scene; there a sum is only given where that is
/// the same in all, since counts of different levels do not add up.
LevelTables level_tables(const results::Index& index, std::optional<Level> level);

}  // namespace contactcheck::report
