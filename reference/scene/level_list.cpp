#include "reference/scene/level_list.h"

#include <algorithm>
#include <string>

namespace contactcheck {

std::vector<Level> parse_levels(const JsonField& field) {
  const std::vector<Level> known = {Level::kBody, Level::kContainment, Level::kCell,
                                    Level::kBox,  Level::kTriangle,    Level::kVertex,
                                    Level::kNear};
  std::vector<std::string> names;
  for (const Level level : known) names.emplace_back(name_of(level));
  std::vector<Level> levels;
  for (const JsonField& item : field.items(1)) {
    const auto name = std::find(names.begin(), names.end(), item.one_of(names));
    const Level level = known[static_cast<std::size_t>(name - names.begin())];
    if (std::find(levels.begin(), levels.end(), level) != levels.end()) {
      item.refuse("named once only");
    }
    levels.push_back(level);
  }
  return levels;
}

}  // namespace contactcheck
