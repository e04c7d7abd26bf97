#include "reference/report/claims.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reference/report/bullet_findings.h"
#include "reference/report/fcl_findings.h"
#include "reference/report/format.h"
#include "reference/report/run_row.h"
#include "reference/results/references.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

std::string verdict(const Json& grid, const Json& aabb) {
  if (grid.is_null() || aabb.is_null()) return "no episode";
  const double g = grid.get<double>(), a = aabb.get<double>();
  return g > a ? "holds" : g < a ? "does not hold" : "equal";
}

std::string hover_claim(const Json& results) {
  std::string rows;
  for (const Json& scene : results.at("scenes")) {
    const Json grid = find_run(results, scene.at("id").get<std::string>(), "ffd-grid");
    const Json aabb = find_run(results, scene.at("id").get<std::string>(), "ffd-aabb");
    if (grid.is_null() || aabb.is_null()) continue;
    if (whole_number(scene.at("contact_frames")) == 0) continue;
    const Json &g = grid.at("geometry").at("hover_gap_max"),
               &a = aabb.at("geometry").at("hover_gap_max");
    rows += fmt::format("| {} | {} | {} | {} |\n", scene.at("id").get<std::string>(),
                        format_millimetres(g), format_millimetres(a), verdict(g, a));
  }
  if (rows.empty()) return "";
  return "### Hover: is traditional FFD less tight than FFD-AABB?\n\n"
         "Largest true distance at the moment a detector first reports contact, touching scenes "
         "only.\n\n"
         "| scene | ffd-grid, mm | ffd-aabb, mm | the paper's claim |\n|---|--:|--:|---|\n" +
         rows + "\n";
}

std::string errors_at(const Json& run, const char* level) {
  if (run.is_null() || !run.at("levels").contains(level)) return "-";
  const Json& c = run.at("levels").at(level);
  return format_rate(c.at("recall")) + " / " + format_error_rate(c.at("spurious_rate"));
}

std::string speed_rows(const Json& results, const char* detector, const char* question,
                       const char* level) {
  std::string rows;
  for (const Json& scene : results.at("scenes")) {
    const Json run = find_run(results, scene.at("id").get<std::string>(), detector);
    if (run.is_null()) continue;
    std::string line =
        fmt::format("| {} | {} |", scene.at("id").get<std::string>(), errors_at(run, level));
    for (const char* reference : kReferences) {
      const Json s = speedup_of(run, question, reference);
      const Json peer = find_run(results, scene.at("id").get<std::string>(), reference);
      line += fmt::format(" {} | {} |", errors_at(peer, level),
                          s.is_null() ? "-" : format_ratio(s.at("cold"), true));
    }
    rows += line + "\n";
  }
  return rows;
}

std::string speed_claim(const Json& results, const char* detector, const char* question,
                        const char* level) {
  const std::string rows = speed_rows(results, detector, question, level);
  if (rows.empty()) return "";
  return fmt::format(
             "### {} against FCL and Embree, question `{}`\n\n"
             "Errors are recall / spurious rate at level `{}`; a speed-up is the reference's time "
             "divided by this detector's, cold, with its 95 % interval.\n\n"
             "| scene | errors | errors of fcl-aabb | speed-up | errors of fcl-obbrss | speed-up | "
             "errors of embree | speed-up |\n|---|--:|--:|--:|--:|--:|--:|--:|\n",
             detector, question, level) +
         rows + "\n";
}

}  // namespace

std::string claims_markdown(const Json& results) {
  return hover_claim(results) +
         speed_claim(results, "ffd-aabb-sphere2+tri", "triangles", "triangle") +
         speed_claim(results, "ffd-aabb-sphere2", "body", "body") + fcl_findings(results) +
         bullet_findings(results);
}

}  // namespace contactcheck
