// What a report consists of: sections, in one list that every format walks.
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

/// Of a part of a section.
struct Heading {
  std::string text;
};

struct Items {
  std::vector<std::string> texts;
};

/// A file beside report.md.
struct Picture {
  std::string file, what;  ///< in words, for who cannot see it
};

/// A table without rows is not shown, whatever the format, nor a section that has nothing else.
using Block = std::variant<Paragraph, Heading, Items, Picture, TitledTable>;
using Blocks = std::vector<Block>;

/// What a terminal shows of a section: its title, more on the same line, whole lines below, a
/// table. Not shown without lines and rows.
struct TerminalPart {
  std::string title, aside, lines;
  TitledTable table = {};
};

struct Section {
  const char* id;  ///< its place on the page
  const char* title;
  const char* short_title;  ///< in the page's contents
  /// No block that is shown: the results have nothing to say in it.
  Blocks (*build)(const results::Index& index);
  /// None: the terminal does not show it.
  std::vector<TerminalPart> (*terminal)(const results::Index& index) = nullptr;
  /// The page draws it from fields of its own (page_data.h), and is not given its blocks.
  bool drawn_on_page = false;
};

/// In the order of a report. The one without `build` stands for the scenes one by one, which every
/// format shows in a way of its own.
const std::vector<const Section*>& sections();

}  // namespace contactcheck::report
