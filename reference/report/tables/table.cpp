#include "reference/report/tables/table.h"

#include <algorithm>

namespace contactcheck::report {

void ColumnMeanings::add(const std::vector<Column>& columns) {
  for (const Column& column : columns)
    if (!column.meaning.empty() && std::ranges::none_of(all_, [&](const Column& known) {
          return known.title == column.title && known.meaning == column.meaning;
        }))
      all_.push_back(column);
}

void erase_column(std::size_t i, TitledTable& table) {
  const auto at = static_cast<std::ptrdiff_t>(i);
  table.columns.erase(table.columns.begin() + at);
  for (std::vector<std::string>& row : table.rows)
    row.erase(is_message(row) ? row.end() - 1 : row.begin() + at);
}

void leave_out_untimed(TitledTable& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (table.columns[i].role == Role::kTime &&
        std::ranges::any_of(table.rows, [i](const std::vector<std::string>& row) {
          return !row[i].empty() && row[i] != "-";
        }))
      return;
  for (std::size_t i = table.columns.size(); i-- > 0;)
    if (table.columns[i].role == Role::kTime || table.columns[i].role == Role::kOfTimes)
      erase_column(i, table);
}

}  // namespace contactcheck::report
