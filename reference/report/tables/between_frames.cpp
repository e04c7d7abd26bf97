#include <algorithm>
#include <numeric>

#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"
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
  for (const Scene& scene : index.results().scenes) {
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
  for (const Run& run : index.results().runs) {
    if (!run.impacts) continue;
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

Blocks between_blocks(const results::Index& index) {
  return {scenes_table(index), detectors_table(index)};
}

std::vector<TerminalPart> between_in_terminal(const results::Index& index) {
  return {{"between frames", "", "", detectors_table(index)}};
}

}  // namespace

/// Contact within the steps from frame to frame: what is true, and what detectors say of it.
extern const Section kBetweenFrames = {"between", "Between frames", "Between frames",
                                       between_blocks, between_in_terminal};

}  // namespace contactcheck::report
