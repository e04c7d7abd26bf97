#include "reference/report/formats/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <variant>

#include "core/types/check.h"
#include "reference/report/pictures/report_pictures.h"
#include "reference/report/pictures/speed_error_plot.h"
#include "reference/report/tables/between_frames.h"
#include "reference/report/tables/detector_group.h"
#include "reference/report/tables/error_spreads.h"
#include "reference/report/tables/family_result.h"
#include "reference/report/tables/format.h"
#include "reference/report/tables/frame_costs.h"
#include "reference/report/tables/hard_cases.h"
#include "reference/report/tables/headline.h"
#include "reference/report/tables/heat_table.h"
#include "reference/report/tables/level_tables.h"
#include "reference/report/tables/origin.h"
#include "reference/report/tables/random_pairs.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scale_ranges.h"
#include "reference/report/tables/scene_choice.h"
#include "reference/report/tables/scene_tables.h"
#include "reference/report/tables/section.h"
#include "reference/report/tables/speed_error.h"
#include "reference/report/tables/stage_losses.h"
#include "reference/results/references.h"
#include "reference/results/rerun.h"
#include "reference/text/shell_word.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;
using results::Results, results::Run;

constexpr const char* kFinest = "finest";

Json columns_json(const std::vector<Column>& columns) {
  Json out = Json::array();
  for (const Column& column : columns) {
    out.push_back({{"title", column.title}, {"left", column.left}});
    if (!column.meaning.empty()) out.back()["meaning"] = column.meaning;
    if (!column.id.empty()) out.back()["id"] = column.id;
    if (column.role == Role::kVerdict) out.back()["verdict"] = true;
  }
  return out;
}

Json to_json(TitledTable table) {
  leave_out_untimed(table);
  Json out = {{"title", table.title},
              {"text", table.text},
              {"columns", columns_json(table.columns)},
              {"rows", table.rows}};
  if (!table.id.empty()) out["id"] = table.id;
  return out;
}

Json to_json(const std::vector<TitledTable>& tables) {
  Json out = Json::array();
  for (const TitledTable& table : tables) out.push_back(to_json(table));
  return out;
}

/// By file.
using Pictures = std::map<std::string, std::string>;

Json block_json(const Paragraph& paragraph, const Pictures&) { return {{"text", paragraph.text}}; }
Json block_json(const Heading& heading, const Pictures&) { return {{"heading", heading.text}}; }
Json block_json(const Items& items, const Pictures&) { return {{"items", items.texts}}; }
Json block_json(const TitledTable& table, const Pictures&) { return {{"table", to_json(table)}}; }
Json block_json(const Picture& picture, const Pictures& pictures) {
  return {{"picture", pictures.at(picture.file)}, {"what", picture.what}};
}

// Adds a section that the page shows block by block, if it has something to say. `pictures`: those
// of its blocks, by file; the page holds them itself.
void add_section(Json& all, const Section& section, const Blocks& blocks,
                 const Pictures& pictures = {}) {
  Json shown = Json::array();
  for (const Block& block : blocks) {
    const auto* table = std::get_if<TitledTable>(&block);
    if (table != nullptr && table->rows.empty()) continue;
    shown.push_back(std::visit([&](const auto& one) { return block_json(one, pictures); }, block));
  }
  if (!shown.empty())
    all.push_back({{"id", section.id},
                   {"title", section.title},
                   {"short", section.short_title},
                   {"blocks", std::move(shown)}});
}

// A section of the page; report.md shows these tables in the section of their scene.
Blocks pairs_blocks(const results::Results& results) {
  Blocks out;
  for (const results::Scene& scene : results.scenes)
    if (scene.pairs) out.emplace_back(pairs_table(scene));
  if (!out.empty())
    out.insert(
        out.begin(),
        Paragraph{"Pairs of triangles that touch or are apart by rounding, made from a seed. "
                  "The oracle, which judges everything else, is held against rational "
                  "arithmetic on every one of them."});
  return out;
}

Json sections_json(const results::Index& index, const Pictures& pictures) {
  Json out = Json::array();
  for (const Section* section : sections())
    if (section->build != nullptr && !section->drawn_on_page)
      add_section(out, *section, section->build(index), pictures);
  add_section(out, {"pairs", "Random pairs", "Random pairs", nullptr},
              pairs_blocks(index.results()));
  add_section(out, {"machine", "Machine, libraries and command", "Machine", nullptr},
              {Items{machine_lines(index.results())}});
  return out;
}

