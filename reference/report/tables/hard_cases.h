// What families of hard cases say about each detector: how many it gets right, and from which value
// of the parameter on it goes wrong.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reference/report/tables/heat_table.h"
#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// A row per detector: families and cases, how many of them it answered as it claims, missed and
/// spurious, errors, refusals, and what a case costs. A family that it refused or failed in has no
/// case right. None without families.
TitledTable hard_sums(const results::Index& index);

/// How many cases each detector gets wrong, by family; only those that go wrong somewhere. No rows
/// when nobody does.
HeatTable hard_matrix(const results::Index& index);

/// What a line of a table tells can be looked at in this case.
struct ShownCase {
  std::string detector;
  std::size_t frame;
  std::string kind;  ///< "missed" or "spurious"; empty without an answer
};

/// A family that somebody goes wrong in. Refers to results that must outlive it.
struct WrongFamily {
  const results::Scene& scene;
  std::string aside;                            ///< how many go wrong
  std::string sentence;                         ///< what the family is
  TitledTable table;                            ///< who goes wrong, from which value on
  std::vector<std::optional<ShownCase>> shown;  ///< per row of it, where it goes wrong first
};
std::vector<WrongFamily> wrong_families(const results::Index& index);

}  // namespace contactcheck::report
