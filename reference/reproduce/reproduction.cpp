#include "reference/reproduce/reproduction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "reference/results/results_json.h"

namespace contactcheck::reproduce {
namespace {

using Json = nlohmann::ordered_json;
using results::Run;

// The comparisons of the paper: one level against none, two levels against one.
struct Comparison {
  const char *before, *after;
};
constexpr std::array<Comparison, 2> kComparisons = {Comparison{kMethods[0], kMethods[1]},
                                                    Comparison{kMethods[1], kMethods[2]}};

Json count(double paper, double ours) {
  return {{"paper", paper}, {"ours", ours}, {"difference_percent", 100.0 * (ours - paper) / paper}};
}

Json counts_of(const PaperScene& paper, const results::Scene& scene) {
  const auto real = [](std::size_t n) { return static_cast<double>(n); };
  double vertices = 0.0, triangles = 0.0, cells = 0.0;
  for (const results::SceneBody& body : scene.bodies) {
    vertices += real(body.vertices);
    triangles += real(body.triangles);
    cells += real(body.cells);
  }
  return {{"objects", count(real(paper.objects), real(scene.bodies.size()))},
          {"vertices", count(real(paper.vertices), vertices)},
          {"triangles", count(real(paper.triangles), triangles)},
          {"cells", count(real(paper.cells), cells)}};
}

Json paper_row(const PaperTable& table, const PaperRow& row) {
  return {{"table", table.name}, {"device", table.device},     {"mss", row.mss},
          {"cell", row.cell},    {"test", row.test},           {"response", row.response},
          {"total", row.total},  {"sum_of_steps", row.steps()}};
}

// From the newest device that has this row: Table 3 before Table 1.
Json paper_times(const PaperTables& tables, const std::string& scene, const std::string& method) {
  for (const PaperTable* table : {&tables.table_3, &tables.table_1})
    for (const PaperRow& row : table->rows)
      if (row.scene == scene && row.method == method) return paper_row(*table, row);
  return nullptr;
}

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// At the finest level that the detector claims.
const results::LevelCounts& finest_counts(const Run& run) {
  return run.levels.at(run.per_frame.level.value());
}

Json our_times(const Run& run) {
  const results::StepTimes& t = *run.step_ms;
  const results::LevelCounts& counts = finest_counts(run);
  return {{"steps", t.steps},
          {"repeats", t.repeats},
          {"mss", t.mss},
          {"cell", t.cell},
          {"test", t.test},
          {"response", t.response},
          {"total", t.total},
          {"level", name_of(*run.per_frame.level)},
          {"truth", counts.truth},
          {"missed", counts.missed},
          {"spurious", counts.spurious},
          {"recall", or_null(counts.recall)},
          {"contact_hash", run.contact_hash}};
}

// Null where it did not end well, or whole steps were not timed.
const Run* timed_run(const results::Index& results, const std::string& paper_scene,
                     const std::string& detector) {
  const Run* run = results.ok_run(scene_of_paper(paper_scene), detector);
  return run != nullptr && run->step_ms ? run : nullptr;
}

Json steps_of(const results::Index& results, const PaperTables& tables,
              const std::string& paper_scene) {
  Json out = Json::array();
  for (const char* method : kMethods) {
    Json row = {{"method", method}, {"paper_reports", paper_times(tables, paper_scene, method)}};
    for (const MethodReading& reading : kReadings) {
      const Run* run = timed_run(results, paper_scene, method + std::string(reading.suffix));
      row[reading.id] = run != nullptr ? our_times(*run) : Json(nullptr);
    }
    out.push_back(std::move(row));
  }
  return out;
}

// The quotient of the medians, and the range of the quotients of repeats that ran together.
Json ratio_by_repeat(double before, double after, const std::vector<double>& befores,
                     const std::vector<double>& afters) {
  std::vector<double> quotients;
  for (std::size_t r = 0; r < befores.size(); ++r) quotients.push_back(befores[r] / afters.at(r));
  const auto [low, high] = std::minmax_element(quotients.begin(), quotients.end());
  const double ratio = before / after;
  return {{"ratio", ratio}, {"low", std::min(ratio, *low)}, {"high", std::max(ratio, *high)}};
}

// Pairs of cells that the spheres let through to the hash, over all frames.
Json into_hash(const Run& run) {
  for (const results::Stage& stage : run.stages)
    if (stage.name == "hash") return stage.in;
  return nullptr;
}

Json our_ratio(const Run& before, const Run& after) {
  const results::StepTimes &b = *before.step_ms, &a = *after.step_ms;
  return {{"test", ratio_by_repeat(b.test, a.test, b.test_by_repeat, a.test_by_repeat)},
          {"total", ratio_by_repeat(b.total, a.total, b.total_by_repeat, a.total_by_repeat)},
          {"test_share_before", b.test / b.total},
          {"into_hash_before", into_hash(before)},
          {"into_hash_after", into_hash(after)},
          {"same_contacts", before.contact_hash == after.contact_hash},
          {"missed_before", finest_counts(before).missed},
          {"missed_after", finest_counts(after).missed}};
}

Json paper_ratio(const PaperTables& tables, const std::string& scene, const Comparison& c) {
  for (const PaperTable* table : tables.time_tables()) {
    const std::vector<std::string> scenes = table->scenes();
    if (table->before != c.before || table->after != c.after ||
        std::find(scenes.begin(), scenes.end(), scene) == scenes.end())
      continue;
    const PaperRow &before = table->row(scene, c.before), &after = table->row(scene, c.after);
    return {{"table", table->name},
            {"test", before.test / after.test},
            {"total", before.total / after.total},
            {"test_share_before", before.test / before.total}};
  }
  return nullptr;
}

Json ratios_of(const results::Index& results, const PaperTables& tables, const std::string& scene) {
  Json out = Json::array();
  for (const Comparison& c : kComparisons) {
    Json row = {
        {"before", c.before}, {"after", c.after}, {"paper_reports", paper_ratio(tables, scene, c)}};
    for (const MethodReading& reading : kReadings) {
      const Run* before = timed_run(results, scene, c.before + std::string(reading.suffix));
      const Run* after = timed_run(results, scene, c.after + std::string(reading.suffix));
      const bool timed = before != nullptr && after != nullptr;
      row[reading.id] = timed ? our_ratio(*before, *after) : Json(nullptr);
    }
    out.push_back(std::move(row));
  }
  return out;
}

// The paper's proposal, as it is written: how many whole steps fit into the time they simulate.
Json frame_rate_of(const results::Index& results, const results::Scene& scene,
                   const std::string& paper_scene) {
  const Run* run = timed_run(results, paper_scene, kMethods[2]);
  if (run == nullptr || !scene.simulation) return nullptr;
  const double step_ms = run->step_ms->total;
  const double simulated_ms = 1e3 * scene.simulation->step;
  return {{"detector", kMethods[2]},
          {"steps_per_second", 1e3 / step_ms},
          {"simulated_over_real_time", simulated_ms / step_ms}};
}

Json closed_loops_of(const results::Index& results, const std::string& scene) {
  Json out = Json::array();
  for (const Run* run : results.runs_of(scene_of_paper(scene))) {
    if (!run->closed_loop) continue;
    Json row = {{"detector", run->detector}};
    row.update(results::to_json(*run->closed_loop));
    out.push_back(std::move(row));
  }
  return out;
}

// How close the paper's proposal rests, beside the traditional FFD it improves on.
Json hover_of(const Json& closed_loops) {
  Json grid, proposal;
  for (const Json& loop : closed_loops) {
    if (!loop.contains("hover_at_rest_mean")) continue;
    if (loop.at("detector") == kTraditional) grid = loop.at("hover_at_rest_mean");
    if (loop.at("detector") == kMethods[2]) proposal = loop.at("hover_at_rest_mean");
  }
  if (!grid.is_number() || !proposal.is_number()) return nullptr;
  const double far = grid.get<double>(), near = proposal.get<double>();
  return {{kTraditional, far},
          {kMethods[2], near},
          {"factor", near > 0.0 ? Json(far / near) : Json(nullptr)}};
}

double number(const Json& object, const char* key) { return object.at(key).get<double>(); }

std::string test_sentence(const Json& row, const Json& paper, const Json& ours) {
  const double wanted = number(paper, "test"), measured = number(ours.at("test"), "ratio");
  std::string out = fmt::format(
      "The collision test of {} takes {:.2f} times as long as that of {}; {} of the paper says "
      "{:.2f}, ours is {:.0f} % below.",
      row.at("before").get<std::string>(), measured, row.at("after").get<std::string>(),
      paper.at("table").get<std::string>(), wanted, 100.0 * (1.0 - measured / wanted));
  if (ours.at("into_hash_before").is_null() || ours.at("into_hash_after").is_null()) return out;
  const double before = number(ours, "into_hash_before"), after = number(ours, "into_hash_after");
  return out +
         fmt::format(" Its spheres leave {:.1f} % of the pairs of cells that {} takes to the hash.",
                     100.0 * after / std::max(before, 1.0), row.at("before").get<std::string>());
}

std::string step_sentence(const Json& row, const Json& paper, const Json& ours) {
  const double share = number(ours, "test_share_before");
  return fmt::format(
      "A whole step gains {:.3f} and not {:.3f}: the collision test is {:.1f} % of our step with "
      "{} ({:.1f} % in the paper), so that no test, however fast, could gain more than {:.3f}.",
      number(ours.at("total"), "ratio"), number(paper, "total"), 100.0 * share,
      row.at("before").get<std::string>(), 100.0 * number(paper, "test_share_before"),
      1.0 / (1.0 - share));
}

// Where ours falls short of the paper's, by how much, and what was measured that says why.
Json sentences_of(const Json& ratios) {
  Json out = Json::array();
  for (const Json& row : ratios) {
    if (row.at("paper_reports").is_null() || row.at("safe").is_null()) continue;
    const Json &paper = row.at("paper_reports"), &ours = row.at("safe");
    if (number(ours.at("test"), "ratio") < number(paper, "test"))
      out.push_back(test_sentence(row, paper, ours));
    if (number(ours.at("total"), "ratio") < number(paper, "total"))
      out.push_back(step_sentence(row, paper, ours));
  }
  return out;
}

Json one_scene(const results::Index& results, const PaperTables& tables, const PaperScene& paper) {
  const results::Scene& scene = *results.scene(scene_of_paper(paper.id));
  Json ratios = ratios_of(results, tables, paper.id);
  Json loops = closed_loops_of(results, paper.id);
  Json hover = hover_of(loops);
  Json sentences = sentences_of(ratios);
  return {{"scene", paper.id},
          {"ours", scene_of_paper(paper.id)},
          {"frames", scene.frames},
          {"contact_frames", scene.contact_frames},
          {"truth", results::to_json(scene).at("truth")},
          {"counts", counts_of(paper, scene)},
          {"steps", steps_of(results, tables, paper.id)},
          {"ratios", std::move(ratios)},
          {"frame_rate", frame_rate_of(results, scene, paper.id)},
          {"hover_at_rest", std::move(hover)},
          {"closed_loop", std::move(loops)},
          {"sentences", std::move(sentences)}};
}

// Over the scenes: geometric mean of the collision tests, arithmetic mean of the frame rates, as
// the paper's own arithmetic is checked.
Json means_of(const Json& scenes, const PaperTables& tables) {
  double logs = 0.0, sum = 0.0, paper_logs = 0.0, paper_sum = 0.0;
  std::size_t n = 0;
  for (const Json& scene : scenes)
    for (const Json& row : scene.at("ratios")) {
      if (row.at("after") != kMethods[2] || row.at("safe").is_null()) continue;
      logs += std::log(row.at("safe").at("test").at("ratio").get<double>());
      sum += row.at("safe").at("total").at("ratio").get<double>();
      paper_logs += std::log(row.at("paper_reports").at("test").get<double>());
      paper_sum += row.at("paper_reports").at("total").get<double>();
      ++n;
    }
  if (n == 0) return nullptr;
  const double scenes_counted = static_cast<double>(n);
  return {{"scenes", n},
          {"test_ratio",
           {{"paper", std::exp(paper_logs / scenes_counted)},
            {"ours", std::exp(logs / scenes_counted)}}},
          {"frame_rate_ratio",
           {{"paper_claims", tables.claims.frame_rate_gain.value
                                 ? Json(1.0 + 0.01 * *tables.claims.frame_rate_gain.value)
                                 : Json(nullptr)},
            {"paper", paper_sum / scenes_counted},
            {"ours", sum / scenes_counted}}}};
}

}  // namespace

std::string scene_of_paper(const std::string& id) { return "paper-" + id; }

Json reproduce(const results::Results& results, const PaperTables& tables) {
  const results::Index index(results);
  Json scenes = Json::array();
  for (const PaperScene& paper : tables.scenes)
    if (index.scene(scene_of_paper(paper.id)) != nullptr)
      scenes.push_back(one_scene(index, tables, paper));
  Json means = means_of(scenes, tables);
  return {{"schema", "contactcheck-reproduction/1"},
          {"version", results.version},
          {"command", results.command},
          {"machine", results::to_json(results.machine)},
          {"scenes", std::move(scenes)},
          {"means", std::move(means)}};
}

}  // namespace contactcheck::reproduce