Json paper_part_json(const PaperPart& paper) {
  Json scenes = Json::array();
  for (const PaperPart::Scene& scene : paper.scenes)
    scenes.push_back({{"title", scene.title},
                      {"aside", scene.aside},
                      {"sentences", scene.sentences},
                      {"tables", to_json(scene.tables)}});
  return {{"overview", to_json(paper.overview)}, {"readings", paper.readings},
          {"means_title", paper.means_title},    {"means", paper.means},
          {"scenes", std::move(scenes)},         {"own_numbers", paper.own_numbers},
          {"checks", to_json(paper.checks)}};
}

Json to_json(const HeatTable& table) {
  Json rows = Json::array();
  for (const std::vector<HeatCell>& row : table.rows) {
    Json& cells = rows.emplace_back(Json::array());
    for (const HeatCell& cell : row) {
      Json& out = cells.emplace_back(Json{{"text", cell.text}});
      if (cell.share) out["share"] = *cell.share;
      if (!cell.label.empty()) out["label"] = cell.label;
      if (!cell.kind.empty()) out["kind"] = cell.kind;
    }
  }
  return {{"columns", table.columns}, {"rows", std::move(rows)}};
}

Json hard_json(const results::Index& index, const TitledTable& sums, const Pictures& pictures) {
  Json families = Json::array();
  for (const WrongFamily& family : wrong_families(index)) {
    Json shown = Json::array();
    for (const std::optional<ShownCase>& one : family.shown) {
      Json& out = shown.emplace_back(nullptr);
      if (!one) continue;
      out = {{"detector", one->detector}, {"frame", one->frame}};
      if (!one->kind.empty()) out["kind"] = one->kind;
    }
    families.push_back({{"id", family.scene.id},
                        {"title", family.scene.title},
                        {"aside", family.aside},
                        {"sentence", family.sentence},
                        {"table", to_json(family.table)},
                        {"shown", std::move(shown)},
                        {"picture", pictures.at(stability_plot_file(family.scene))}});
  }
  return {{"sums", to_json(sums)},
          {"ranges", to_json(range_tables(scale_ranges(index)))},
          {"matrix", to_json(hard_matrix(index))},
          {"families", std::move(families)}};
}

Json levels_json(const results::Index& index, const std::vector<Level>& levels) {
  Json out = Json::array();
  const auto add = [&](const char* name, std::optional<Level> level) {
    const LevelTables tables = level_tables(index, level);
    out.push_back({{"level", name},
                   {"recall", to_json(tables.recall)},
                   {"spurious", to_json(tables.spurious)}});
  };
  add(kFinest, {});
  for (const Level level : levels) add(name_of(level), level);
  return out;
}

struct Measure {
  const char* name;
  ErrorMeasure measure;
};
constexpr Measure kMeasures[] = {{"worse", ErrorMeasure::kWorse},
                                 {"missed", ErrorMeasure::kMissed},
                                 {"spurious", ErrorMeasure::kSpurious}};

// One choice of scenes and one level; null if nothing can be drawn.
Json level_charts(const SpeedErrorCharts& charts, const std::vector<std::string>& detectors,
                  SpeedErrorChoice choice) {
  // Time, error and front of a point differ from chart to chart, its other cells do not.
  Json out = {{"cells", std::vector<Json>(detectors.size())}};
  bool any = false;
  for (const Measure& measure : kMeasures)
    for (const bool cold : {false, true}) {
      choice.measure = measure.measure;
      choice.cold = cold;
      const SpeedError chart = charts.chart(choice);
      Json points = Json::array();
      for (const SpeedErrorPoint& p : chart.points) {
        const auto at = std::find(detectors.begin(), detectors.end(), p.detector);
        const std::size_t place = static_cast<std::size_t>(at - detectors.begin());
        points.push_back(
            {place, p.ms, p.error, p.on_front, speed_error_time(p), format_error_rate(p.error)});
        out["cells"][place] = speed_error_cells(p);
      }
      any = any || !points.empty();
      out[std::string(measure.name) + (cold ? " cold" : " playback")] = {
          {"points", std::move(points)}, {"left_out", left_out_sentence(chart)}};
    }
  return any || !choice.level ? out : Json(nullptr);
}

