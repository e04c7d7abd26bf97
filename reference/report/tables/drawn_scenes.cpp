#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "reference/report/tables/error_counts.h"
#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/section.h"
#include "reference/results/references.h"
#include "reference/results/statistics.h"
#include "reference/text/lists.h"

namespace contactcheck::report {
namespace {

/// With fewer ratios no correlation is given.
constexpr std::size_t kFewestForCorrelation = 10;

using results::Index, results::Run, results::Scene;
using Scenes = std::vector<const Scene*>;

constexpr std::size_t kMostWrongScenes = 5;
constexpr const char* kFastest = "the fastest";

std::string name_in_words(const std::string& parameter) {
  static const std::map<std::string, std::string> words = {{"bodies", "bodies"},
                                                           {"cells", "cells per body"},
                                                           {"contact_share", "contact share"},
                                                           {"deformers", "deformers"},
                                                           {"distance", "distance"},
                                                           {"frames", "frames"},
                                                           {"size_ratio", "size ratio"},
                                                           {"speed", "speed"},
                                                           {"triangles", "triangles per body"}};
  const auto found = words.find(parameter);
  return found == words.end() ? parameter : found->second;
}

// True for what was drawn as steps, judged or not.
bool drawn_as_steps(const Scene& scene) {
  return scene.impacts || scene.id.starts_with("drawn-steps-");
}

// How often each detector is wrong.

using Statuses = std::map<results::Status, std::size_t>;

// "1 error, 2 refused"; "-" where every scene has an answer.
std::string statuses_text(const Statuses& statuses) {
  const std::string out = text::joined(statuses, [](const auto& one) {
    return fmt::format("{} {}", one.second, name_of(one.first));
  });
  return out.empty() ? "-" : out;
}

/// One detector at one level: counts of different levels do not add up.
struct Accuracy {
  std::optional<Level> level;
  std::size_t scenes = 0, wrong = 0;
  ErrorCounts counts;
};

std::vector<std::string> accuracy_cells(const std::string& detector, const Accuracy& own,
                                        const std::string& no_answer) {
  results::LevelCounts rates{own.counts.truth, own.counts.reported,
                             own.counts.truth - own.counts.missed, own.counts.missed,
                             own.counts.spurious};
  rates.set_rates();
  return {detector,
          fmt::format("{}", own.scenes),
          own.level ? name_of(*own.level) : "-",
          fmt::format("{}", own.counts.truth),
          fmt::format("{}", own.counts.missed),
          format_rate(rates.recall),
          fmt::format("{}", own.counts.spurious),
          format_error_rate(rates.spurious_rate),
          fmt::format("{}", own.wrong),
          no_answer};
}

void add_accuracy(const Index& index, const Scenes& scenes, const std::string& detector,
                  TitledTable& table) {
  std::vector<Accuracy> all;
  Statuses statuses;
  for (const Scene* scene : scenes) {
    const Run* run = index.run(scene->id, detector);
    if (run == nullptr || !scene->unjudged.empty()) continue;
    if (!run->ok()) {
      ++statuses[run->status];
      continue;
    }
    const std::optional<Level> level = run->per_frame.level;
    ErrorCounts own;
    if (!own.add(*run, level)) continue;
    auto found = std::ranges::find(all, level, &Accuracy::level);
    if (found == all.end()) found = all.insert(all.end(), Accuracy{level, 0, 0, {}});
    ++found->scenes;
    found->wrong += own.missed > 0 || own.spurious > 0;
    found->counts.add(*run, level);
  }
  std::string no_answer = statuses_text(statuses);
  if (all.empty() && !statuses.empty()) all.emplace_back();
  for (const Accuracy& own : all) {
    table.rows.push_back(accuracy_cells(detector, own, no_answer));
    no_answer = "-";
  }
}

TitledTable accuracy_table(const Index& index, const Scenes& scenes, const std::string& kind) {
  TitledTable out{fmt::format("Missed and spurious in {} {}", plural(scenes.size(), "scene"), kind),
                  "",
                  {{"detector", true, ""},
                   {"scenes", false, "that it answered"},
                   {"level", true, "the finest that the detector claims and that was judged"},
                   {"true contacts", false, ""},
                   {"missed", false, ""},
                   {"recall", false, ""},
                   {"spurious", false, ""},
                   {"spurious rate", false, ""},
                   {"scenes wrong", false, "with missed or spurious contacts"},
                   {"no answer", true, "scenes by status"}},
                  {}};
  for (const std::string& detector : index.detectors()) add_accuracy(index, scenes, detector, out);
  return out;
}

// Between frames.

/// Levels of steps, with the titles of their columns.
constexpr std::pair<Level, const char*> kStepLevels[] = {
    {Level::kImpact, "bodies"},        {Level::kImpactTriangle, "triangles"},
    {Level::kImpactVf, "vertex-face"}, {Level::kImpactEe, "edge-edge"},
    {Level::kImpactSelfVf, "self vf"}, {Level::kImpactSelfEe, "self ee"}};

std::uint64_t true_impacts(const Scene& scene, Level level) {
  const auto found = scene.truth.find(level);
  const auto* count =
      found == scene.truth.end() ? nullptr : std::get_if<std::uint64_t>(&found->second);
  return count == nullptr ? 0 : *count;
}

bool has_impacts(const Scene& scene) {
  return std::ranges::any_of(kStepLevels,
                             [&](const auto& one) { return true_impacts(scene, one.first) > 0; });
}

std::uint64_t tunnelled_in(const Run& run) {
  if (!run.impacts) return 0;
  const std::vector<std::uint64_t>& steps = run.impacts->tunnelled;
  return std::accumulate(steps.begin(), steps.end(), std::uint64_t{0});
}

// Over all levels of steps.
ErrorCounts step_errors(const Run& run) {
  ErrorCounts out;
  for (const auto& [level, title] : kStepLevels) out.add(run, level);
  return out;
}

// The larger of two of which either may be none.
void take_larger(std::optional<double>& most, const std::optional<double>& value) {
  if (value) most = std::max(most.value_or(*value), *value);
}

std::vector<std::string> step_accuracy_row(const Index& index, const Scenes& scenes,
                                           const std::string& detector) {
  std::map<Level, ErrorCounts> levels;
  Statuses statuses;
  std::size_t answered = 0, wrong = 0;
  std::uint64_t tunnelled = 0;
  std::optional<double> early, late;
  for (const Scene* scene : scenes) {
    const Run* run = index.run(scene->id, detector);
    if (run == nullptr) continue;
    if (!run->ok() || !run->impacts) {
      ++statuses[run->status];
      continue;
    }
    ++answered;
    const ErrorCounts all = step_errors(*run);
    wrong += all.missed > 0 || all.spurious > 0;
    for (const auto& [level, title] : kStepLevels)
      if (ErrorCounts own; own.add(*run, level)) levels[level].add(*run, level);
    tunnelled += tunnelled_in(*run);
    take_larger(early, run->impacts->early_max);
    take_larger(late, run->impacts->late_max);
  }
  std::vector<std::string> row = {detector, fmt::format("{}", answered)};
  for (const auto& [level, title] : kStepLevels) {
    const auto found = levels.find(level);
    row.push_back(found == levels.end()
                      ? "-"
                      : fmt::format("{} / {}", found->second.missed, found->second.spurious));
  }
  row.push_back(fmt::format("{}", tunnelled));
  row.push_back(format_number(early));
  row.push_back(format_number(late));
  row.push_back(fmt::format("{}", wrong));
  row.push_back(statuses_text(statuses));
  return row;
}

TitledTable step_accuracy_table(const Index& index, const Scenes& scenes, const std::string& kind) {
  TitledTable out{fmt::format("Missed and spurious in {} {}", plural(scenes.size(), "scene"), kind),
                  "",
                  {{"detector", true, ""}, {"scenes", false, "that it answered"}},
                  {}};
  std::vector<std::string> truth;
  for (const auto& [level, title] : kStepLevels) {
    std::uint64_t sum = 0;
    for (const Scene* scene : scenes) sum += true_impacts(*scene, level);
    truth.push_back(fmt::format("{} {}", sum, title));
    out.columns.push_back(
        {title, false, fmt::format("missed / spurious, level `{}`", name_of(level))});
  }
  out.text = "True pairs: " + text::joined(truth) + ". Errors are missed / spurious.";
  out.columns.push_back(
      {"tunnelled", false,
       "pairs of bodies that meet within a step, touch at neither end, and are not "
       "reported"});
  out.columns.push_back(
      {"early", false, "most that a reported time is before the first contact, in steps"});
  out.columns.push_back(
      {"late", false, "most that a reported time is after the first contact, in steps"});
  out.columns.push_back({"scenes wrong", false, "with missed or spurious contacts"});
  out.columns.push_back({"no answer", true, "scenes by status"});
  for (const std::string& detector : index.detectors())
    if (std::ranges::any_of(
            scenes, [&](const Scene* scene) { return index.run(scene->id, detector) != nullptr; }))
      out.rows.push_back(step_accuracy_row(index, scenes, detector));
  return out;
}

// "2 missed, 1 spurious"; the status of a run that is not `ok`; "" where all is right.
std::string wrong_text(const Scene& scene, const Run& run) {
  if (run.status == results::Status::kError) return name_of(run.status);
  if (!run.ok()) return "";
  ErrorCounts counts;
  if (drawn_as_steps(scene)) {
    counts = step_errors(run);
  } else if (!counts.add(run, run.per_frame.level)) {
    return "";
  }
  std::string out;
  if (counts.missed > 0) out = fmt::format("{} missed", counts.missed);
  if (counts.spurious > 0)
    out += fmt::format("{}{} spurious", out.empty() ? "" : ", ", counts.spurious);
  return out;
}

TitledTable wrong_table(const Index& index, const Scenes& scenes) {
  TitledTable out{
      "Scenes with wrong answers",
      fmt::format("The first {} of each detector; `results.json` names all.", kMostWrongScenes),
      {{"detector", true, ""},
       {"scenes wrong", false, ""},
       {"first", true, ""},
       {"first case", true, "a file that `reduce` takes"}},
      {}};
  std::map<std::pair<std::string, std::string>, std::string> cases;
  for (const results::Disagreement& d : index.results().disagreements)
    cases.emplace(std::pair(d.scene, d.detector), d.case_file);
  for (const std::string& detector : index.detectors()) {
    std::vector<std::string> all;
    std::string first_case;
    for (const Scene* scene : scenes) {
      const Run* run = index.run(scene->id, detector);
      const std::string wrong =
          run == nullptr || !scene->unjudged.empty() ? "" : wrong_text(*scene, *run);
      if (wrong.empty()) continue;
      all.push_back(fmt::format("{} ({})", scene->id, wrong));
      const auto own = cases.find({scene->id, detector});
      if (first_case.empty() && own != cases.end()) first_case = "`" + own->second + "`";
    }
    if (all.empty()) continue;
    std::string first;
    for (std::size_t i = 0; i < std::min(all.size(), kMostWrongScenes); ++i)
      first += (i == 0 ? "" : "; ") + all[i];
    out.rows.push_back(
        {detector, fmt::format("{}", all.size()), first, first_case.empty() ? "-" : first_case});
  }
  return out;
}

// How fast each detector is.

/// A ratio of times in a scene: above 1 the detector is faster.
struct SceneRatio {
  const Scene* scene = nullptr;
  double value = 1.0;
};
using Ratios = std::vector<SceneRatio>;

/// One detector over one reference, in one question.
struct Compared {
  std::string detector, reference;
  Question question = Question::kTriangles;
  Ratios ratios;
};

std::optional<double> playback_ratio(const Run& run, Question question,
                                     const std::string& reference) {
  const results::Speedup* speedup = speedup_of(run, question, reference);
  if (speedup == nullptr || reference == run.detector || !std::isfinite(speedup->playback.value) ||
      !(speedup->playback.value > 0.0))
    return std::nullopt;
  return speedup->playback.value;
}

// Over each reference, and where there are several over the fastest one of each scene. `asked`: of
// all detectors; none: each one's own.
std::vector<Compared> compared(const Index& index, const Scenes& scenes,
                               std::span<const char* const> references,
                               std::optional<Question> asked) {
  std::vector<Compared> out;
  for (const std::string& detector : index.detectors()) {
    std::vector<Compared> own;
    for (const char* reference : references)
      own.push_back({detector, reference, Question::kTriangles, {}});
    own.push_back({detector, kFastest, Question::kTriangles, {}});
    std::optional<Question> question = asked;
    for (const Scene* scene : scenes) {
      const Run* run = index.ok_run(scene->id, detector);
      if (run == nullptr || run->times.empty()) continue;
      if (!question) question = compared_question(*run);
      std::optional<double> least;
      for (std::size_t i = 0; i < references.size(); ++i) {
        const auto ratio = playback_ratio(*run, *question, references[i]);
        if (!ratio) continue;
        own[i].ratios.push_back({scene, *ratio});
        least = std::min(least.value_or(*ratio), *ratio);
      }
      if (least) own.back().ratios.push_back({scene, *least});
    }
    std::erase_if(own, [](const Compared& one) { return one.ratios.empty(); });
    if (own.size() == 2) own.pop_back();  // the fastest of one
    for (Compared& one : own) {
      one.question = *question;
      out.push_back(std::move(one));
    }
  }
  return out;
}

std::vector<double> sorted_values(const Ratios& ratios) {
  std::vector<double> out;
  for (const SceneRatio& ratio : ratios) out.push_back(ratio.value);
  std::sort(out.begin(), out.end());
  return out;
}

std::string times_text(double ratio) { return format_number(ratio) + "x"; }

TitledTable speedups_table(const std::vector<Compared>& all, const Scenes& scenes,
                           const std::string& kind) {
  TitledTable out{
      fmt::format("Speed-ups in {} {}", plural(scenes.size(), "scene"), kind),
      "Time of the reference / time of the detector, in playback: median, 10th percentile and "
      "worst over the scenes that both answered.",
      {{"detector", true, ""},
       {"question", true, ""},
       {"over", true, ""},
       {"scenes", false, ""},
       {"median", false, ""},
       {"10th percentile", false, ""},
       {"worst", false, ""},
       {"worst in", true, ""},
       {"faster in", false, "of the scenes"}},
      {}};
  for (const Compared& one : all) {
    Ratios ratios;
    for (const SceneRatio& ratio : one.ratios)
      if (std::ranges::find(scenes, ratio.scene) != scenes.end()) ratios.push_back(ratio);
    if (ratios.empty()) continue;
    const auto worst = std::ranges::min_element(ratios, {}, &SceneRatio::value);
    const std::vector<double> values = sorted_values(ratios);
    const auto won = std::ranges::count_if(values, [](double value) { return value > 1.0; });
    out.rows.push_back({one.detector, name_of(one.question), one.reference,
                        fmt::format("{}", values.size()), times_text(results::median(values)),
                        times_text(results::quantile(values, 0.1)), times_text(values.front()),
                        worst->scene->id, fmt::format("{}", won)});
  }
  return out;
}

// What decides.

struct Correlation {
  std::string parameter;
  double value = 0.0;
};

/// Ratios where a parameter is low and where it is high, a third of the scenes each; scenes that
/// share a value are on the same side.
struct Thirds {
  double low_end = 0.0, high_begin = 0.0;  ///< of the parameter
  double low = 1.0, high = 1.0;            ///< medians of the ratios
};

double parameter_of(const Scene& scene, const std::string& name) {
  return scene.drawn->parameters.at(name);
}

// Strongest first.
std::vector<Correlation> correlations_of(const Ratios& ratios) {
  std::set<std::string> names;  // that every scene has
  for (const auto& [name, value] : ratios.front().scene->drawn->parameters) names.insert(name);
  std::vector<double> values;
  for (const SceneRatio& ratio : ratios) {
    values.push_back(ratio.value);
    std::erase_if(names, [&](const std::string& name) {
      return !ratio.scene->drawn->parameters.contains(name);
    });
  }
  std::vector<Correlation> out;
  for (const std::string& name : names) {
    std::vector<double> parameters;
    for (const SceneRatio& ratio : ratios) parameters.push_back(parameter_of(*ratio.scene, name));
    if (const std::optional<double> value = results::rank_correlation(parameters, values))
      out.push_back({name, *value});
  }
  std::ranges::stable_sort(out, std::greater<>{},
                           [](const Correlation& one) { return std::abs(one.value); });
  return out;
}

std::optional<Thirds> thirds_of(const Ratios& ratios, const std::string& parameter) {
  std::vector<double> values;
  for (const SceneRatio& ratio : ratios) values.push_back(parameter_of(*ratio.scene, parameter));
  std::sort(values.begin(), values.end());
  const std::size_t third = values.size() / 3;
  Thirds out;
  out.low_end = values[third - 1];
  out.high_begin = values[values.size() - third];
  if (!(out.low_end < out.high_begin)) return std::nullopt;
  std::vector<double> low, high;
  for (const SceneRatio& ratio : ratios) {
    const double value = parameter_of(*ratio.scene, parameter);
    if (value <= out.low_end) low.push_back(ratio.value);
    if (value >= out.high_begin) high.push_back(ratio.value);
  }
  out.low = results::median(std::move(low));
  out.high = results::median(std::move(high));
  return out;
}

// "1.4x up to 3100, 6.3x from 40000"
std::string thirds_text(const Thirds& thirds) {
  return fmt::format("{} up to {}, {} from {}", times_text(thirds.low),
                     format_number(thirds.low_end), times_text(thirds.high),
                     format_number(thirds.high_begin));
}

std::string decides_sentence(const Compared& one) {
  const std::vector<double> values = sorted_values(one.ratios);
  const auto won = std::ranges::count_if(values, [](double value) { return value > 1.0; });
  const std::string out =
      fmt::format("`{}` is faster than {} in {} of {}, median {}", one.detector,
                  one.reference == kFastest ? "every reference" : "`" + one.reference + "`", won,
                  plural(values.size(), "scene"), times_text(results::median(values)));
  if (values.size() < kFewestForCorrelation)
    return fmt::format("{}; fewer than {} scenes show no correlation.", out, kFewestForCorrelation);
  const std::vector<Correlation> all = correlations_of(one.ratios);
  if (all.empty()) return out + "; no parameter of these scenes varies.";
  const Correlation& strongest = all.front();
  const std::string name = name_in_words(strongest.parameter);
  if (std::abs(strongest.value) <= results::chance_correlation(values.size(), all.size()))
    return fmt::format(
        "{}; no parameter decides: the strongest correlation, {:+.2f} with {}, may "
        "be chance.",
        out, strongest.value, name);
  const std::optional<Thirds> thirds = thirds_of(one.ratios, strongest.parameter);
  return fmt::format("{}; {} decides most (rank correlation {:+.2f}){}.", out, name,
                     strongest.value, thirds ? ": median " + thirds_text(*thirds) : "");
}

TitledTable correlations_table(const std::vector<Compared>& all) {
  TitledTable out{"Speed-ups against the parameters of the scenes",
                  "",
                  {{"detector", true, ""},
                   {"over", true, ""},
                   {"scenes", false, ""},
                   {"chance", false, "what the strongest one stays below by chance alone"},
                   {"rank correlations, strongest first", true, ""},
                   {"medians for the strongest", true,
                    "where it is lowest and highest, a third of the scenes each"}},
                  {}};
  for (const Compared& one : all) {
    if (one.ratios.size() < kFewestForCorrelation) continue;
    const std::vector<Correlation> correlations = correlations_of(one.ratios);
    if (correlations.empty()) continue;
    const std::string text = text::joined(correlations, [](const Correlation& own) {
      return fmt::format("{} {:+.2f}", name_in_words(own.parameter), own.value);
    });
    const auto thirds = thirds_of(one.ratios, correlations.front().parameter);
    out.rows.push_back(
        {one.detector, one.reference, fmt::format("{}", one.ratios.size()),
         fmt::format("{:.2f}", results::chance_correlation(one.ratios.size(), correlations.size())),
         text, thirds ? thirds_text(*thirds) : "-"});
  }
  if (!out.rows.empty())
    out.text =
        "Spearman's rank correlation: +1 where the speed-up grows with the parameter, -1 where it "
        "shrinks. By chance alone the strongest one of a row stays below its column `chance` in "
        "95 % of cases. `distance` is negative for depths.";
  return out;
}

std::string count_text(const Scenes& scenes, const std::string& touching) {
  std::set<std::uint64_t> seeds;
  std::size_t redrawn = 0, unjudged = 0;
  for (const Scene* scene : scenes) {
    seeds.insert(scene->drawn->seed);
    redrawn += scene->drawn->redrawn > 0;
    unjudged += !scene->unjudged.empty();
  }
  std::vector<std::string> names;
  for (const std::uint64_t seed : seeds) names.push_back(std::to_string(seed));
  std::string out = fmt::format("{} drawn from {} {}, {}.", plural(scenes.size(), "scene"),
                                seeds.size() == 1 ? "seed" : "seeds",
                                short_list(names, kMostWrongScenes), touching);
  if (redrawn > 0)
    out += fmt::format(" {} drawn again because a limit of time or memory ended the judging.",
                       redrawn == 1 ? "1 of them was" : fmt::format("{} of them were", redrawn));
  if (unjudged > 0)
    out += fmt::format(" {} not be judged within the limits and {} left out below.",
                       unjudged == 1 ? "1 could" : fmt::format("{} could", unjudged),
                       unjudged == 1 ? "is" : "are");
  return out;
}

/// Scenes of one kind, frames or steps, and which of them have something to find.
struct DrawnKind {
  Scenes all, touching, apart;
  void add(const Scene& scene, bool touches) {
    all.push_back(&scene);
    if (scene.unjudged.empty()) (touches ? touching : apart).push_back(&scene);
  }
};

using AccuracyTable = TitledTable (*)(const Index&, const Scenes&, const std::string&);

// Sums of errors, wrong scenes, speed-ups and what decides them.
void add_blocks(const Index& index, const DrawnKind& drawn, const std::vector<Compared>& ratios,
                AccuracyTable accuracy, const std::string& contact, Blocks& out) {
  const std::pair<const Scenes&, std::string> kinds[] = {{drawn.touching, "with " + contact},
                                                         {drawn.apart, "without " + contact}};
  for (const auto& [scenes, kind] : kinds) out.emplace_back(accuracy(index, scenes, kind));
  out.emplace_back(wrong_table(index, drawn.all));
  for (const auto& [scenes, kind] : kinds) out.emplace_back(speedups_table(ratios, scenes, kind));
  // The last of a detector is over the fastest reference, or over the only one.
  Items decides;
  for (std::size_t i = 0; i < ratios.size(); ++i)
    if (i + 1 == ratios.size() || ratios[i + 1].detector != ratios[i].detector)
      decides.texts.push_back(decides_sentence(ratios[i]));
  if (!decides.texts.empty()) {
    out.emplace_back(Heading{"What decides"});
    out.emplace_back(std::move(decides));
  }
  out.emplace_back(correlations_table(ratios));
}

std::string step_count_text(const DrawnKind& drawn) {
  std::size_t steps = 0, passing = 0;
  for (const Scene* scene : drawn.all) {
    if (!scene->impacts) continue;
    steps += scene->impacts->motion.size();
    for (const std::uint64_t pairs : scene->impacts->passing) passing += pairs;
  }
  return fmt::format("{} with impacts; {}, in which {} of bodies meet and touch at neither end",
                     drawn.touching.size(), plural(steps, "step"), plural(passing, "pair"));
}

Blocks drawn_blocks(const Index& index) {
  DrawnKind frames, steps;
  for (const Scene& scene : index.results().scenes) {
    if (!scene.drawn) continue;
    if (drawn_as_steps(scene)) {
      steps.add(scene, has_impacts(scene));
    } else {
      frames.add(scene, scene.contact_frames > 0);
    }
  }
  Blocks out;
  if (!frames.all.empty()) {
    out.emplace_back(
        Paragraph{count_text(frames.all, fmt::format("{} with contact", frames.touching.size()))});
    add_blocks(index, frames, compared(index, frames.all, results::kReferences, {}), accuracy_table,
               "contact", out);
  }
  if (!steps.all.empty()) {
    out.emplace_back(Paragraph{count_text(steps.all, step_count_text(steps))});
    add_blocks(index, steps,
               compared(index, steps.all, results::kStepReferences, Question::kImpacts),
               step_accuracy_table, "impacts", out);
  }
  return out;
}

}  // namespace

/// What scenes drawn from a seed say about each detector, in scenes with contact and without: how
/// often it is wrong and where, how fast it is, and which parameter of the scenes decides that. Of
/// scenes that are judged between frames the same, with impacts and without.
extern const Section kDrawn = {"drawn", "Drawn scenes", "Drawn scenes", drawn_blocks};

}  // namespace contactcheck::report
