#include "reference/report/tables/headline.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reference/report/tables/error_counts.h"
#include "reference/report/tables/format.h"
#include "reference/report/tables/known_defects.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scale_ranges.h"
#include "reference/results/references.h"

namespace contactcheck::report {
namespace {

using results::Index, results::Results, results::Run;
using Names = std::vector<std::string>;

constexpr std::size_t kMostDetectors = 5, kMostPlaces = 3;

// The entry whose member is `key`; added at the end where there is none.
template <typename Entry, typename Key>
Entry& entry_of(const Key& key, Key Entry::*member, std::vector<Entry>& all) {
  for (Entry& entry : all)
    if (entry.*member == key) return entry;
  Entry& added = all.emplace_back();
  added.*member = key;
  return added;
}

/// A detector over all scenes: what it claims, and how often it was wrong.
struct Verdict {
  std::string detector;
  std::map<Level, ErrorCounts> levels;
  std::optional<Level> finest;  ///< in the first scene that it finished, else in the first family
  bool in_family = false;       ///< `finest` is of one
  bool failed = false;          ///< ended in an error somewhere

  bool flawless() const {
    return !failed && std::all_of(levels.begin(), levels.end(), [](const auto& level) {
      return level.second.missed == 0 && level.second.spurious == 0;
    });
  }
};

// No detector was asked about a scene that was not judged.
bool was_asked(const Index& index, const Run& run) {
  const results::Scene* scene = index.scene(run.scene);
  return scene == nullptr || scene->unjudged.empty();
}

// The detectors that were judged at a level they claim, even with nothing to find, or that ended in
// an error; in the order of their first runs.
std::vector<Verdict> verdicts_of(const Index& index) {
  std::vector<Verdict> all;
  std::set<std::string> families;
  for (const results::Scene& scene : index.results().scenes)
    if (scene.family) families.insert(scene.id);
  for (const Run& run : index.results().runs) {
    Verdict& own = entry_of(run.detector, &Verdict::detector, all);
    if (run.status == results::Status::kError && was_asked(index, run)) own.failed = true;
    if (!run.ok()) continue;
    if (!own.finest || (own.in_family && !families.contains(run.scene))) {
      own.finest = run.per_frame.level;
      own.in_family = families.contains(run.scene);
    }
    for (const auto& [level, counts] : run.levels)
      if (!counts.informative) own.levels[level].add(run, level);
  }
  std::erase_if(all,
                [](const Verdict& verdict) { return !verdict.failed && verdict.levels.empty(); });
  return all;
}

// About contacts only: hover, depths and normals have separate sentences.
std::string title_of(const Index& index, const std::vector<Verdict>& all) {
  std::size_t scenes = 0, judged_scenes = 0, cases = 0, judged_cases = 0;
  for (const results::Scene& scene : index.results().scenes) {
    if (!scene.unjudged.empty()) continue;
    // Not where no detector claims a level of the scene.
    const std::vector<const Run*>& rows = index.runs_of(scene.id);
    const bool judged =
        rows.empty() || std::any_of(rows.begin(), rows.end(), [](const Run* row) {
          return row->status == results::Status::kError ||
                 std::any_of(row->levels.begin(), row->levels.end(),
                             [](const auto& one) { return !one.second.informative; });
        });
    const std::size_t count = scene.family ? scene.family->values.size() : 1;
    (scene.family ? cases : scenes) += count;
    if (judged) (scene.family ? judged_cases : judged_scenes) += count;
  }
  Names parts;
  const bool none = judged_scenes + judged_cases == 0;
  const auto add = [&](std::size_t judged, std::size_t of, const char* what) {
    const std::string all_of_them = plural(of, what);
    if (judged == of || none)
      parts.push_back(all_of_them);
    else if (judged > 0)
      parts.push_back(grouped_digits(judged) + " of " + all_of_them);
  };
  if (scenes > 0) add(judged_scenes, scenes, "scene");
  if (cases > 0) add(judged_cases, cases, "hard case");
  const std::string places = listed(parts);
  if (all.empty()) return "Nothing was judged in " + (places.empty() ? "this run" : places);

  const auto right = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const Verdict& v) { return v.flawless(); }));
  const auto failed = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const Verdict& v) { return v.failed; }));
  const bool answered =
      std::any_of(all.begin(), all.end(), [](const Verdict& v) { return !v.levels.empty(); });
  if (!answered)
    return fmt::format("{} ended in status error in {}",
                       failed == 1 ? all[0].detector : fmt::format("All {} detectors", failed),
                       places);
  const std::string who =
      all.size() == 1 ? all[0].detector + " has"
      : right == 0 || right == all.size()
          ? fmt::format("All {} detectors have", all.size())
          : fmt::format("{} of {} detectors {}", right, all.size(), right == 1 ? "has" : "have");
  return fmt::format(
      "{} {} in {}{}", who,
      right > 0    ? "no missed and no spurious contacts"
      : failed > 0 ? "missed or spurious contacts, or status error,"
                   : "missed or spurious contacts",
      places, right > 0 && failed > 0 ? fmt::format("; {} ended in status error", failed) : "");
}

