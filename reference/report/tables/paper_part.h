// The part of the HTML page about a reproduction of the paper (made by reference/reproduce). Every
// figure is a cell and every sentence a text here, code in backticks; the page only draws them.
#pragma once

#include <string>
#include <vector>

#include "reference/report/tables/table.h"

namespace contactcheck::report {

/// The section "The paper's tables beside ours", in the order of the page.
struct PaperPart {
  /// A scene of the paper. Every table has a title; a table without rows is not shown.
  struct Scene {
    std::string title, aside;            ///< its name; which of our scenes it is
    std::vector<std::string> sentences;  ///< where ours falls short, and its speed and errors
    std::vector<TitledTable> tables;
  };

  TitledTable overview;               ///< two levels of spheres compared with one, a row per scene
  std::vector<std::string> readings;  ///< one sentence per reading of the method
  std::string means_title;            ///< empty together with `means` if no scene has a mean
  std::vector<std::string> means;
  std::vector<Scene> scenes;
  std::string own_numbers;  ///< the paper, and how many of its own numbers contradict a claim
  TitledTable checks;       ///< the checks of these numbers; the last cell is a sentence
};

}  // namespace contactcheck::report
