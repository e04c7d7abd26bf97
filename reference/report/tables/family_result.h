// A detector's answers to one family of hard cases, as in results.json.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::report {

/// Refers to results that must outlive it. The schema does not say how long their lists are:
/// whatever is of a case that is not there throws InputError.
struct FamilyResult {
  /// truth, missed or spurious.
  using Counts = std::vector<std::uint64_t> results::PerFrame::*;

  const results::Scene& scene;  ///< a family
  const results::Run& run;

  const std::string& detector() const { return run.detector; }
  bool judged() const { return run.ok() && run.per_frame.level; }
  bool failed() const { return run.status == results::Status::kError; }
  bool refused() const { return run.status == results::Status::kRefused; }

  std::size_t cases() const { return scene.family->values.size(); }
  /// Of the parameter, in that case.
  const std::string& value(std::size_t frame) const;
  /// @pre judged()
  std::uint64_t at(Counts counts, std::size_t frame) const;
  bool wrong_at(std::size_t frame) const;
  /// "1 missed, 0 spurious of 6 true". @pre judged()
  std::string errors_text(std::size_t frame) const;
  /// Over all cases; 0 where nothing was judged.
  std::uint64_t sum(Counts counts) const;
  std::size_t wrong() const;
  /// Wrong somewhere, or without an answer because of an error.
  bool goes_wrong() const { return failed() || wrong() > 0; }
  /// The case in which it ended in an error, where that is known.
  std::optional<std::size_t> failed_frame() const;
  /// Milliseconds of a case in playback, mapping and update included; nothing where none was timed.
  std::optional<double> milliseconds() const;
};

/// Where the report expects the picture of a family, beside report.md: "plots/ID.svg".
std::string stability_plot_file(const results::Scene& scene);

/// In the order of scenes, then of runs.
std::vector<FamilyResult> family_results(const results::Index& index);

}  // namespace contactcheck::report
