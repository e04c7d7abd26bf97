#include "reference/report/markdown_table.h"

namespace contactcheck::report {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string line_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + escaped(cell) + " |";
  return line + "\n";
}

}  // namespace

std::string markdown_of(const TitledTable& table) {
  if (table.rows.empty()) return "";
  std::vector<std::string> titles;
  std::string rule = "|";
  for (const Column& c : table.columns) {
    titles.emplace_back(c.title);
    rule += c.left ? "---|" : "--:|";
  }
  std::string out = table.title.empty() ? "" : "### " + table.title + "\n\n";
  if (!table.text.empty()) out += table.text + "\n\n";
  out += line_of(titles) + rule + "\n";
  for (const std::vector<std::string>& row : table.rows) out += line_of(row);
  return out + "\n";
}

}  // namespace contactcheck::report
