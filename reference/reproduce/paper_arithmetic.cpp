#include "reference/reproduce/paper_arithmetic.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace contactcheck::reproduce {
namespace {

// Times are printed to 0.001 ms: each is off by at most half of that. Only what lies beyond the
// rounding of all figures involved is called a contradiction.
constexpr double kRoundingMs = 0.0005;
constexpr int kFiguresOfRow = 5;  // four steps and their total

struct Pair {
  const PaperRow& before;
  const PaperRow& after;
};

Pair pair_of(const PaperTable& table, const std::string& scene) {
  return {table.row(scene, table.before), table.row(scene, table.after)};
}

using RowValue = double (*)(const PaperRow&);
double test_of(const PaperRow& row) { return row.test; }
double total_of(const PaperRow& row) { return row.total; }
double steps_of(const PaperRow& row) { return row.steps(); }

std::vector<double> ratios(const PaperTable& table, RowValue value) {
  std::vector<double> out;
  for (const std::string& scene : table.scenes()) {
    const Pair pair = pair_of(table, scene);
    out.push_back(value(pair.before) / value(pair.after));
  }
  return out;
}

double arithmetic_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

void add_mean(const PaperTable& table, const std::string& topic, const std::string& kind,
              const std::string& what, double mean, std::vector<PaperFinding>& findings) {
  findings.push_back({.topic = topic + "-" + kind + "-mean",
                      .table = table.name,
                      .sentence = fmt::format("{}: over its scenes, the {} mean of the {} of {} "
                                              "over that of {} is {}.",
                                              table.name, kind, what, table.before, table.after,
                                              paper_figure(mean, "ratio")),
                      .computed = mean,
                      .unit = "ratio"});
}

void add_ratios(const PaperTable& table, const std::string& topic, const std::string& what,
                RowValue value, std::vector<PaperFinding>& findings) {
  const std::vector<double> values = ratios(table, value);
  const std::vector<std::string> scenes = table.scenes();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    findings.push_back({.topic = topic,
                        .table = table.name,
                        .scene = scenes[i],
                        .sentence = fmt::format("{}, {}: the {} of {} takes {} times that of {}.",
                                                table.name, scenes[i], what, table.before,
                                                paper_figure(values[i], "ratio"), table.after),
                        .computed = values[i],
                        .unit = "ratio"});
  }
  add_mean(table, topic, "geometric", what, geometric_mean(values), findings);
  add_mean(table, topic, "arithmetic", what, arithmetic_mean(values), findings);
}

void add_rests(const PaperTable& table, std::vector<PaperFinding>& findings) {
  std::size_t below = 0;
  std::string which;
  for (const PaperRow& row : table.rows) {
    const double rest = row.total - row.steps();
    // A total may hold more than the four steps (drawing, say), never less.
    const bool possible = rest >= -kFiguresOfRow * kRoundingMs;
    const std::string verdict =
        possible ? "leaves " + paper_figure(std::fabs(rest), "ms") + " ms to what is not listed"
                 : "is " + paper_figure(-rest, "ms") + " ms smaller than that sum";
    findings.push_back(
        {.topic = "rest",
         .table = table.name,
         .scene = row.scene,
         .method = row.method,
         .sentence = fmt::format("{}, {}, {}: the four steps add up to {} ms, and the total of {} "
                                 "ms {}.",
                                 table.name, row.scene, row.method, paper_figure(row.steps(), "ms"),
                                 paper_figure(row.total, "ms"), verdict),
         .computed = rest,
         .unit = "ms",
         .agrees = possible});
    if (possible) continue;
    ++below;
    which += (which.empty() ? ": " : ", ") + row.scene + " with " + row.method;
  }
  findings.push_back(
      {.topic = "totals-below-parts",
       .table = table.name,
       .sentence = fmt::format("{}: {} of {} totals are smaller than the sum of their own parts{}.",
                               table.name, below, table.rows.size(), which),
       .computed = static_cast<double>(below),
       .unit = "count",
       .agrees = below == 0});
}

