#include "reference/report/tables/frame_costs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string_view>

#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"
#include "reference/results/statistics.h"

namespace contactcheck::report {
namespace {

using results::Run;

constexpr int kBins = 16;  // of a logarithm from the smallest to the largest distance

std::vector<std::pair<std::size_t, std::uint64_t>> frames_with(
    const std::vector<std::uint64_t>& counts) {
  std::vector<std::pair<std::size_t, std::uint64_t>> out;
  for (std::size_t f = 0; f < counts.size(); ++f)
    if (counts[f] > 0) out.emplace_back(f, counts[f]);
  return out;
}

std::vector<std::pair<double, double>> medians_by_distance(
    const std::vector<std::pair<double, double>>& frames) {
  if (frames.empty()) return {};
  const auto [nearest, farthest] = std::minmax_element(frames.begin(), frames.end());
  const double low = std::log(nearest->first),
               span = std::max(std::log(farthest->first) - low, 1e-9);
  std::map<int, std::pair<std::vector<double>, std::vector<double>>> bins;
  for (const auto& [distance, ms] : frames) {
    auto& [distances, times] = bins[static_cast<int>(kBins * (std::log(distance) - low) / span)];
    distances.push_back(distance);
    times.push_back(ms);
  }
  std::vector<std::pair<double, double>> out;
  for (auto& [bin, values] : bins)
    out.emplace_back(results::median(std::move(values.first)),
                     results::median(std::move(values.second)));
  return out;
}

DetectorCosts costs_of(const Run& run, const std::vector<double>& distance) {
  DetectorCosts out;
  out.detector = run.detector;
  out.missed = frames_with(run.per_frame.missed);
  out.spurious = frames_with(run.per_frame.spurious);
  if (run.times.empty()) return out;
  out.playback = run.times.front().playback.frame;
  if (const auto& cold = run.times.front().cold) out.cold = cold->frame;
  if (!run.per_frame.frame_ms) return out;
  out.frame_ms = *run.per_frame.frame_ms;
  // A clock that did not tick measured nothing.
  for (std::optional<double>& ms : out.frame_ms)
    if (ms && !(*ms > 0.0)) ms.reset();
  std::vector<std::pair<double, double>> separated;
  std::vector<double> touching;
  for (std::size_t f = 0; f < std::min(distance.size(), out.frame_ms.size()); ++f) {
    if (!out.frame_ms[f]) continue;
    if (distance[f] > 0.0)
      separated.emplace_back(distance[f], *out.frame_ms[f]);
    else
      touching.push_back(*out.frame_ms[f]);
  }
  out.by_distance = medians_by_distance(separated);
  if (!touching.empty()) {
    const auto [low, high] = std::minmax_element(touching.begin(), touching.end());
    out.touching = {*low, results::median(touching), *high, touching.size()};
  }
  return out;
}

}  // namespace

std::vector<PhaseMeans> phase_times(const results::Index& index, const SceneChoice& scenes,
                                    bool cold) {
  std::vector<PhaseMeans> all;
  for (const std::string& detector : index.detectors()) {
    PhaseMeans means;
    means.detector = detector;
    for (const Run* run : ok_runs(index, detector, scenes)) {
      if (run->times.empty()) continue;
      const results::QuestionTimes& times = run->times.front();
      const results::PhaseTimes* phases = phases_of(times, cold);
      if (phases == nullptr) continue;
      if (means.scenes++ == 0) means.question = times.question;
      if (phases->map) means.map = means.map.value_or(0.0) + *phases->map;
      means.update += phases->update;
      means.query += phases->query;
      means.timed.add(*run, times);
    }
    if (means.scenes == 0) continue;
    const auto timed_scenes = static_cast<double>(means.scenes);
    if (means.map) *means.map /= timed_scenes;
    means.update /= timed_scenes;
    means.query /= timed_scenes;
    all.push_back(std::move(means));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const PhaseMeans& a, const PhaseMeans& b) { return a.total() < b.total(); });
  return all;
}

TitledTable phase_times_table(const std::vector<PhaseMeans>& all) {
  TitledTable out{"Milliseconds per frame and phase",
                  "",
                  {{"detector", true, ""},
                   {"question", true, ""},
                   {"scenes", false, ""},
                   {"map", false, ""},
                   {"update", false, ""},
                   {"query", false, ""},
                   {"sum", false, ""},
                   {"passes", false, ""}},
                  {}};
  for (const PhaseMeans& own : all)
    out.rows.push_back({own.detector, name_of(own.question), std::to_string(own.scenes),
                        format_number(own.map), format_number(own.update), format_number(own.query),
                        format_number(own.total()) + own.timed.cut_text(),
                        format_counts(own.timed.passes)});
  return out;
}

SceneCosts scene_costs(const results::Index& index, const results::Scene& scene) {
  SceneCosts out;
  // "contact" of scaling-contact-4 and of contact.
  constexpr std::string_view kScaling = "scaling-";
  out.series = scene.id;
  if (out.series.starts_with(kScaling)) out.series.erase(0, kScaling.size());
  const std::size_t name_end = out.series.find_last_not_of("0123456789");
  const bool has_size = name_end != std::string::npos && name_end + 1 < out.series.size();
  if (has_size && out.series[name_end] == '-') out.series.erase(name_end);
  for (const results::SceneBody& body : scene.bodies) out.triangles += body.triangles;
  for (const double metres : scene.separation) out.distance.push_back(1e3 * metres);
  const auto sum = [](const std::vector<std::uint64_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  };
  for (const Run* run : index.runs_of(scene.id)) {
    if (!run->ok()) continue;
    if (sum(run->per_frame.truth) > sum(out.truth)) out.truth = run->per_frame.truth;
    out.detectors.push_back(costs_of(*run, out.distance));
  }
  return out;
}

}  // namespace contactcheck::report
