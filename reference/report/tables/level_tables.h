// The contacts that each detector finds, by scene and level.
#pragma once

#include <optional>
#include <vector>

#include "core/types/semantics.h"
#include "reference/report/tables/heat_table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// The levels that some detector claims and was judged at, coarse before fine.
std::vector<Level> judged_levels(const results::Results& results);

/// One row per detector that claims the level somewhere or did not end well somewhere; one column
/// per shown scene (scene_choice.h) that is not a family and, for several scenes, their sum.
struct LevelTables {
  HeatTable recall, spurious;
};

/// `level`: none means each detector's finest level in each scene. A sum then needs the same level
/// in all scenes, since counts of different levels do not add up.
LevelTables level_tables(const results::Index& index, std::optional<Level> level);

}  // namespace contactcheck::report
