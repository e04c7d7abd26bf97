#include "reference/report/tables/stage_losses.h"

#include <fmt/format.h>

#include <algorithm>

#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"

namespace contactcheck::report {
namespace {
using results::Run;

constexpr std::size_t kNamesWithoutLoss = 24;

void add_stage(std::vector<results::Stage>& stages, const results::Stage& stage) {
  const auto own = std::find_if(stages.begin(), stages.end(), [&](const results::Stage& s) {
    return s.name == stage.name && s.unit == stage.unit && s.visited_unit == stage.visited_unit;
  });
  if (own == stages.end()) {
    stages.push_back(stage);
    return;
  }
  own->in += stage.in;
  own->out += stage.out;
  own->missed += stage.missed;
  if (stage.visited) own->visited = own->visited.value_or(0) + *stage.visited;
}

}  // namespace

std::vector<StageLoss> DetectorLosses::losses() const {
  std::vector<StageLoss> all;
  for (const results::Stage& stage : stages) {
    auto loss = std::find_if(all.begin(), all.end(),
                             [&](const StageLoss& own) { return own.stage == stage.name; });
    if (loss == all.end()) loss = all.insert(all.end(), StageLoss{stage.name});
    loss->missed += stage.missed;
  }
  std::erase_if(all, [](const StageLoss& loss) { return loss.missed == 0; });
  if (truth > 0)
    for (StageLoss& loss : all)
      loss.share = static_cast<double>(loss.missed) / static_cast<double>(truth);
  return all;
}

std::optional<std::uint64_t> true_triangle_pairs(const Run& run) {
  const std::optional<Level> level = run.per_frame.level;
  if (level != Level::kCell && level != Level::kTriangle) return {};
  const results::LevelCounts* counts = counts_of(run, level);
  return counts == nullptr ? 0 : counts->truth;
}

std::vector<DetectorLosses> stage_losses(const std::vector<const Run*>& runs) {
  std::vector<DetectorLosses> all;
  for (const Run* run : runs) {
    const std::optional<std::uint64_t> truth = true_triangle_pairs(*run);
    if (!truth || run->stages.empty()) continue;
    auto own = std::find_if(all.begin(), all.end(), [&](const DetectorLosses& losses) {
      return losses.detector == run->detector;
    });
    if (own == all.end()) own = all.insert(all.end(), DetectorLosses{run->detector});
    own->truth += *truth;
    for (const results::Stage& stage : run->stages) add_stage(own->stages, stage);
  }
  return all;
}

std::vector<DetectorLosses> stage_losses(const results::Index& index, const SceneChoice& scenes) {
  std::vector<const Run*> runs;
  for (const std::string& detector : index.detectors())
    for (const Run* run : ok_runs(index, detector, scenes)) runs.push_back(run);
  return stage_losses(runs);
}

std::vector<std::string> losing_stages(const std::vector<DetectorLosses>& all) {
  std::vector<std::string> names, losing;
  const auto add = [](std::vector<std::string>& list, const std::string& name) {
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
  };
  for (const DetectorLosses& own : all) {
    for (const results::Stage& stage : own.stages) add(names, stage.name);
    for (const StageLoss& loss : own.losses()) add(losing, loss.stage);
  }
  std::erase_if(names, [&](const std::string& name) {
    return std::find(losing.begin(), losing.end(), name) == losing.end();
  });
  return names;
}

std::vector<std::string> loss_sentences(const std::vector<DetectorLosses>& all, std::size_t most) {
  std::vector<std::string> out;
  for (const DetectorLosses& own : all) {
    std::vector<std::string> parts;
    std::uint64_t sum = 0;
    for (const StageLoss& loss : own.losses()) {
      parts.push_back(grouped_digits(loss.missed) + " in " + loss.stage);
      sum += loss.missed;
    }
    if (sum > 0 && out.size() < most)
      out.push_back(
          fmt::format("{} loses {}: {}.", own.detector, grouped_digits(sum), listed(parts)));
  }
  return out;
}

std::string no_loss_sentence(const std::vector<DetectorLosses>& all) {
  if (all.empty()) return "No detector with stages was judged by pairs of triangles here.";
  std::vector<std::string> names;
  for (const DetectorLosses& own : all)
    if (own.losses().empty()) names.push_back(own.detector);
  if (names.size() == all.size()) return "No stage of any detector lost a true contact here.";
  if (names.empty()) return "";
  return "Without a loss in any stage: " + short_list(names, kNamesWithoutLoss) + ".";
}

TitledTable empty_stages_table(const std::string& title) {
  return {title,
          "",
          {{"detector", true, ""},
           {"stage", true, ""},
           {"unit", true, ""},
           {"in", false, "candidates that the stage was given"},
           {"out", false, "those that it kept"},
           {"visited", false, "what it looked at to decide"},
           {"missed", false, "true contacts that none of the kept ones covers"}},
          {}};
}

void add_stages(const std::string& detector, const std::vector<results::Stage>& stages,
                TitledTable& table) {
  for (const results::Stage& s : stages)
    table.rows.push_back({detector, s.name, s.unit, format_count(s.in), format_count(s.out),
                          s.visited ? format_count(*s.visited) + " " + s.visited_unit : "-",
                          format_count(s.missed)});
}

TitledTable stage_losses_table(const std::vector<DetectorLosses>& all) {
  TitledTable out =
      empty_stages_table("What went in and out of every stage, summed over the scenes chosen");
  for (const DetectorLosses& own : all) add_stages(own.detector, own.stages, out);
  return out;
}

}  // namespace contactcheck::report
