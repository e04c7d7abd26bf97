// Results of each detector in families of hard cases: how many cases it gets right, and from which
// value of the parameter on it is wrong.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reference/report/tables/heat_table.h"
#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// One row per detector: families and cases, cases answered as claimed, missed and spurious,
/// errors, refusals, and the cost of a case. A family that it refused or failed in has no case
/// right. No rows without families.
TitledTable hard_sums(const results::Index& index);

/// The number of wrong cases of each detector by family, for families and detectors with any. No
/// rows if all are right.
HeatTable hard_matrix(const results::Index& index);

/// A case that shows what a line of a table says.
struct ShownCase {
  std::string detector;
  std::size_t frame;
  std::string kind;  ///< "missed" or "spurious"; empty without an answer
};

/// A family with wrong answers. Refers to results that must outlive it.
struct WrongFamily {
  const results::Scene& scene;
  std::string aside;                            ///< how many detectors are wrong
  std::string sentence;                         ///< describes the family
  TitledTable table;                            ///< the wrong detectors, and from which value on
  std::vector<std::optional<ShownCase>> shown;  ///< per row, the first wrong case
};
std::vector<WrongFamily> wrong_families(const results::Index& index);

}  // namespace contactcheck::report
