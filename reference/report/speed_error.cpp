#include "reference/report/speed_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/types/semantics.h"
#include "reference/report/run_row.h"

namespace contactcheck {
namespace {
using results::Run;
using Runs = std::vector<const Run*>;

/// Scenes that one chart can be drawn for.
struct Choice {
  std::string words;
  std::vector<std::string> scenes;
};

std::vector<Choice> choices_of(const results::Results& results) {
  std::vector<Choice> choices;
  Choice all{"", {}}, hard{"", {}};
  for (const results::Scene& scene : results.scenes) {
    (scene.family ? hard : all).scenes.push_back(scene.id);
    if (!scene.family) choices.push_back({"scene " + scene.id, {scene.id}});
  }
  all.words = fmt::format("all {} scenes", all.scenes.size());
  hard.words = fmt::format("all {} families of hard cases", hard.scenes.size());
  if (!hard.scenes.empty()) choices.insert(choices.begin(), hard);
  if (all.scenes.size() > 1) choices.insert(choices.begin(), all);
  return choices;
}

/// All runs by scene and detector.
class RunIndex {
 public:
  explicit RunIndex(const results::Results& results) {
    for (const Run& run : results.runs) {
      if (seen_.insert(run.detector).second) detectors_.push_back(run.detector);
      if (run.ok()) ok_[{run.scene, run.detector}] = &run;
    }
  }

  const std::vector<std::string>& detectors() const { return detectors_; }
  /// Those that ended well.
  Runs of(const std::string& detector, const std::vector<std::string>& scenes) const {
    Runs runs;
    for (const std::string& scene : scenes)
      if (const auto it = ok_.find({scene, detector}); it != ok_.end()) runs.push_back(it->second);
    return runs;
  }

 private:
  std::set<std::string> seen_;
  std::vector<std::string> detectors_;
  std::map<std::pair<std::string, std::string>, const Run*> ok_;
};

bool claims(const Run& run, std::optional<Level> level) {
  const results::LevelCounts* counts = counts_of(run, level);
  return counts != nullptr && !counts->informative;
}

// Counts of different levels do not add up: where the finest one is not the same in all scenes that
// were judged, it is the finest that the detector claims in each of them.
std::optional<Level> common_level(const Runs& runs) {
  Runs judged;
  std::set<Level> finest;
  for (const Run* run : runs) {
    if (!claims(*run, run->per_frame.level)) continue;
    judged.push_back(run);
    finest.insert(*run->per_frame.level);
  }
  if (finest.size() == 1) return *finest.begin();
  for (const Level level : kFineToCoarse)
    if (std::all_of(judged.begin(), judged.end(),
                    [&](const Run* run) { return claims(*run, level); }))
      return level;
  return {};
}

/// A point, or why there is none.
struct Attempt {
  std::optional<SpeedErrorPoint> point;
  std::string why;
};

Attempt point_of(const std::string& detector, const Runs& runs, std::size_t scenes) {
  if (runs.size() < scenes)
    return {{}, fmt::format("ended well in {} of {} scenes", runs.size(), scenes)};
  const auto ms = mean_frame_ms(runs, false);
  if (!ms) return {{}, "not timed"};
  SpeedErrorPoint point;
  const std::optional<Level> level = common_level(runs);
  bool judged = false;
  for (const Run* run : runs) judged = point.add(*run, level) || judged;
  const auto error = point.worse_share();
  if (!judged || !error) return {{}, "nothing to judge"};
  point.detector = detector;
  point.question = runs.front()->times.front().question;
  point.level = *level;
  point.ms = *ms;
  point.error = *error;
  return {std::move(point), ""};
}

SpeedError chart_of(const Choice& choice, const RunIndex& index) {
  SpeedError out{choice.words, {}, {}};
  for (const std::string& detector : index.detectors()) {
    Attempt attempt = point_of(detector, index.of(detector, choice.scenes), choice.scenes.size());
    if (attempt.point) {
      out.points.push_back(std::move(*attempt.point));
    } else {
      out.left_out.push_back({detector, attempt.why});
    }
  }
  mark_front(out.points);
  return out;
}

}  // namespace

void mark_front(std::vector<SpeedErrorPoint>& points) {
  std::vector<SpeedErrorPoint*> order;
  for (SpeedErrorPoint& point : points) order.push_back(&point);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return std::pair(a->ms, a->error) < std::pair(b->ms, b->error);
  });
  std::map<Question, double> least;  // error so far, by question
  for (SpeedErrorPoint* point : order) {
    const auto [it, first] = least.try_emplace(point->question, point->error);
    point->on_front = first || point->error < it->second;
    it->second = std::min(it->second, point->error);
  }
}

// A point needs every scene: the first choice that at most half of the detectors fall out of,
// compared with the best.
SpeedError speed_error(const results::Results& results) {
  const RunIndex index(results);
  std::vector<SpeedError> charts;
  for (const Choice& choice : choices_of(results)) charts.push_back(chart_of(choice, index));
  std::size_t best = 0;
  for (const SpeedError& chart : charts) best = std::max(best, chart.points.size());
  for (SpeedError& chart : charts)
    if (2 * chart.points.size() >= best) return std::move(chart);
  return {};
}

}  // namespace contactcheck
