#include "reference/reproduce/reproduction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "reference/report/run_row.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

// The comparisons of the paper: one level against none, two levels against one.
struct Comparison {
  const char *before, *after;
};
constexpr std::array<Comparison, 2> kComparisons = {Comparison{kMethods[0], kMethods[1]},
                                                    Comparison{kMethods[1], kMethods[2]}};

const Json* scene_entry(const Json& results, const std::string& id) {
  for (const Json& scene : results.at("scenes"))
    if (scene.at("id") == id) return &scene;
  return nullptr;
}

Json count(double paper, double ours) {
  return {{"paper", paper}, {"ours", ours}, {"difference_percent", 100.0 * (ours - paper) / paper}};
}

Json counts_of(const PaperScene& paper, const Json& scene) {
  double vertices = 0.0, triangles = 0.0, cells = 0.0;
  for (const Json& body : scene.at("bodies")) {
    vertices += body.at("vertices").get<double>();
    triangles += body.at("triangles").get<double>();
    cells += body.at("cells").get<double>();
  }
  const auto real = [](std::size_t n) { return static_cast<double>(n); };
  return {{"objects", count(real(paper.objects), real(scene.at("bodies").size()))},
          {"vertices", count(real(paper.vertices), vertices)},
          {"triangles", count(real(paper.triangles), triangles)},
          {"cells", count(real(paper.cells), cells)}};
}

Json paper_row(const PaperTable& table, const PaperRow& row) {
  return {{"table", table.name}, {"device", table.device},     {"mss", row.mss},
          {"cell", row.cell},    {"test", row.test},           {"response", row.response},
          {"total", row.total},  {"sum_of_steps", row.steps()}};
}

// Of the newest device that has this row: Table 3 before Table 1.
Json paper_times(const PaperTables& tables, const std::string& scene, const std::string& method) {
  for (const PaperTable* table : {&tables.table_3, &tables.table_1})
    for (const PaperRow& row : table->rows)
      if (row.scene == scene && row.method == method) return paper_row(*table, row);
  return nullptr;
}

// The finest level that the detector claims.
const Json& finest_level(const Json& run) {
  return run.at("levels").at(run.at("per_frame").at("level").get<std::string>());
}

Json our_times(const Json& run) {
  Json out = run.at("step_ms");
  out.erase("test_by_repeat");
  out.erase("total_by_repeat");
  const Json& level = finest_level(run);
  out["level"] = run.at("per_frame").at("level");
  for (const char* key : {"truth", "missed", "spurious", "recall"}) out[key] = level.at(key);
  out["contact_hash"] = run.at("contact_hash");
  return out;
}

bool timed(const Json& run) { return run.contains("step_ms"); }

Json steps_of(const Json& results, const PaperTables& tables, const std::string& paper_scene) {
  Json out = Json::array();
  for (const char* method : kMethods) {
    Json row = {{"method", method}, {"paper_reports", paper_times(tables, paper_scene, method)}};
    for (const MethodReading& reading : kReadings) {
      const Json run =
          find_run(results, scene_of_paper(paper_scene), method + std::string(reading.suffix));
      row[reading.id] = timed(run) ? our_times(run) : Json(nullptr);
    }
    out.push_back(std::move(row));
  }
  return out;
}

// The quotient of the medians, and the range of the quotients of repeats that ran together.
Json ratio_by_repeat(const Json& before, const Json& after, const char* part) {
  const std::string repeats = std::string(part) + "_by_repeat";
  std::vector<double> quotients;
  for (std::size_t r = 0; r < before.at(repeats).size(); ++r)
    quotients.push_back(before.at(repeats)[r].get<double>() / after.at(repeats)[r].get<double>());
  const auto [low, high] = std::minmax_element(quotients.begin(), quotients.end());
  const double ratio = before.at(part).get<double>() / after.at(part).get<double>();
  return {{"ratio", ratio}, {"low", std::min(ratio, *low)}, {"high", std::max(ratio, *high)}};
}

