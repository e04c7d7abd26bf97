#include <fmt/format.h>

#include <set>

#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scale_ranges.h"
#include "reference/report/tables/scene_choice.h"
#include "reference/report/tables/section.h"
#include "reference/results/references.h"

namespace contactcheck::report {
namespace {

using results::Index, results::LevelCounts, results::Run;

std::string count_at(const Run& run, Level level, std::uint64_t LevelCounts::*count) {
  const LevelCounts* counts = counts_of(run, level);
  return counts == nullptr ? "-" : format_count(counts->*count);
}

std::string recall_at(const Run& run, Level level) {
  const LevelCounts* counts = counts_of(run, level);
  return counts == nullptr ? "-" : format_rate(counts->recall);
}

std::string errors_at(const Run* run, Level level) {
  const LevelCounts* c = run == nullptr ? nullptr : counts_of(*run, level);
  return c == nullptr ? "-" : format_rate(c->recall) + " / " + format_error_rate(c->spurious_rate);
}

std::string hover_verdict(std::optional<double> grid, std::optional<double> aabb) {
  if (!grid || !aabb) return "no episode";
  return *grid > *aabb ? "holds" : *grid < *aabb ? "does not hold" : "equal";
}

TitledTable hover_claim(const Index& index) {
  TitledTable out{
      "Hover: is traditional FFD less tight than FFD-AABB?",
      "Largest true distance at the moment a detector first reports contact, touching scenes "
      "only.",
      {{"scene", true, ""},
       {"ffd-grid, mm", false, ""},
       {"ffd-aabb, mm", false, ""},
       {"the paper's claim", true, ""}},
      {}};
  for (const results::Scene* scene : shown_scenes(index.results())) {
    const Run* grid = index.ok_run(scene->id, "ffd-grid");
    const Run* aabb = index.ok_run(scene->id, "ffd-aabb");
    if (grid == nullptr || aabb == nullptr || scene->contact_frames == 0) continue;
    const std::optional<double> g = grid->geometry.hover_gap_max, a = aabb->geometry.hover_gap_max;
    out.rows.push_back(
        {scene->id, format_millimetres(g), format_millimetres(a), hover_verdict(g, a)});
  }
  return out;
}

TitledTable speed_claim(const Index& index, const char* detector, Question question, Level level) {
  TitledTable out{
      fmt::format("{} against FCL and Embree, question `{}`", detector, name_of(question)),
      fmt::format("Errors are recall / spurious rate at level `{}`{}.", name_of(level),
                  index.results().timing ? "; a speed-up is the reference's time divided by this "
                                           "detector's, in playback"
                                         : ""),
      {{"scene", true, ""}, {"errors", false, ""}},
      {}};
  for (const std::string reference : results::kReferences) {
    out.columns.push_back({"errors of " + reference, false, ""});
    out.columns.push_back(
        {.title = "speed-up over " + reference, .left = false, .role = Role::kTime});
  }
  out.columns.push_back({.title = "passes", .left = false, .role = Role::kOfTimes});
  std::set<std::size_t> all_passes;
  for (const results::Scene* scene : shown_scenes(index.results())) {
    const Run* run = index.ok_run(scene->id, detector);
    if (run == nullptr) continue;
    std::vector<std::string>& row = out.rows.emplace_back();
    row = {scene->id, errors_at(run, level)};
    Range passes;
    for (const char* reference : results::kReferences) {
      const results::Speedup* s = speedup_of(*run, question, reference);
      row.push_back(errors_at(index.ok_run(scene->id, reference), level));
      row.push_back(s == nullptr ? "-" : format_ratio(s->playback, s->passes));
      if (s == nullptr) continue;
      passes.add(static_cast<double>(s->passes));
      all_passes.insert(s->passes);
    }
    row.push_back(format_counts(passes));
  }
  const std::string ends = ends_sentence(all_passes);
  if (!ends.empty()) out.text += " " + ends;
  return out;
}

TitledTable fcl_claim(const Index& index) {
  // Metres. Rounding of doubles separates bodies of a metre by 1e-16 or so; no margin is as small.
  constexpr double kRounding = 1e-12;
  TitledTable out{
      "FCL takes gaps below rounding for contact",
      "It tries the separating axes of two triangles in plain double, without a bound on the "
      "error (a known defect of FCL 0.7, its issue 502). Pairs that are apart by less than "
      "the rounding of that test may be reported: neighbours of a corner, an edge or a plane "
      "where bodies just touch. Every spurious pair of the rows below is closer than 1e-12 "
      "metres (rounding, unless bodies themselves are as small); the oracle, which is exact, "
      "says that it does not touch.",
      {{"scene", true, ""},
       {"detector", true, ""},
       {"reported", false, ""},
       {"spurious", false, ""},
       {"farthest apart, mm", false, ""}},
      {}};
  for (const results::Scene* scene : shown_scenes(index.results())) {
    if (scene->family) continue;
    for (const Run* run : index.runs_of(scene->id)) {
      const LevelCounts* counts = counts_of(*run, Level::kTriangle);
      const std::optional<double> farthest = run->geometry.spurious_distance_max;
      if (run->detector.starts_with("fcl-") && counts != nullptr && counts->spurious > 0 &&
          farthest && *farthest < kRounding)
        out.rows.push_back({scene->id, run->detector, format_count(counts->reported),
                            format_count(counts->spurious), format_millimetres(farthest)});
    }
  }
  return out;
}

TitledTable bullet_scale_claim(const Index& index) {
  TitledTable out{
      "Bullet's vertex-face query at scale 1: small triangles do not exist",
      "It skips every triangle whose cross product of two sides, squared, is at most "
      "FLT_EPSILON (1.19e-7) in Bullet's own units: at scale 1 that is every triangle below "
      "1.73e-4 square metres, without a warning. At the default the scene is scaled by a "
      "power of two until its smallest triangles count.",
      {{"scene", true, ""},
       {"scale", false, ""},
       {"body recall", false, ""},
       {"near recall", false, ""},
       {"body recall at scale 1", false, ""},
       {"near recall at scale 1", false, ""}},
      {}};
  for (const results::Scene* scene : shown_scenes(index.results())) {
    const Run *scaled = index.ok_run(scene->id, "bullet-vf"),
              *plain = index.ok_run(scene->id, "bullet-vf:scale=1");
    if (scaled == nullptr || plain == nullptr || scene->contact_frames == 0) continue;
    out.rows.push_back({scene->id, format_number(scaled->semantics.scale),
                        recall_at(*scaled, Level::kBody), recall_at(*scaled, Level::kNear),
                        recall_at(*plain, Level::kBody), recall_at(*plain, Level::kNear)});
  }
  return out;
}

TitledTable bullet_inside_claim(const Index& index) {
  TitledTable out{
      "Bullet's vertex-face query is an unsigned proximity query",
      "It reports vertices near a surface, on either side. Of the vertices that are truly "
      "inside the other body it names those near its surface alone; that is its "
      "specification and no error, but it is no penetration query.",
      {{"scene", true, ""},
       {"margin mm", false, ""},
       {"vertices inside", false, ""},
       {"of them reported", false, ""},
       {"reported, not inside", false, ""}},
      {}};
  for (const results::Scene* scene : shown_scenes(index.results())) {
    const Run* run = index.ok_run(scene->id, "bullet-vf");
    const LevelCounts* counts = run == nullptr ? nullptr : counts_of(*run, Level::kVertex);
    if (counts == nullptr || scene->contact_frames == 0) continue;
    out.rows.push_back({scene->id, format_millimetres(run->semantics.margin),
                        format_count(counts->truth), format_count(counts->hit),
                        format_count(counts->spurious)});
  }
  return out;
}

// How many of the judged normals are 90 degrees or more off the true normal; "-" where the results
// contain no histogram.
std::string turned_normals(const results::ErrorSpread& normals) {
  if (normals.histogram.empty()) return "-";
  std::uint64_t turned = 0;
  for (const results::HistogramBin& bin : normals.histogram)
    if (bin.from >= 90.0) turned += bin.count;
  return std::to_string(turned);
}

TitledTable bullet_normal_claim(const Index& index) {
  TitledTable out{
      "Bullet's vertex-face normals turn with the side of the vertex",
      "Its normal points from the face to the vertex, on whichever side of the face the "
      "vertex is. Normals are judged for vertices that are truly inside the other body: "
      "there it points further in, about 180 degrees off the way out. That is Bullet's own "
      "convention and no rounding, and a solver that follows it pushes such a vertex further "
      "in.",
      {{"scene", true, ""},
       {"normals judged", false, ""},
       {"of them 90 degrees off or more", false, ""},
       {"mean, degrees", false, ""},
       {"largest, degrees", false, ""}},
      {},
      "turned-normals"};
  for (const results::Scene* scene : shown_scenes(index.results())) {
    const Run* run = index.ok_run(scene->id, "bullet-vf");
    if (run == nullptr) continue;
    const results::ErrorSpread& normals = run->geometry.normal_deg;
    if (!normals.max || *normals.max < 90.0) continue;
    out.rows.push_back({scene->id, normals.judged > 0 ? format_count(normals.judged) : "-",
                        turned_normals(normals), format_number(normals.mean),
                        format_number(normals.max)});
  }
  return out;
}

TitledTable bullet_cluster_claim(const Index& index) {
  TitledTable out{
      "Bullet's clusters touch where the surfaces do not",
      "A cluster is the convex hull of a group of vertices, so it fills what is concave "
      "between them: false contact between shells and near concave parts.",
      {{"scene", true, ""},
       {"detector", true, ""},
       {"true body contacts", false, ""},
       {"missed", false, ""},
       {"spurious", false, ""}},
      {}};
  for (const results::Scene* scene : shown_scenes(index.results()))
    for (const char* detector : {"bullet-cl", "bullet-cl:k=256"})
      if (const Run* run = index.ok_run(scene->id, detector))
        out.rows.push_back({scene->id, detector, count_at(*run, Level::kBody, &LevelCounts::truth),
                            count_at(*run, Level::kBody, &LevelCounts::missed),
                            count_at(*run, Level::kBody, &LevelCounts::spurious)});
  return out;
}

Blocks claims_blocks(const Index& index) {
  return {hover_claim(index),
          speed_claim(index, "ffd-aabb-sphere2+tri", Question::kTriangles, Level::kTriangle),
          speed_claim(index, "ffd-aabb-sphere2", Question::kBody, Level::kBody),
          fcl_claim(index),
          bullet_scale_claim(index),
          bullet_inside_claim(index),
          bullet_normal_claim(index),
          bullet_cluster_claim(index),
          known_ranges_table(index)};
}

}  // namespace

/// What the results say about claims of the paper and of the libraries, scene by scene. Those that
/// they have rows for: the hover gaps of ffd-grid and ffd-aabb side by side (the paper's claim: the
/// first is larger); the speed of sphere2 against FCL and Embree in the questions that both answer,
/// with the errors of both; what FCL takes for contact; what Bullet's queries mean; in which sizes
/// each detector is known to be right.
extern const Section kClaims = {"claims", "What the results say", "Claims tested", claims_blocks};

}  // namespace contactcheck::report