void add_exact(const std::vector<Verdict>& all, std::vector<HeadlineFinding>& out) {
  struct LevelNames {
    std::optional<Level> level;
    Names names;
  };
  std::vector<LevelNames> by_level;
  for (const Verdict& verdict : all)
    if (verdict.flawless())
      entry_of(verdict.finest, &LevelNames::level, by_level).names.push_back(verdict.detector);
  for (const auto& [level, names] : by_level)
    out.push_back({"No missed or spurious contacts",
                   fmt::format("At level {}: {}.", level ? name_of(*level) : "", listed(names))});
}

using Member = std::uint64_t ErrorCounts::*;

/// One detector's errors of one kind, at the level that shows them.
struct Wrong {
  const Verdict* verdict = nullptr;
  Level level{};
  ErrorCounts counts;
};

// The level that shows the error: the finest, unless that is without.
std::optional<Wrong> wrong_at(const Verdict& verdict, Member errors) {
  if (verdict.finest)
    if (const auto finest = verdict.levels.find(*verdict.finest);
        finest != verdict.levels.end() && finest->second.*errors > 0)
      return Wrong{&verdict, finest->first, finest->second};
  for (const auto& [level, counts] : verdict.levels)
    if (counts.*errors > 0) return Wrong{&verdict, level, counts};
  return std::nullopt;
}

void add_wrong(const std::vector<Verdict>& all, bool missed, std::vector<HeadlineFinding>& out) {
  const Member errors = missed ? &ErrorCounts::missed : &ErrorCounts::spurious;
  const auto share = [&](const ErrorCounts& c) {
    return (missed ? c.missed_share() : c.spurious_share()).value_or(0.0);
  };
  std::vector<Wrong> wrong;
  std::set<Level> levels;
  for (const Verdict& verdict : all)
    if (const std::optional<Wrong> found = wrong_at(verdict, errors)) {
      wrong.push_back(*found);
      levels.insert(found->level);
    }
  if (wrong.empty()) return;
  std::stable_sort(wrong.begin(), wrong.end(), [&](const Wrong& a, const Wrong& b) {
    return share(a.counts) > share(b.counts);
  });
  Names texts;
  for (const Wrong& w : wrong)
    texts.push_back(
        fmt::format("{} {} ({} of {}{})", w.verdict->detector, format_percent(share(w.counts)),
                    grouped_digits(w.counts.*errors),
                    grouped_digits(missed ? w.counts.truth : w.counts.reported),
                    levels.size() > 1 ? ", level " + std::string(name_of(w.level)) : ""));
  out.push_back(
      {missed ? "Missed" : "Spurious",
       fmt::format("{} {}{}: {}.", plural(wrong.size(), "detector"),
                   missed ? "did not report all true contacts" : "reported spurious contacts",
                   levels.size() == 1 ? ", at level " + std::string(name_of(*levels.begin())) : "",
                   short_list(texts, kMostDetectors))});
}

