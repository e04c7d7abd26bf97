#include "reference/report/tables/between_frames.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scene_choice.h"
#include "reference/report/tables/section.h"
#include "reference/results/references.h"

namespace contactcheck::report {
namespace {
using results::Run, results::Scene;

std::uint64_t sum(const std::vector<std::uint64_t>& by_step) {
  return std::accumulate(by_step.begin(), by_step.end(), std::uint64_t{0});
}

std::string truth_at(const Scene& scene, Level level) {
  const auto found = scene.truth.find(level);
  const auto* count =
      found == scene.truth.end() ? nullptr : std::get_if<std::uint64_t>(&found->second);
  return count == nullptr ? "-" : grouped_digits(*count);
}

TitledTable scenes_table(const results::Index& index) {
  TitledTable out{
      "Steps of the scenes",
      "Vertices move on straight lines from one frame to the next. Counts are sums over steps.",
      {{"scene", true},
       {"steps", false},
       {"motion", false,
        "largest of a vertex in a step, in mean edges of its body; smallest to "
        "largest over steps"},
       {"bodies", false, "pairs whose surfaces meet within a step"},
       {"starting", false, "of these, in contact at the start of the step"},
       {"passing", false, "of these, in contact at neither end"},
       {"triangles", false, "pairs that meet within a step"},
       {"new", false, "of these, not in contact at the start"},
       {"passing ", false, "of the new ones, not in contact at the end either"},
       {"vertex-face", false, "pairs that meet"},
       {"edge-edge", false, "pairs that meet"},
       {.title = "self vf", .left = false, .meaning = "the same within a body", .spare = 2},
       {.title = "self ee", .left = false, .meaning = "the same within a body", .spare = 1}},
      {}};
  for (const Scene* shown : shown_scenes(index.results())) {
    const Scene& scene = *shown;
    if (!scene.impacts) continue;
    const results::SceneImpacts& impacts = *scene.impacts;
    Range motion;
    for (const double step : impacts.motion) motion.add(step);
    out.rows.push_back(
        {scene.id, std::to_string(impacts.motion.size()), format_range(motion),
         truth_at(scene, Level::kImpact), grouped_digits(sum(impacts.starting)),
         grouped_digits(sum(impacts.passing)), truth_at(scene, Level::kImpactTriangle),
         grouped_digits(impacts.new_triangles), grouped_digits(impacts.passing_triangles),
         truth_at(scene, Level::kImpactVf), truth_at(scene, Level::kImpactEe),
         truth_at(scene, Level::kImpactSelfVf), truth_at(scene, Level::kImpactSelfEe)});
  }
  return out;
}

// "missed / spurious" at a level.
std::string errors_at(const Run& run, Level level) {
  const results::LevelCounts* counts = claimed_counts(run, level);
  if (counts == nullptr) return "-";
  return format_count(counts->missed) + " / " + format_count(counts->spurious);
}

std::string step_ms(const Run& run) {
  const results::QuestionTimes* times = times_in(run, Question::kImpacts);
  return times == nullptr ? "-" : format_number(times->playback.frame);
}

TitledTable detectors_table(const results::Index& index) {
  TitledTable out{
      "Detectors between frames",
      "Errors are missed / spurious. A detector that looks at frames alone has tunnelled pairs "
      "where two bodies meet within a step and it reports them at neither end.",
      {{"scene", true},
       {"detector", true},
       {.title = "bodies", .left = false, .meaning = "level `impact`", .role = Role::kErrors},
       {.title = "triangles",
        .left = false,
        .meaning = "level `impact-triangle`",
        .role = Role::kErrors},
       {.title = "new missed",
        .left = false,
        .meaning = "of pairs of triangles that are not in contact at the start",
        .role = Role::kErrors,
        .spare = 1},
       {.title = "vertex-face",
        .left = false,
        .meaning = "level `impact-vf`",
        .role = Role::kErrors},
       {.title = "edge-edge", .left = false, .meaning = "level `impact-ee`", .role = Role::kErrors},
       {.title = "self vf",
        .left = false,
        .meaning = "level `impact-self-vf`",
        .role = Role::kErrors,
        .spare = 3},
       {.title = "self ee",
        .left = false,
        .meaning = "level `impact-self-ee`",
        .role = Role::kErrors,
        .spare = 2},
       {.title = "tunnelled",
        .left = false,
        .meaning = "pairs of bodies that meet within a step, touch at neither end, and are not "
                   "reported",
        .role = Role::kErrors},
       {.title = "early",
        .left = false,
        .meaning = "most that a reported time is before the first contact, in steps"},
       {.title = "late",
        .left = false,
        .meaning = "most that a reported time is after the first contact, in steps"},
       {.title = "ms/step",
        .left = false,
        .meaning = "map + update + query in playback, question `impacts`",
        .role = Role::kTime}},
      {}};
  for (const char* reference : results::kStepReferences)
    out.columns.push_back(reference_column(
        reference, std::string("time of ") + reference + " / time of this detector, playback"));
  std::set<std::string> shown;
  for (const Scene* scene : shown_scenes(index.results())) shown.insert(scene->id);
  for (const Run& run : index.results().runs) {
    if (!run.impacts || !shown.contains(run.scene)) continue;
    const results::Impacts& impacts = *run.impacts;
    std::vector<std::string> row = {run.scene,
                                    run.detector,
                                    errors_at(run, Level::kImpact),
                                    errors_at(run, Level::kImpactTriangle),
                                    impacts.new_missed ? grouped_digits(*impacts.new_missed) : "-",
                                    errors_at(run, Level::kImpactVf),
                                    errors_at(run, Level::kImpactEe),
                                    errors_at(run, Level::kImpactSelfVf),
                                    errors_at(run, Level::kImpactSelfEe),
                                    grouped_digits(sum(impacts.tunnelled)),
                                    format_number(impacts.early_max),
                                    format_number(impacts.late_max),
                                    step_ms(run)};
    for (const char* reference : results::kStepReferences) {
      const results::Speedup* speedup = speedup_of(run, Question::kImpacts, reference);
      row.push_back(speedup == nullptr ? "-" : format_ratio(speedup->playback));
    }
    out.rows.push_back(std::move(row));
  }
  return out;
}

TitledTable tolerances_table(const results::Index& index) {
  TitledTable out{
      "Reports within the tolerance",
      "Where a detector declares a tolerance, a report of what does not meet is near, not "
      "spurious, if its elements come as near as that within the step.",
      {{"scene", true},
       {"detector", true},
       {"level", true},
       {"near", false, "reports that the tolerance excuses"},
       {"largest mm", false, "the most that one of these is from contact"},
       {"of start", false, "the most as a share of the distance at the start of the step"},
       {"undecided", false, "reports of which the oracle does not say whether they are near"},
       {.title = "spurious",
        .left = false,
        .meaning = "reports beyond the tolerance",
        .role = Role::kErrors}},
      {}};
  for (const Run& run : index.results().runs)
    for (const auto& [level, counts] : run.levels)
      if (counts.within && counts.within->near + counts.within->undecided > 0)
        out.rows.push_back(
            {run.scene, run.detector, name_of(level), grouped_digits(counts.within->near),
             format_millimetres(counts.within->near_max),
             format_number(counts.within->near_of_start_max),
             grouped_digits(counts.within->undecided), grouped_digits(counts.spurious)});
  return out;
}

Blocks between_blocks(const results::Index& index) {
  Blocks out = {scenes_table(index), detectors_table(index), tolerances_table(index)};
  if (tunnelling(index).empty()) return out;
  out.emplace_back(Heading{"What passes unseen"});
  out.emplace_back(
      Paragraph{"Of the pairs of bodies that meet within a step and are apart at its start: the "
                "share that touches at neither end and is not reported, over the largest motion "
                "in the step."});
  out.emplace_back(Picture{kTunnellingFile, "Tunnelled pairs of bodies against motion in a step"});
  return out;
}

std::vector<TerminalPart> between_in_terminal(const results::Index& index) {
  return {{"between frames", "", "", detectors_table(index)},
          {"within the tolerance", "", "", tolerances_table(index)}};
}

/// What a half of a decade of motion holds.
struct Bin {
  std::uint64_t meeting = 0;
  std::map<std::string, std::uint64_t> tunnelled;
};

// Twice the decade: 10^0.5 is half a decade above 1.
int half_decade(double motion) { return static_cast<int>(std::floor(2.0 * std::log10(motion))); }

}  // namespace

std::vector<TunnellingLine> tunnelling(const results::Index& index) {
  std::map<int, Bin> bins;
  std::map<std::string, std::size_t> answered;  // scenes
  std::size_t scenes = 0;
  for (const Scene& scene : index.results().scenes) {
    if (!scene.impacts) continue;
    const results::SceneImpacts& impacts = *scene.impacts;
    if (impacts.meeting.size() != impacts.motion.size() || sum(impacts.meeting) == 0) continue;
    ++scenes;
    for (const Run* run : index.runs_of(scene.id))
      if (run->ok() && run->impacts) ++answered[run->detector];
    for (std::size_t k = 0; k < impacts.motion.size(); ++k) {
      if (impacts.meeting[k] == 0) continue;
      Bin& bin = bins[half_decade(impacts.motion[k])];
      bin.meeting += impacts.meeting[k];
      for (const Run* run : index.runs_of(scene.id))
        if (run->ok() && run->impacts && k < run->impacts->tunnelled.size())
          bin.tunnelled[run->detector] += run->impacts->tunnelled[k];
    }
  }
  std::vector<TunnellingLine> lines;
  const auto shares = [](const TunnellingLine& line) {
    return std::accumulate(line.points.begin(), line.points.end(), 0.0,
                           [](double all, const auto& point) { return all + point.share; });
  };
  for (const auto& [detector, in] : answered) {
    if (in != scenes) continue;
    TunnellingLine line{{detector}, {}};
    for (const auto& [half, bin] : bins) {
      const auto found = bin.tunnelled.find(detector);
      const std::uint64_t count = found == bin.tunnelled.end() ? 0 : found->second;
      line.points.push_back({std::pow(10.0, 0.5 * half + 0.25),
                             static_cast<double>(count) / static_cast<double>(bin.meeting)});
    }
    const auto same = std::find_if(lines.begin(), lines.end(), [&](const TunnellingLine& other) {
      return std::ranges::equal(other.points, line.points, {}, &TunnellingPoint::share,
                                &TunnellingPoint::share);
    });
    if (same == lines.end())
      lines.push_back(std::move(line));
    else
      same->detectors.push_back(detector);
  }
  std::ranges::stable_sort(lines, std::greater<>(), shares);
  if (lines.empty() || shares(lines.front()) == 0.0) lines.clear();
  return lines;
}

/// Contact within the steps from frame to frame: what is true, and what detectors say of it.
extern const Section kBetweenFrames = {"between", "Between frames", "Between frames",
                                       between_blocks, between_in_terminal};

}  // namespace contactcheck::report
