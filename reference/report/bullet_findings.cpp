#include "reference/report/bullet_findings.h"

#include <nlohmann/json.hpp>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

std::string level_field(const Json& run, const char* level, const char* field) {
  if (run.is_null() || !run.at("levels").contains(level)) return "-";
  const Json& value = run.at("levels").at(level).at(field);
  return std::string(field) == "recall" ? format_rate(value) : format_count(value);
}

std::string scale_finding(const Json& results) {
  std::string rows;
  for (const Json& scene : results.at("scenes")) {
    const auto id = scene.at("id").get<std::string>();
    const Json scaled = find_run(results, id, "bullet-vf"),
               plain = find_run(results, id, "bullet-vf:scale=1");
    if (scaled.is_null() || plain.is_null() || whole_number(scene.at("contact_frames")) == 0)
      continue;
    rows +=
        table_line({id, format_number(scaled.at("semantics").at("scale")),
                    level_field(scaled, "body", "recall"), level_field(scaled, "near", "recall"),
                    level_field(plain, "body", "recall"), level_field(plain, "near", "recall")});
  }
  return titled_table(
      "### Bullet's vertex-face query at scale 1: small triangles do not exist\n\n"
      "It skips every triangle whose cross product of two sides, squared, is at most FLT_EPSILON "
      "(1.19e-7) in Bullet's own units: at scale 1 that is every triangle below 1.73e-4 square "
      "metres, without a warning. At the default the scene is scaled by a power of two until its "
      "smallest triangles count.",
      {{"scene", true, ""},
       {"scale", false, ""},
       {"body recall", false, ""},
       {"near recall", false, ""},
       {"body recall at scale 1", false, ""},
       {"near recall at scale 1", false, ""}},
      rows);
}

std::string inside_finding(const Json& results) {
  std::string rows;
  for (const Json& scene : results.at("scenes")) {
    const auto id = scene.at("id").get<std::string>();
    const Json run = find_run(results, id, "bullet-vf");
    if (run.is_null() || !run.at("levels").contains("vertex")) continue;
    if (whole_number(scene.at("contact_frames")) == 0) continue;
    rows += table_line({id, format_millimetres(run.at("semantics").at("margin")),
                        level_field(run, "vertex", "truth"), level_field(run, "vertex", "hit"),
                        level_field(run, "vertex", "spurious")});
  }
  return titled_table(
      "### Bullet's vertex-face query is an unsigned proximity query\n\n"
      "It reports vertices near a surface, on either side. Of the vertices that are truly inside "
      "the other body it names those near its surface alone; that is its specification and no "
      "error, but it is no penetration query.",
      {{"scene", true, ""},
       {"margin mm", false, ""},
       {"vertices inside", false, ""},
       {"of them reported", false, ""},
       {"reported, not inside", false, ""}},
      rows);
}

std::string cluster_finding(const Json& results) {
  std::string rows;
  for (const Json& scene : results.at("scenes")) {
    const auto id = scene.at("id").get<std::string>();
    for (const char* detector : {"bullet-cl", "bullet-cl:k=256"}) {
      const Json run = find_run(results, id, detector);
      if (run.is_null()) continue;
      rows +=
          table_line({id, detector, level_field(run, "body", "truth"),
                      level_field(run, "body", "missed"), level_field(run, "body", "spurious")});
    }
  }
  return titled_table(
      "### Bullet's clusters touch where the surfaces do not\n\n"
      "A cluster is the convex hull of a group of vertices, so it fills what is concave between "
      "them: false contact between shells and near concave parts.",
      {{"scene", true, ""},
       {"detector", true, ""},
       {"true body contacts", false, ""},
       {"missed", false, ""},
       {"spurious", false, ""}},
      rows);
}

}  // namespace

std::string bullet_findings(const Json& results) {
  return scale_finding(results) + inside_finding(results) + cluster_finding(results);
}

}  // namespace contactcheck