/// A detector and the scenes in which it is the fastest of those that were right.
struct Winner {
  std::string detector;
  Names scenes;
};

// What can be compared: what was in the most scenes, of equals the first. A scene of steps is about
// contact within them, a scene of self-contact about that.
constexpr std::pair<Question, const char*> kCompared[] = {
    {Question::kImpacts, "all contacts within steps"},
    {Question::kSelf, "all contacts of bodies with themselves"},
    {Question::kTriangles, "all pairs of triangles"},
    {Question::kBody, "pairs of bodies"}};

// The winners among detectors that were right and answer this question, most scenes first.
std::vector<Winner> winners_of(const Index& index, const std::vector<Verdict>& verdicts,
                               Question question) {
  std::set<std::string> right;
  for (const Verdict& verdict : verdicts)
    if (verdict.flawless()) right.insert(verdict.detector);
  std::vector<Winner> out;
  for (const bool families : {false, true})
    for (const results::Scene& scene : index.results().scenes) {
      if (scene.family.has_value() != families) continue;
      const Run* best = nullptr;
      std::size_t candidates = 0;
      for (const Run* run : index.runs_of(scene.id)) {
        const results::QuestionTimes* const times = times_in(*run, question);
        if (!run->ok() || !right.contains(run->detector) || times == nullptr) continue;
        ++candidates;
        if (best == nullptr || times->playback.frame < times_in(*best, question)->playback.frame)
          best = run;
      }
      if (candidates < 2) continue;
      entry_of(best->detector, &Winner::detector, out).scenes.push_back(scene.id);
    }
  std::stable_sort(out.begin(), out.end(), [](const Winner& a, const Winner& b) {
    return a.scenes.size() > b.scenes.size();
  });
  return out;
}

// ": 15.1 to 75.1x fcl-aabb", over the first reference that was timed beside it; with its ends, if
// it is of one scene.
std::string over_reference(const std::vector<const Run*>& runs, Question question) {
  Names references(results::kReferences.begin(), results::kReferences.end());
  if (is_of_steps(question))
    references.assign(results::kStepReferences.begin(), results::kStepReferences.end());
  for (const std::string& reference : references) {
    if (reference == runs.front()->detector) continue;
    Range ratios;
    std::string of_one;
    for (const Run* run : runs)
      if (const results::Speedup* speedup = speedup_of(*run, question, reference)) {
        ratios.add(speedup->playback.value);
        of_one = format_ratio(speedup->playback, speedup->passes);
      }
    if (ratios.low)
      return ": " + (runs.size() == 1 ? of_one : format_range(ratios) + "x") + " " + reference;
  }
  return "";
}

std::string cheapest_sentence(const Index& index, const std::vector<Winner>& winners,
                              Question question, const char* what) {
  const Winner& best = winners.front();
  std::size_t total = 0;
  Names others;
  for (const Winner& winner : winners) {
    total += winner.scenes.size();
    if (&winner != &best)
      others.push_back(winner.detector + " in " + short_list(winner.scenes, kMostPlaces));
  }
  const std::string where = total > best.scenes.size()
                                ? fmt::format(" in {} of {} scenes", best.scenes.size(), total)
                            : total == 1 ? ""
                                         : fmt::format(" in all {} scenes", grouped_digits(total));
  std::vector<const Run*> runs;
  for (const std::string& scene : best.scenes) runs.push_back(index.run(scene, best.detector));
  return fmt::format("{}{}{}, of {}, {} ms per frame{}", best.detector, where,
                     over_reference(runs, question), what,
                     format_number(mean_frame_ms(runs, false, question)),
                     others.empty() ? "" : "; " + listed(others));
}