void add_gain(const PaperTables& tables, const std::string& topic, const std::string& what,
              RowValue value, std::vector<PaperFinding>& findings) {
  const PaperTable& table = tables.table_3;
  const PaperClaim& claim = tables.claims.frame_rate_gain;
  const double gain = 100.0 * (arithmetic_mean(ratios(table, value)) - 1.0);
  findings.push_back(
      {.topic = topic,
       .table = table.name,
       .sentence = fmt::format("{} on {}: by the {}, {} gives {} % more frames per second than {} "
                               "on average over {} scenes; the text says {}.",
                               table.name, table.device, what, table.after, paper_figure(gain, "%"),
                               table.before, table.scenes().size(), claim.says),
       .claimed = claim.value,
       .computed = gain,
       .unit = "%",
       .agrees = claim.holds(gain)});
}

// Leaving the collision test out altogether bounds what any faster test can gain.
void add_gain_limit(const PaperTable& table, const std::string& scene,
                    std::vector<PaperFinding>& findings) {
  const Pair pair = pair_of(table, scene);
  const double without_test = pair.before.total - pair.before.test;
  const double limit = pair.before.total / without_test;
  const double reported = pair.before.total / pair.after.total;
  const bool possible =
      pair.after.total >= without_test - 3 * kRoundingMs;  // three figures compared
  findings.push_back(
      {.topic = "gain-limit",
       .table = table.name,
       .scene = scene,
       .sentence = fmt::format("{}, {}: without any collision test {} would be {} times as fast; "
                               "the totals report {} times{}.",
                               table.name, scene, table.before, paper_figure(limit, "ratio"),
                               paper_figure(reported, "ratio"), possible ? "" : ", beyond that"),
       .claimed = reported,
       .computed = limit,
       .unit = "ratio",
       .agrees = possible});
}

void add_saving(const PaperTable& table, const std::string& scene, const std::string& topic,
                const std::string& what, RowValue value, std::vector<PaperFinding>& findings) {
  const Pair pair = pair_of(table, scene);
  const double saving = value(pair.before) - value(pair.after);
  findings.push_back(
      {.topic = topic,
       .table = table.name,
       .scene = scene,
       .sentence = fmt::format("{}, {}: from {} to {} the {} {} by {} ms.", table.name, scene,
                               table.before, table.after, what, saving < 0.0 ? "rises" : "falls",
                               paper_figure(std::fabs(saving), "ms")),
       .computed = saving,
       .unit = "ms"});
}

}  // namespace

std::string paper_figure(double value, const std::string& unit) {
  const int decimals = unit == "ratio" || unit == "ms" ? 3
                       : unit == "fps"                 ? 2
                       : unit == "%"                   ? 1
                                                       : 0;
  return fmt::format("{:.{}f}", value, decimals);
}

void check_times(const PaperTables& tables, std::vector<PaperFinding>& findings) {
  for (const PaperTable* table : tables.time_tables()) {
    add_ratios(*table, "test-ratio", "collision test", test_of, findings);
    add_ratios(*table, "total-ratio", "total", total_of, findings);
    add_rests(*table, findings);
  }
  add_gain(tables, "frame-rate-gain-by-totals", "totals", total_of, findings);
  add_gain(tables, "frame-rate-gain-by-parts", "sums of the four steps", steps_of, findings);
  for (const std::string& scene : tables.table_3.scenes()) {
    add_gain_limit(tables.table_3, scene, findings);
    add_saving(tables.table_3, scene, "test-saving", "collision test", test_of, findings);
    add_saving(tables.table_3, scene, "total-saving", "total", total_of, findings);
  }
}

std::vector<PaperFinding> check_paper(const PaperTables& tables) {
  std::vector<PaperFinding> findings;
  check_times(tables, findings);
  check_claims(tables, findings);
  return findings;
}

}  // namespace contactcheck::reproduce