// None is null.
Json number_json(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

constexpr std::size_t kLossSentences = 12;

Json stages_json(const results::Index& index, const std::vector<SceneChoice>& choices) {
  Json out = Json::array();
  for (const SceneChoice& choice : choices) {
    const std::vector<DetectorLosses> all = stage_losses(index, choice);
    Json bars = Json::array();
    for (const DetectorLosses& own : all)
      for (const StageLoss& loss : own.losses())
        bars.push_back(
            {own.detector, loss.stage, loss.missed, loss.share, format_percent(loss.share)});
    out.push_back({{"bars", std::move(bars)},
                   {"stages", losing_stages(all)},
                   {"sentences", loss_sentences(all, kLossSentences)},
                   {"without_loss", no_loss_sentence(all)},
                   {"table", to_json(stage_losses_table(all))}});
  }
  return out;
}

Json times_json(const results::Index& index, const std::vector<SceneChoice>& choices) {
  Json out = Json::array();
  for (const SceneChoice& choice : choices) {
    Json& times = out.emplace_back(Json::object());
    for (const bool cold : {false, true}) {
      const std::vector<PhaseMeans> all = phase_times(index, choice, cold);
      Json bars = Json::array();
      for (const PhaseMeans& own : all)
        bars.push_back({own.detector, number_json(own.map), own.update, own.query, own.total(),
                        own.without_map()});
      times[cold ? "cold" : "playback"] = {{"bars", std::move(bars)},
                                           {"table", to_json(phase_times_table(all))}};
    }
  }
  return out;
}

Json graded_json(const results::Index& index, const std::vector<SceneChoice>& choices) {
  Json out = Json::array();
  for (const SceneChoice& choice : choices) {
    Json charts = Json::array();
    for (const ErrorChart& chart : error_charts(index, choice)) {
      Json rows = Json::array();
      for (const ErrorRow& row : chart.rows) {
        Json bins = Json::array();
        for (const ErrorBin& bin : row.bins)
          bins.push_back({bin.from, bin.below, bin.count, bin.share, format_percent(bin.share)});
        rows.push_back({row.detector, name_of(row.kind), row.judged, number_json(row.mean),
                        number_json(row.p95), row.max, std::move(bins), row.points});
      }
      charts.push_back({{"title", chart.title},
                        {"axis", chart.axis},
                        {"unit", chart.unit},
                        {"what", chart.what},
                        {"truth", chart.truth},
                        {"rows", std::move(rows)},
                        {"always_zero", chart.always_zero}});
    }
    out.push_back(std::move(charts));
  }
  return out;
}

Json speed_error_json(const results::Index& index, const std::vector<Level>& levels) {
  const SpeedErrorCharts charts(index);
  Json all = Json::array();
  for (std::size_t i = 0; i < charts.scenes().size(); ++i) {
    Json of_scenes = {{kFinest, level_charts(charts, index.detectors(), {.scenes = i})}};
    for (const Level level : levels)
      if (Json of_level = level_charts(charts, index.detectors(), {.scenes = i, .level = level});
          !of_level.is_null())
        of_scenes[name_of(level)] = std::move(of_level);
    all.push_back(std::move(of_scenes));
  }
  Json shapes = Json::array();
  for (const QuestionShape& shape : question_shapes())
    shapes.push_back({{"question", name_of(shape.question)},
                      {"outline", shape.outline},
                      {"means", shape.means}});
  return {{"columns", columns_json(speed_error_columns())},
          {"shapes", std::move(shapes)},
          {"first", charts.first()},
          {"charts", std::move(all)}};
}

Json costs_json(const SceneCosts& costs, const std::vector<std::string>& detectors) {
  Json of_detectors(std::vector<Json>(detectors.size()));
  for (const DetectorCosts& c : costs.detectors) {
    const auto at = std::find(detectors.begin(), detectors.end(), c.detector) - detectors.begin();
    Json& out = of_detectors[static_cast<std::size_t>(at)];
    out = {{"missed", c.missed}, {"spurious", c.spurious}};
    if (!c.playback) continue;
    out.update({{"playback", *c.playback}, {"by_distance", c.by_distance}});
    if (c.cold) out["cold"] = *c.cold;
    Json& frames = out["frame_ms"] = Json::array();
    for (const std::optional<double> ms : c.frame_ms) frames.push_back(number_json(ms));
    if (c.touching)
      out["touching"] = {c.touching->low, c.touching->median, c.touching->high, c.touching->frames};
  }
  return {{"series", costs.series},
          {"triangles", costs.triangles},
          {"truth", costs.truth},
          {"distance", costs.distance},
          {"detectors", std::move(of_detectors)}};
}

Json scene_json(const results::Index& index, const results::Scene& scene) {
  const SceneReport report = scene_report(index, scene);
  Json tables = Json::array(), disagreements = Json::array();
  for (const TitledTable* table : {&report.bodies, &report.fits, &report.pairs, &report.result})
    if (!table->rows.empty()) tables.push_back(to_json(*table));
  for (const TitledTable& table : report.details) tables.push_back(to_json(table));
  for (const results::Disagreement* d : report.disagreements)
    disagreements.push_back({{"detector", d->detector},
                             {"kind", d->kind},
                             {"level", d->level},
                             {"frame", d->frame},
                             {"case", d->case_file}});
  return {{"id", scene.id},
          {"title", scene.title},
          {"frames", scene.frames},
          {"sentence", report.sentence + " " + report.truth},
          {"tables", std::move(tables)},
          {"notes", report.notes},
          {"disagreements", std::move(disagreements)},
          {"cost", costs_json(scene_costs(index, scene), index.detectors())}};
}

// What is known of all runs of a detector from its first that is `ok`.
std::vector<std::string> options_of(const results::Index& index) {
  std::map<std::string, std::string> by_detector;
  for (const Run& run : index.results().runs)
    if (run.ok()) by_detector.emplace(run.detector, options_text(run.options));
  std::vector<std::string> out;
  for (const std::string& detector : index.detectors()) {
    const auto it = by_detector.find(detector);
    out.push_back(it == by_detector.end() ? "-" : it->second);
  }
  return out;
}

}  // namespace

