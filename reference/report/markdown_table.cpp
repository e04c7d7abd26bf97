#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

}  // namespace

std::string table_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + escaped(cell) + " |";
  return line + "\n";
}

std::string table_head(const std::vector<Column>& columns) {
  std::vector<std::string> titles;
  std::string rule = "|";
  for (const Column& c : columns) {
    titles.emplace_back(c.title);
    rule += c.left ? "---|" : "--:|";
  }
  return table_line(titles) + rule + "\n";
}

std::string titled_table(const std::string& paragraph, const std::vector<Column>& columns,
                         const std::string& rows) {
  if (rows.empty()) return "";
  return (paragraph.empty() ? "" : paragraph + "\n\n") + table_head(columns) + rows + "\n";
}

std::string markdown_of(const TitledTable& table) {
  std::string above = table.title.empty() ? "" : "### " + table.title, rows;
  if (!table.text.empty()) above += (above.empty() ? "" : "\n\n") + table.text;
  for (const std::vector<std::string>& row : table.rows) rows += table_line(row);
  return titled_table(above, table.columns, rows);
}

}  // namespace contactcheck
