// Tables for all formats of a report.
#pragma once

#include <string>
#include <vector>

namespace contactcheck::report {

/// Columns that formats treat specially.
enum class Role {
  kPlain,
  kErrors,   ///< counts, in which every number above 0 is an error
  kTime,     ///< times, or ratios of times
  kOfTimes,  ///< about the times; has no meaning where none is shown
  kVerdict,  ///< "yes" and "no", or why there is no verdict
};

struct Column {
  std::string title;
  bool left;                 ///< aligned left
  std::string meaning = {};  ///< for the legend; may be empty
  std::string id = {};       ///< an id for formats that look the column up; may be empty
  Role role = Role::kPlain;
  /// If lines are too long, columns with a number above 0 are left out, highest first.
  int spare = 0;
};

/// A table with a title and a text above it. Code is in backticks.
struct TitledTable {
  std::string title, text;  ///< either may be empty
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
  std::string id = {};  ///< an anchor, if something links to it
};

/// Columns of several tables that have a meaning, each once.
class ColumnMeanings {
 public:
  void add(const std::vector<Column>& columns);
  const std::vector<Column>& all() const { return all_; }

 private:
  std::vector<Column> all_;
};

/// True for a row that has a message where others have figures: its last cells are empty.
inline bool is_message(const std::vector<std::string>& row) { return row.back().empty(); }

/// A row with a message keeps it, and loses an empty cell. @pre more columns than a message takes
void erase_column(std::size_t i, TitledTable& table);

/// Leaves out the columns of times, and those about times, if no row has any.
void leave_out_untimed(TitledTable& table);

}  // namespace contactcheck::report