/// The errors of one detector, over all scenes.
struct DetectorErrors {
  std::string detector, aside;
  double largest = 0.0, sum = 0.0;
  std::uint64_t judged = 0;  ///< of the sum

  void add(const results::ErrorSpread& spread, double factor) {
    largest = std::max(largest, factor * spread.max.value_or(0.0));
    if (!spread.mean) return;
    sum += factor * *spread.mean * static_cast<double>(spread.judged);
    judged += spread.judged;
  }
};

// Worst first; without those that were never off.
Names texts_of(std::vector<DetectorErrors> all, const char* unit) {
  std::erase_if(all, [](const DetectorErrors& one) { return !(one.largest > 0.0); });
  std::stable_sort(all.begin(), all.end(), [](const DetectorErrors& a, const DetectorErrors& b) {
    return a.largest > b.largest;
  });
  Names out;
  for (const DetectorErrors& one : all) {
    std::string aside = one.aside;
    if (one.judged > 0)
      aside += (aside.empty() ? "mean " : ", mean ") +
               format_number(one.sum / static_cast<double>(one.judged));
    out.push_back(fmt::format("{} {} {}{}", one.detector, format_number(one.largest), unit,
                              aside.empty() ? "" : " (" + aside + ")"));
  }
  return out;
}

// A detector may see contact as far off as it declares. The moment of first contact is known to
// within 1e-6 of the scene's size; ten times that is a difference.
void add_hover(const Index& index, std::vector<HeadlineFinding>& out) {
  constexpr double kDifference = 1e-5;
  std::vector<DetectorErrors> all;
  for (const Run& run : index.results().runs) {
    const results::Scene* scene = index.scene(run.scene);
    const double margin = run.semantics.margin, gap = run.geometry.hover_gap_max.value_or(0.0);
    if (!run.ok() || scene == nullptr || !(gap - margin > kDifference * scene->size)) continue;
    DetectorErrors& own = entry_of(run.detector, &DetectorErrors::detector, all);
    if (1e3 * gap <= own.largest) continue;
    own.largest = 1e3 * gap;
    own.aside = margin > 0.0 ? "margin " + format_millimetres(margin) + " mm" : "";
  }
  const Names texts = texts_of(all, "mm");
  if (!texts.empty())
    out.push_back({"Too early", fmt::format("{} reported contact of bodies farther apart than "
                                            "declared: {}.",
                                            plural(texts.size(), "detector"),
                                            short_list(texts, kMostDetectors))});
}

// Not of families, some of which are as large as planets. Kinds of depth do not compare.
void add_depths(const Index& index, std::vector<HeadlineFinding>& out) {
  std::map<DepthKind, std::vector<DetectorErrors>> depths;
  std::vector<DetectorErrors> normals;
  for (const Run& run : index.results().runs) {
    const results::Scene* scene = index.scene(run.scene);
    if (!run.ok() || scene == nullptr || scene->family) continue;
    entry_of(run.detector, &DetectorErrors::detector, depths[run.geometry.depth_kind])
        .add(run.geometry.depth, 1e3);
    entry_of(run.detector, &DetectorErrors::detector, normals).add(run.geometry.normal_deg, 1.0);
  }
  for (const auto& [kind, all] : depths)
    if (const Names texts = texts_of(all, "mm"); !texts.empty())
      out.push_back({std::string("Depth, ") + name_of(kind),
                     "Largest error: " + short_list(texts, kMostDetectors) + "."});
  if (const Names texts = texts_of(normals, "degrees"); !texts.empty())
    out.push_back({"Normal", "Largest error: " + short_list(texts, kMostDetectors) + "."});
}

