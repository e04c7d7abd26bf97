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

std::string markdown_of(const TitledTable& table) {
  if (table.rows.empty()) return "";
  std::string out = table.title.empty() ? "" : "### " + table.title + "\n\n";
  if (!table.text.empty()) out += table.text + "\n\n";
  out += table_head(table.columns);
  for (const std::vector<std::string>& row : table.rows) out += table_line(row);
  return out + "\n";
}

std::string titled_table(const std::string& paragraph, const std::vector<Column>& columns,
                         const std::string& rows) {
  if (rows.empty()) return "";
  return paragraph + "\n\n" + table_head(columns) + rows + "\n";
}

}  // namespace contactcheck
