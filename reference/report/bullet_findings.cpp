#include "reference/report/bullet_findings.h"

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {
using results::LevelCounts;
using results::Run;

std::string count_at(const Run& run, Level level, std::uint64_t LevelCounts::*count) {
  const LevelCounts* counts = counts_of(run, level);
  return counts == nullptr ? "-" : format_count(counts->*count);
}

std::string recall_at(const Run& run, Level level) {
  const LevelCounts* counts = counts_of(run, level);
  return counts == nullptr ? "-" : format_rate(counts->recall);
}

std::string scale_finding(const results::Results& results) {
  std::string rows;
  for (const results::Scene& scene : results.scenes) {
    const Run *scaled = find_run(results, scene.id, "bullet-vf"),
              *plain = find_run(results, scene.id, "bullet-vf:scale=1");
    if (scaled == nullptr || plain == nullptr || scene.contact_frames == 0) continue;
    rows += table_line({scene.id, format_number(scaled->semantics.scale),
                        recall_at(*scaled, Level::kBody), recall_at(*scaled, Level::kNear),
                        recall_at(*plain, Level::kBody), recall_at(*plain, Level::kNear)});
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

std::string inside_finding(const results::Results& results) {
  std::string rows;
  for (const results::Scene& scene : results.scenes) {
    const Run* run = find_run(results, scene.id, "bullet-vf");
    const LevelCounts* counts = run == nullptr ? nullptr : counts_of(*run, Level::kVertex);
    if (counts == nullptr || scene.contact_frames == 0) continue;
    rows += table_line({scene.id, format_millimetres(run->semantics.margin),
                        format_count(counts->truth), format_count(counts->hit),
                        format_count(counts->spurious)});
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
std::string turned_normals(const results::ErrorSpread& normals) {
  if (normals.histogram.empty()) return "-";
  std::uint64_t turned = 0;
  for (const results::HistogramBin& bin : normals.histogram)
    if (bin.from >= 90.0) turned += bin.count;
  return std::to_string(turned);
}

std::string normal_finding(const results::Results& results) {
  std::string rows;
  for (const results::Scene& scene : results.scenes) {
    const Run* run = find_run(results, scene.id, "bullet-vf");
    if (run == nullptr) continue;
    const results::ErrorSpread& normals = run->geometry.normal_deg;
    if (!normals.max || *normals.max < 90.0) continue;
    rows += table_line({scene.id, normals.judged > 0 ? format_count(normals.judged) : "-",
                        turned_normals(normals), format_number(normals.mean),
                        format_number(normals.max)});
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

std::string cluster_finding(const results::Results& results) {
  std::string rows;
  for (const results::Scene& scene : results.scenes) {
    for (const char* detector : {"bullet-cl", "bullet-cl:k=256"}) {
      const Run* run = find_run(results, scene.id, detector);
      if (run == nullptr) continue;
      rows += table_line({scene.id, detector, count_at(*run, Level::kBody, &LevelCounts::truth),
                          count_at(*run, Level::kBody, &LevelCounts::missed),
                          count_at(*run, Level::kBody, &LevelCounts::spurious)});
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

std::string bullet_findings(const results::Results& results) {
  return scale_finding(results) + inside_finding(results) + normal_finding(results) +
         cluster_finding(results);
}

}  // namespace contactcheck
