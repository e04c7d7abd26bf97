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

// Of the normals judged, those that point into the half of directions away from the way out; "-"
// where the results hold no histogram.
std::string turned_normals(const Json& geometry) {
  if (!geometry.contains("normal_error_deg_histogram")) return "-";
  std::int64_t turned = 0;
  for (const Json& bin : geometry.at("normal_error_deg_histogram"))
    if (bin.at("from").get<double>() >= 90.0) turned += whole_number(bin.at("count"));
  return std::to_string(turned);
}

std::string normal_finding(const Json& results) {
  std::string rows;
  for (const Json& scene : results.at("scenes")) {
    const auto id = scene.at("id").get<std::string>();
    const Json run = find_run(results, id, "bullet-vf");
    if (run.is_null()) continue;
    const Json& geometry = run.at("geometry");
    const Json largest = geometry.value("normal_error_deg_max", Json(nullptr));
    if (largest.is_null() || largest.get<double>() < 90.0) continue;
    rows += table_line({id, format_count(geometry.value("normal_judged", Json(nullptr))),
                        turned_normals(geometry),
                        format_number(geometry.value("normal_error_deg_mean", Json(nullptr))),
                        format_number(largest)});
  }
  return titled_table(
      "### Bullet's vertex-face normals turn with the side of the vertex\n\n"
      "Its normal points from the face to the vertex, on whichever side of the face the vertex is. "
      "Normals are judged for vertices that are truly inside the other body: there it points "
      "further in, about 180 degrees off the way out. That is Bullet's own convention and no "
      "rounding, and a solver that follows it pushes such a vertex further in.",
      {{"scene", true, ""},
       {"normals judged", false, ""},
       {"of them 90 degrees off or more", false, ""},
       {"mean, degrees", false, ""},
       {"largest, degrees", false, ""}},
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
  return scale_finding(results) + inside_finding(results) + normal_finding(results) +
         cluster_finding(results);
}

}  // namespace contactcheck