nlohmann::ordered_json page_data(const Results& results, const std::optional<PaperPart>& paper) {
  const results::Index index(results);
  const Headline headline = headline_of(results);
  Json findings = Json::array();
  for (const HeadlineFinding& f : headline.findings)
    findings.push_back({{"topic", f.topic}, {"sentence", f.sentence}});
  const std::vector<Level> levels = judged_levels(results);
  const std::vector<SceneChoice> choices = scene_choices(results);
  Json words = Json::array();
  for (const SceneChoice& choice : choices) words.push_back(choice.words);
  const bool timed = std::any_of(results.runs.begin(), results.runs.end(),
                                 [](const Run& run) { return run.ok() && !run.times.empty(); });
  Json groups = Json::array(), group_names = Json::array();
  for (const std::string& detector : index.detectors()) groups.push_back(group_of(detector));
  for (std::size_t i = 0; i < kDetectorGroups; ++i) group_names.push_back(detector_group(i).name);
  Json reduce = Json::array();
  for (const std::string& detector : index.detectors())
    reduce.push_back(results::detector_words(results, detector));
  const results::Machine& machine = results.machine;
  const Pictures pictures = report_pictures(index);
  Json out = {{"version", results.version},
              {"title", headline.title},
              {"findings", std::move(findings)},
              {"run", fmt::format("`{}` on {}, {} cores, {}.", results.command, machine.cpu,
                                  machine.cores, instruction_set(machine.isa))},
              {"parts", part_sentences(results)},
              {"out", text::in_shell(results::out_folder(results))},
              {"detectors", index.detectors()},
              {"options", options_of(index)},
              {"reduce", std::move(reduce)},
              {"groups", std::move(groups)},
              {"group_names", std::move(group_names)},
              {"timed", timed},
              {"scene_count", results.scenes.size()},
              {"fastest", headline.fastest},
              {"references", results::kReferences},
              {"sections", sections_json(index, pictures)},
              {"levels", levels_json(index, levels)},
              {"result_columns", columns_json(result_columns(results))},
              {"choices", std::move(words)},
              {"stages", stages_json(index, choices)},
              {"times", times_json(index, choices)},
              {"graded", graded_json(index, choices)},
              {"speed_error", speed_error_json(index, levels)}};
  const TitledTable hard = hard_sums(index);
  if (!hard.rows.empty()) out["hard"] = hard_json(index, hard, pictures);
  if (paper) out["paper"] = paper_part_json(*paper);
  // Scenes that are motions are shown in full; of families the 3D view needs to know the cases.
  Json scenes = Json::array(), families = Json::array();
  for (const results::Scene* scene : shown_scenes(results)) {
    if (scene->family)
      families.push_back(
          {{"id", scene->id}, {"title", scene->title}, {"values", scene->family->values}});
    else
      scenes.push_back(scene_json(index, *scene));
  }
  out["scenes"] = std::move(scenes);
  out["families"] = std::move(families);
  return out;
}

}  // namespace contactcheck::report
