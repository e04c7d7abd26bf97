#include "reference/report/fcl_findings.h"

#include <nlohmann/json.hpp>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

// Metres. Rounding of doubles parts bodies of a metre by 1e-16 or so; no margin is as small.
constexpr double kRounding = 1e-12;

bool only_rounding_parts(const Json& run) {
  if (run.at("status") != "ok" || !run.at("detector").get<std::string>().starts_with("fcl-"))
    return false;
  if (!run.at("levels").contains("triangle")) return false;
  if (whole_number(run.at("levels").at("triangle").at("spurious")) == 0) return false;
  const Json farthest = run.at("geometry").value("spurious_distance_max", Json(nullptr));
  return farthest.is_number() && farthest.get<double>() < kRounding;
}

std::string rows_of(const Json& results, const std::string& scene) {
  std::string rows;
  for (const Json& run : results.at("runs")) {
    if (run.at("scene") != scene || !only_rounding_parts(run)) continue;
    const Json& counts = run.at("levels").at("triangle");
    rows += table_line({scene, run.at("detector").get<std::string>(),
                        format_count(counts.at("reported")), format_count(counts.at("spurious")),
                        format_millimetres(run.at("geometry").at("spurious_distance_max"))});
  }
  return rows;
}

}  // namespace

std::string fcl_findings(const Json& results) {
  std::string rows;
  for (const Json& scene : results.at("scenes"))
    if (!scene.contains("family")) rows += rows_of(results, scene.at("id").get<std::string>());
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
