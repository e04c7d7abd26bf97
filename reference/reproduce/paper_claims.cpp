// The paper's text against its tables.
#include <fmt/format.h>

#include <algorithm>

#include "reference/reproduce/paper_arithmetic.h"

namespace contactcheck::reproduce {
namespace {

constexpr double kMsPerSecond = 1000.0;

// A closed surface without handles has V - E + F = 2; its 3F = 2E make that V - F/2 = 2.
constexpr double kEulerOfSphere = 2.0;

double frame_rate_of(const PaperRow& row) { return kMsPerSecond / row.total; }
double percent(double part, double whole) { return 100.0 * part / whole; }

void add_frame_rates(const PaperTable& table, std::vector<PaperFinding>& findings) {
  for (const std::string& scene : table.scenes()) {
    const double rate = frame_rate_of(table.row(scene, table.after));
    findings.push_back({.topic = "frame-rate",
                        .table = table.name,
                        .scene = scene,
                        .method = table.after,
                        .sentence = fmt::format("{}, {}, {}: the total makes {} fps.", table.name,
                                                scene, table.after, paper_figure(rate, "fps")),
                        .computed = rate,
                        .unit = "fps"});
  }
}

const PaperDevice& device_of(const PaperTables& tables, const PaperTable& table) {
  return *std::find_if(tables.devices.begin(), tables.devices.end(),
                       [&](const PaperDevice& device) { return device.name == table.device; });
}

void add_average_frame_rate(const PaperTables& tables, std::vector<PaperFinding>& findings) {
  const PaperTable& table = tables.table_3;
  const PaperClaim& claim = device_of(tables, table).average_frame_rate;
  const std::vector<std::string> scenes = table.scenes();
  double sum = 0.0;
  for (const std::string& scene : scenes) sum += frame_rate_of(table.row(scene, table.after));
  const double average = sum / static_cast<double>(scenes.size());
  findings.push_back(
      {.topic = "average-frame-rate",
       .table = table.name,
       .method = table.after,
       .sentence = fmt::format("{}: {} averages {} fps over {} scenes on {}; the text says {}.",
                               table.name, table.after, paper_figure(average, "fps"), scenes.size(),
                               table.device, claim.says),
       .claimed = claim.value,
       .computed = average,
       .unit = "fps",
       .agrees = claim.holds(average)});
}

void add_best_frame_rate(const PaperTables& tables, std::vector<PaperFinding>& findings) {
  const PaperTable& table = tables.table_3;
  const PaperClaims& claims = tables.claims;
  const PaperRow& best =
      *std::min_element(table.rows.begin(), table.rows.end(),
                        [](const PaperRow& a, const PaperRow& b) { return a.total < b.total; });
  const double rate = frame_rate_of(best);
  const bool same_place = best.scene == claims.best_scene && table.device == claims.best_device;
  findings.push_back(
      {.topic = "best-frame-rate",
       .table = table.name,
       .scene = best.scene,
       .method = best.method,
       .sentence =
           fmt::format("{}: the fastest total is that of {} with {} on {}, {} fps; the "
                       "text says {} for {} on {}.",
                       table.name, best.scene, best.method, table.device, paper_figure(rate, "fps"),
                       claims.best_frame_rate.says, claims.best_scene, claims.best_device),
       .claimed = claims.best_frame_rate.value,
       .computed = rate,
       .unit = "fps",
       .agrees = same_place && claims.best_frame_rate.holds(rate)});
}

PaperFinding share_finding(const PaperTable& table, const PaperRow& row, const PaperClaim& claim,
                           const std::string& what, double share) {
  return {.table = table.name,
          .scene = row.scene,
          .method = row.method,
          .sentence = fmt::format("{}, {}, {}: the {} takes {} % of the total; the text says {}.",
                                  table.name, row.scene, row.method, what, paper_figure(share, "%"),
                                  claim.says),
          .claimed = claim.value,
          .computed = share,
          .unit = "%",
          .agrees = claim.holds(share)};
}

// The text may mean an average: each method's is judged beside the single rows.
void add_mean_test_share(const PaperTable& table, const std::string& method,
                         const PaperClaim& claim, std::vector<PaperFinding>& findings) {
  const std::vector<std::string> scenes = table.scenes();
  double sum = 0.0;
  for (const std::string& scene : scenes) {
    const PaperRow& row = table.row(scene, method);
    sum += percent(row.test, row.total);
  }
  const double mean = sum / static_cast<double>(scenes.size());
  findings.push_back({.topic = "test-share-mean",
                      .table = table.name,
                      .method = method,
                      .sentence = fmt::format(
                          "{}, {}: the collision test takes {} % of the total on average "
                          "over {} scenes; the text says {}.",
                          table.name, method, paper_figure(mean, "%"), scenes.size(), claim.says),
                      .claimed = claim.value,
                      .computed = mean,
                      .unit = "%",
                      .agrees = claim.holds(mean)});
}

void add_test_shares(const PaperTable& table, const PaperClaim& claim,
                     std::vector<PaperFinding>& findings) {
  for (const PaperRow& row : table.rows) {
    findings.push_back(
        share_finding(table, row, claim, "collision test", percent(row.test, row.total)));
    findings.back().topic = "test-share";
  }
  for (const std::string& method : {table.before, table.after})
    add_mean_test_share(table, method, claim, findings);
}

// The paper has one figure for mapping the boxes and the embedded vertices, so the share is an
// upper bound of what the boxes cost.
void add_cell_shares(const PaperTable& table, const PaperClaim& claim,
                     std::vector<PaperFinding>& findings) {
  for (const PaperRow& row : table.rows) {
    findings.push_back(share_finding(table, row, claim, "cell update with the mapping of vertices",
                                     percent(row.cell, row.total)));
    findings.back().topic = "cell-share";
  }
}

void add_one_level_gains(const PaperTable& table, const PaperClaim& claim,
                         std::vector<PaperFinding>& findings) {
  for (const std::string& scene : table.scenes()) {
    const double ratio = table.row(scene, table.before).total / table.row(scene, table.after).total;
    const double gain = 100.0 * (ratio - 1.0);
    findings.push_back(
        {.topic = "one-level-gain",
         .table = table.name,
         .scene = scene,
         .sentence = fmt::format("{}, {}: {} gives {} % more frames per second than {}; the paper "
                                 "that proposed it says {}.",
                                 table.name, scene, table.after, paper_figure(gain, "%"),
                                 table.before, claim.says),
         .claimed = claim.value,
         .computed = gain,
         .unit = "%",
         .agrees = claim.holds(gain)});
  }
}

// How many closed surfaces without handles the counts of a scene make, where the text gives
// another number of objects than Table 2.
void add_objects(const PaperScene& scene, std::vector<PaperFinding>& findings) {
  const double euler =
      static_cast<double>(scene.vertices) - 0.5 * static_cast<double>(scene.triangles);
  const double spheres = euler / kEulerOfSphere;
  const auto text = static_cast<double>(*scene.objects_in_text);
  findings.push_back({.topic = "euler-characteristic",
                      .table = "Table 2",
                      .scene = scene.id,
                      .sentence = fmt::format("Table 2, {}: V - F/2 = {} - {}/2 = {}.", scene.id,
                                              scene.vertices, scene.triangles, euler),
                      .computed = euler,
                      .unit = "count"});
  findings.push_back(
      {.topic = "objects",
       .table = "Table 2",
       .scene = scene.id,
       .sentence = fmt::format("Table 2, {}: the counts are those of {} closed surfaces without "
                               "handles, which have V - F/2 = {} each; the text says {} objects.",
                               scene.id, spheres, kEulerOfSphere, *scene.objects_in_text),
       .claimed = text,
       .computed = spheres,
       .unit = "count",
       .agrees = spheres == text});
}

}  // namespace

void check_claims(const PaperTables& tables, std::vector<PaperFinding>& findings) {
  add_frame_rates(tables.table_3, findings);
  add_average_frame_rate(tables, findings);
  add_best_frame_rate(tables, findings);
  add_test_shares(tables.table_1, tables.claims.test_share, findings);
  add_cell_shares(tables.table_3, tables.claims.cell_share, findings);
  add_one_level_gains(tables.table_1, tables.claims.one_level_gain, findings);
  for (const PaperScene& scene : tables.scenes)
    if (scene.objects_in_text) add_objects(scene, findings);
}

}  // namespace contactcheck::reproduce
