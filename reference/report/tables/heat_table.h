// Tables with a colour per cell for the share of errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace contactcheck::report {

struct HeatCell {
  std::string text;
  std::optional<double> share;  ///< of errors, in [0, 1], shown as colour; none: no colour
  std::string label;            ///< words for pointer and screen reader
  std::string kind = {};        ///< "error", "aside" or empty
};

struct HeatTable {
  std::vector<std::string> columns;  ///< the first names the row
  std::vector<std::vector<HeatCell>> rows;
};

}  // namespace contactcheck::report
