// The sections of a report, in one list for all formats.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

struct Paragraph {
  std::string text;  ///< code is in backticks, here and below
};

/// The heading of a part of a section.
struct Heading {
  std::string text;
};

struct Items {
  std::vector<std::string> texts;
};

/// A file next to report.md.
struct Picture {
  std::string file, what;  ///< described in words, for readers without pictures
};

/// A table without rows is not shown in any format, nor is a section with nothing else.
using Block = std::variant<Paragraph, Heading, Items, Picture, TitledTable>;
using Blocks = std::vector<Block>;

/// A section on the terminal: its title, text on the same line, whole lines below, a table. Not
/// shown without lines and rows.
struct TerminalPart {
  std::string title, aside, lines;
  TitledTable table = {};
};

struct Section {
  const char* id;  ///< its anchor on the page
  const char* title;
  const char* short_title;  ///< in the page's contents
  /// Returns no shown block if the results have nothing for this section.
  Blocks (*build)(const results::Index& index);
  /// Null: not on the terminal.
  std::vector<TerminalPart> (*terminal)(const results::Index& index) = nullptr;
  /// True: the page draws it from other fields (page_data.h) and does not get its blocks.
  bool drawn_on_page = false;
};

/// In the order of a report. The section without `build` is a placeholder for the scenes, which
/// each format shows in its way.
const std::vector<const Section*>& sections();

}  // namespace contactcheck::report
