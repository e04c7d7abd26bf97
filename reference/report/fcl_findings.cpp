#include "reference/report/fcl_findings.h"

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {
using results::Run;

// Metres. Rounding of doubles parts bodies of a metre by 1e-16 or so; no margin is as small.
constexpr double kRounding = 1e-12;

bool only_rounding_parts(const Run& run) {
  const results::LevelCounts* counts = counts_of(run, Level::kTriangle);
  const std::optional<double> farthest = run.geometry.spurious_distance_max;
  return run.ok() && run.detector.starts_with("fcl-") && counts != nullptr &&
         counts->spurious > 0 && farthest && *farthest < kRounding;
}

std::string rows_of(const results::Results& results, const std::string& scene) {
  std::string rows;
  for (const Run* run : runs_of_scene(results, scene)) {
    if (!only_rounding_parts(*run)) continue;
    const results::LevelCounts& counts = *counts_of(*run, Level::kTriangle);
    rows += table_line({scene, run->detector, format_count(counts.reported),
                        format_count(counts.spurious),
                        format_millimetres(run->geometry.spurious_distance_max)});
  }
  return rows;
}

}  // namespace

std::string fcl_findings(const results::Results& results) {
  std::string rows;
  for (const results::Scene& scene : results.scenes)
    if (!scene.family) rows += rows_of(results, scene.id);
  return titled_table(
      "### FCL takes gaps below rounding for contact\n\n"
      "It tries the separating axes of two triangles in plain double, without a bound on the error "
      "(a known defect of FCL 0.7, its issue 502). Pairs that are apart by less than the rounding "
      "of that test may be reported: neighbours of a corner, an edge or a plane where bodies just "
      "touch. Every spurious pair of the rows below is closer than 1e-12 metres (rounding, unless "
      "bodies themselves are as small); the oracle, which is exact, says that it does not touch.",
      {{"scene", true, ""},
       {"detector", true, ""},
       {"reported", false, ""},
       {"spurious", false, ""},
       {"farthest apart, mm", false, ""}},
      rows);
}

}  // namespace contactcheck
