// A detector's answers to one family of hard cases, from results.json.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::report {

/// Refers to results that must outlive it. The schema does not fix the lengths of their lists, so
/// access to a missing case throws InputError.
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
  /// The parameter's value in that case.
  const std::string& value(std::size_t frame) const;
  /// @pre judged()
  std::uint64_t at(Counts counts, std::size_t frame) const;
  bool wrong_at(std::size_t frame) const;
  /// "1 missed, 0 spurious of 6 true". @pre judged()
  std::string errors_text(std::size_t frame) const;
  /// Summed over all cases; 0 if nothing was judged.
  std::uint64_t sum(Counts counts) const;
  std::size_t wrong() const;
  /// True for a wrong case, or an error instead of answers.
  bool goes_wrong() const { return failed() || wrong() > 0; }
  /// The case in which the run ended in an error, if the results name it.
  std::optional<std::size_t> failed_frame() const;
  /// Milliseconds per case in playback, mapping and update included; nothing if not timed.
  std::optional<double> milliseconds() const;
};

/// The path of a family's picture next to report.md: "plots/ID.svg".
std::string stability_plot_file(const results::Scene& scene);

/// In the order of scenes, then of runs.
std::vector<FamilyResult> family_results(const results::Index& index);

}  // namespace contactcheck::report