void add_status(const Index& index, results::Status status, const char* topic,
                std::vector<HeadlineFinding>& out) {
  Names texts;
  for (const Run& run : index.results().runs)
    if (run.status == status && was_asked(index, run))
      texts.push_back(fmt::format("{} in {} ({})", run.detector, run.scene, run.message));
  if (!texts.empty()) out.push_back({topic, short_list(texts, kMostPlaces) + "."});
}

void add_oracle(const Results& results, std::vector<HeadlineFinding>& out) {
  for (const results::Scene& scene : results.scenes) {
    if (!scene.pairs) continue;
    const std::uint64_t wrong = scene.pairs->oracle_wrong;
    out.push_back(
        {"The judge itself",
         fmt::format("On {} random pairs of triangles the oracle {} (checked by rational "
                     "arithmetic).",
                     grouped_digits(scene.pairs->checked),
                     wrong == 0 ? "was never wrong"
                                : fmt::format("was wrong {}: an error of contactcheck itself",
                                              plural(wrong, "time")))});
  }
}

void add_goals(const Results& results, std::vector<HeadlineFinding>& out) {
  const std::vector<results::MeasuredGoal>& goals = results.goals;
  if (goals.empty()) return;
  const auto met = std::count_if(goals.begin(), goals.end(),
                                 [](const auto& goal) { return goal.met.value_or(false); });
  const auto unknown = static_cast<std::size_t>(
      std::count_if(goals.begin(), goals.end(), [](const auto& goal) { return !goal.met; }));
  out.push_back(
      {"Goals",
       fmt::format("{} of {} of the suite {} met{}.", met, plural(goals.size(), "goal"),
                   met == 1 ? "is" : "are",
                   unknown == 0 ? "" : "; " + plural(unknown, "goal") + " could not be measured")});
}

}  // namespace

Headline headline_of(const Results& results) {
  const Index index(results);
  const std::vector<Verdict> verdicts = verdicts_of(index);
  Headline out;
  out.title = title_of(index, verdicts);
  add_exact(verdicts, out.findings);
  std::size_t most = 0;
  for (const auto& [question, what] : kCompared) {
    const std::vector<Winner> winners = winners_of(index, verdicts, question);
    std::size_t scenes = 0;
    for (const Winner& winner : winners) scenes += winner.scenes.size();
    if (scenes <= most) continue;
    most = scenes;
    out.fastest.clear();
    for (const Winner& winner : winners) out.fastest.push_back(winner.detector);
    out.cheapest = cheapest_sentence(index, winners, question, what);
  }
  if (most > 0) out.findings.push_back({"Cheapest without errors", out.cheapest + "."});
  add_wrong(verdicts, true, out.findings);
  add_wrong(verdicts, false, out.findings);
  add_hover(index, out.findings);
  add_depths(index, out.findings);
  add_status(index, results::Status::kError, "Ended in an error", out.findings);
  add_status(index, results::Status::kRefused, "Refused the input", out.findings);
  Names absent, unjudged;
  for (const Run& run : results.runs)
    if (run.status == results::Status::kAbsent &&
        std::find(absent.begin(), absent.end(), run.detector) == absent.end())
      absent.push_back(run.detector);
  if (!absent.empty()) out.findings.push_back({"Not built", listed(absent) + "."});
  for (const results::Scene& scene : results.scenes)
    if (!scene.unjudged.empty()) unjudged.push_back(scene.unjudged);
  if (!unjudged.empty())
    out.findings.push_back({"Not judged", short_list(unjudged, kMostPlaces) + "."});
  if (const Names out_of_range = detectors_out_of_range(index); !out_of_range.empty())
    out.findings.push_back(
        {"Sizes",
         "Some scene is outside the sizes or distances in which they are known to be right: " +
             listed(out_of_range) + "."});
  if (results.known_defects)
    out.findings.push_back({"Known defects", known_defects_sentence(*results.known_defects)});
  add_oracle(results, out.findings);
  add_goals(results, out.findings);
  return out;
}

}  // namespace contactcheck::report
