#include "reference/report/claims.h"

#include <fmt/format.h>

#include "reference/report/bullet_findings.h"
#include "reference/report/fcl_findings.h"
#include "reference/report/format.h"
#include "reference/report/run_row.h"
#include "reference/results/references.h"

namespace contactcheck {
namespace {
using results::Run;

std::string verdict(std::optional<double> grid, std::optional<double> aabb) {
  if (!grid || !aabb) return "no episode";
  return *grid > *aabb ? "holds" : *grid < *aabb ? "does not hold" : "equal";
}

std::string hover_claim(const results::Results& results) {
  std::string rows;
  for (const results::Scene& scene : results.scenes) {
    const Run* grid = find_run(results, scene.id, "ffd-grid");
    const Run* aabb = find_run(results, scene.id, "ffd-aabb");
    if (grid == nullptr || aabb == nullptr || scene.contact_frames == 0) continue;
    const std::optional<double> g = grid->geometry.hover_gap_max, a = aabb->geometry.hover_gap_max;
    rows += fmt::format("| {} | {} | {} | {} |\n", scene.id, format_millimetres(g),
                        format_millimetres(a), verdict(g, a));
  }
  if (rows.empty()) return "";
  return "### Hover: is traditional FFD less tight than FFD-AABB?\n\n"
         "Largest true distance at the moment a detector first reports contact, touching scenes "
         "only.\n\n"
         "| scene | ffd-grid, mm | ffd-aabb, mm | the paper's claim |\n|---|--:|--:|---|\n" +
         rows + "\n";
}

std::string errors_at(const Run* run, Level level) {
  const results::LevelCounts* c = run == nullptr ? nullptr : counts_of(*run, level);
  if (c == nullptr) return "-";
  return format_rate(c->recall) + " / " + format_error_rate(c->spurious_rate);
}

std::string speed_rows(const results::Results& results, const char* detector, Question question,
                       Level level) {
  std::string rows;
  for (const results::Scene& scene : results.scenes) {
    const Run* run = find_run(results, scene.id, detector);
    if (run == nullptr) continue;
    std::string line = fmt::format("| {} | {} |", scene.id, errors_at(run, level));
    for (const char* reference : kReferences) {
      const results::Speedup* s = speedup_of(*run, question, reference);
      const Run* peer = find_run(results, scene.id, reference);
      line += fmt::format(" {} | {} |", errors_at(peer, level),
                          s == nullptr ? "-" : format_ratio(s->cold, true));
    }
    rows += line + "\n";
  }
  return rows;
}

std::string speed_claim(const results::Results& results, const char* detector, Question question,
                        Level level) {
  const std::string rows = speed_rows(results, detector, question, level);
  if (rows.empty()) return "";
  return fmt::format(
             "### {} against FCL and Embree, question `{}`\n\n"
             "Errors are recall / spurious rate at level `{}`; a speed-up is the reference's time "
             "divided by this detector's, cold, with its 95 % interval.\n\n"
             "| scene | errors | errors of fcl-aabb | speed-up | errors of fcl-obbrss | speed-up | "
             "errors of embree | speed-up |\n|---|--:|--:|--:|--:|--:|--:|--:|\n",
             detector, name_of(question), name_of(level)) +
         rows + "\n";
}

}  // namespace

std::string claims_markdown(const results::Results& results) {
  return hover_claim(results) +
         speed_claim(results, "ffd-aabb-sphere2+tri", Question::kTriangles, Level::kTriangle) +
         speed_claim(results, "ffd-aabb-sphere2", Question::kBody, Level::kBody) +
         fcl_findings(results) + bullet_findings(results);
}

}  // namespace contactcheck
