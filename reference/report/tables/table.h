// Tables, as every format of a report shows them.
#pragma once

#include <string>
#include <vector>

namespace contactcheck::report {

/// What a format treats apart in a column.
enum class Role {
  kPlain,
  kErrors,   ///< counts, in which every number above 0 is an error
  kTime,     ///< times, or ratios of times
  kOfTimes,  ///< says something of the times, and nothing where none is shown
  kVerdict,  ///< "yes" and "no", or why there is no verdict
};

struct Column {
  std::string title;
  bool left;                 ///< aligned
  std::string meaning = {};  ///< for the legend; may be empty
  std::string id = {};       ///< by which a format finds it; empty where none looks for it
  Role role = Role::kPlain;
  /// Where lines would be too long, columns with a number above 0 are left out, highest first.
  int spare = 0;
};

/// A table with what is said above it. Code is in backticks.
struct TitledTable {
  std::string title, text;  ///< either may be empty
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
  std::string id = {};  ///< where something leads to it
};

}  // namespace contactcheck::report
