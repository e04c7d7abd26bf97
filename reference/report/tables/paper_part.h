// What the HTML page shows of a reproduction of the paper (reference/reproduce makes it). The page
// draws it: every figure is a cell and every sentence a text here, code in backticks.
#pragma once

#include <string>
#include <vector>

#include "reference/report/tables/table.h"

namespace contactcheck::report {

/// The section "The paper's tables beside ours", in the order of the page.
struct PaperPart {
  /// A scene of the paper. No table is without a title; one without rows is not shown.
  struct Scene {
    std::string title, aside;            ///< its name; what it is of ours
    std::vector<std::string> sentences;  ///< where ours falls short, and how fast and close it is
    std::vector<TitledTable> tables;
  };

  TitledTable overview;               ///< two levels of spheres over one, a row per scene
  std::vector<std::string> readings;  ///< a sentence per way to read the method
  std::string means_title;            ///< empty together with `means`: no scene to take a mean of
  std::vector<std::string> means;
  std::vector<Scene> scenes;
  std::string own_numbers;  ///< the paper, and how many of its own numbers contradict a claim
  TitledTable checks;       ///< of these numbers, each with its sentence in the last cell
};

}  // namespace contactcheck::report