// Pairs of cells that the spheres let through to the hash, over all frames.
Json into_hash(const Json& run) {
  for (const Json& stage : run.at("stages"))
    if (stage.at("name") == "hash") return stage.at("in");
  return nullptr;
}

Json our_ratio(const Json& before, const Json& after) {
  return {{"test", ratio_by_repeat(before.at("step_ms"), after.at("step_ms"), "test")},
          {"total", ratio_by_repeat(before.at("step_ms"), after.at("step_ms"), "total")},
          {"test_share_before", before.at("step_ms").at("test").get<double>() /
                                    before.at("step_ms").at("total").get<double>()},
          {"into_hash_before", into_hash(before)},
          {"into_hash_after", into_hash(after)},
          {"same_contacts", before.at("contact_hash") == after.at("contact_hash")},
          {"missed_before", finest_level(before).at("missed")},
          {"missed_after", finest_level(after).at("missed")}};
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

Json ratios_of(const Json& results, const PaperTables& tables, const std::string& scene) {
  Json out = Json::array();
  for (const Comparison& c : kComparisons) {
    Json row = {
        {"before", c.before}, {"after", c.after}, {"paper_reports", paper_ratio(tables, scene, c)}};
    for (const MethodReading& reading : kReadings) {
      const Json before =
          find_run(results, scene_of_paper(scene), c.before + std::string(reading.suffix));
      const Json after =
          find_run(results, scene_of_paper(scene), c.after + std::string(reading.suffix));
      row[reading.id] = timed(before) && timed(after) ? our_ratio(before, after) : Json(nullptr);
    }
    out.push_back(std::move(row));
  }
  return out;
}

// The paper's proposal, as it is written: how many whole steps fit into the time they simulate.
Json frame_rate_of(const Json& results, const Json& scene, const std::string& paper_scene) {
  const Json run = find_run(results, scene_of_paper(paper_scene), kMethods[2]);
  if (!timed(run) || !scene.contains("simulation")) return nullptr;
  const double step_ms = run.at("step_ms").at("total").get<double>();
  const double simulated_ms = 1e3 * scene.at("simulation").at("step").get<double>();
  return {{"detector", kMethods[2]},
          {"steps_per_second", 1e3 / step_ms},
          {"simulated_over_real_time", simulated_ms / step_ms}};
}

Json closed_loops_of(const Json& results, const std::string& scene) {
  Json out = Json::array();
  for (const Json& run : results.at("runs")) {
    if (run.at("scene") != scene_of_paper(scene) || !run.contains("closed_loop")) continue;
    Json row = {{"detector", run.at("detector")}};
    row.update(run.at("closed_loop"));
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

Json one_scene(const Json& results, const PaperTables& tables, const PaperScene& paper) {
  const Json& scene = *scene_entry(results, scene_of_paper(paper.id));
  Json ratios = ratios_of(results, tables, paper.id);
  Json loops = closed_loops_of(results, paper.id);
  Json hover = hover_of(loops);
  Json sentences = sentences_of(ratios);
  return {{"scene", paper.id},
          {"ours", scene_of_paper(paper.id)},
          {"frames", scene.at("frames")},
          {"contact_frames", scene.at("contact_frames")},
          {"truth", scene.at("truth")},
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

Json reproduce(const Json& results, const PaperTables& tables) {
  Json scenes = Json::array();
  for (const PaperScene& paper : tables.scenes)
    if (scene_entry(results, scene_of_paper(paper.id)) != nullptr)
      scenes.push_back(one_scene(results, tables, paper));
  Json means = means_of(scenes, tables);
  return {{"schema", "contactcheck-reproduction/1"},
          {"version", results.at("version")},
          {"command", results.at("command")},
          {"machine", results.at("machine")},
          {"scenes", std::move(scenes)},
          {"means", std::move(means)}};
}

}  // namespace contactcheck
